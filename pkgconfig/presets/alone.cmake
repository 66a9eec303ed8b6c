# cmake -C pkgconfig/presets/alone.cmake -S . -B build: without OpenBLAS, Clp and voro++. A crunch then has the same
# bits on every processor.
set(CMAKE_BUILD_TYPE Release CACHE STRING "")
set(JAM_BLAS builtin CACHE STRING "")
set(JAM_CLP OFF CACHE BOOL "")
set(JAM_USE_VORO OFF CACHE STRING "")
