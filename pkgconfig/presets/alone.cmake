# cmake -C pkgconfig/presets/alone.cmake -S . -B build: without LAPACK, Clp and voro++.
set(CMAKE_BUILD_TYPE Release CACHE STRING "")
set(JAM_LAPACK OFF CACHE STRING "")
set(JAM_CLP OFF CACHE BOOL "")
set(JAM_USE_VORO OFF CACHE STRING "")
