# cmake -C pkgconfig/presets/wasm.cmake -S . -B build-wasm -G Ninja: the package for JavaScript, by Debian's Emscripten.
include(${CMAKE_CURRENT_LIST_DIR}/flat.cmake)
set(CMAKE_BUILD_TYPE Release CACHE STRING "")
set(CMAKE_UNITY_BUILD ON CACHE BOOL "")
foreach(option JAM_HARDENING JAM_ZLIB JAM_BUILD_TESTS JAM_BUILD_EXAMPLES JAM_BUILD_CLI JAM_INSTALL)
  set(${option} OFF CACHE BOOL "")
endforeach()
set(Eigen3_DIR /usr/share/eigen3/cmake CACHE PATH "")
set(CMAKE_TOOLCHAIN_FILE /usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake CACHE FILEPATH "")
if(NOT EXISTS ${CMAKE_TOOLCHAIN_FILE})
  message(FATAL_ERROR "${CMAKE_TOOLCHAIN_FILE} was not found (Debian: emscripten); -DCMAKE_TOOLCHAIN_FILE= before -C "
                      "names that of another system")
endif()
