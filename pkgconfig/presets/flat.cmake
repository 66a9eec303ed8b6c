# cmake -C pkgconfig/presets/flat.cmake -S . -B build: as alone, for d = 2 and 3 only. It compiles in half the time.
include(${CMAKE_CURRENT_LIST_DIR}/alone.cmake)
set(JAM_DIMENSIONS "2;3" CACHE STRING "")
