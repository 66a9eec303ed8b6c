# cmake -C pkgconfig/presets/debug.cmake -S . -B build: assertions, and the order of events checked.
set(CMAKE_BUILD_TYPE Debug CACHE STRING "")
set(JAM_CHECK_PAIRS ON CACHE BOOL "")
