# cmake -C pkgconfig/presets/all.cmake -S . -B build: with the static library, Python and Fortran, warnings as errors.
set(CMAKE_BUILD_TYPE Release CACHE STRING "")
foreach(option JAM_BUILD_STATIC JAM_BUILD_PYTHON JAM_BUILD_FORTRAN JAM_WERROR)
  set(${option} ON CACHE BOOL "")
endforeach()
