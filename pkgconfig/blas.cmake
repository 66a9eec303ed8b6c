# The target jam_blas: what the dense products are linked with. JAM_BLAS_STATIC: the same for a static libjam.
# JAM_NOT_COMPILED: the sources of the other choice.
add_library(jam_blas INTERFACE)
if(JAM_BLAS STREQUAL "builtin")
  target_compile_definitions(jam_blas INTERFACE JAM_BLAS_BUILTIN)
  set(JAM_NOT_COMPILED "/(linalg/blas/fortran|analysis/dense_lapack)[.]cpp$")
  set(JAM_BLAS_STATIC "")
  return()
endif()
set(JAM_NOT_COMPILED "/(linalg/blas/(builtin|portable|avx2|avx512)|analysis/dense_builtin)[.]cpp$")
if(JAM_BLAS STREQUAL "openblas")
  pkg_check_modules(OPENBLAS REQUIRED IMPORTED_TARGET openblas)
  set(blas_libraries PkgConfig::OPENBLAS)
  set(JAM_BLAS_STATIC ${OPENBLAS_STATIC_LDFLAGS})
elseif(JAM_BLAS STREQUAL "any")
  find_package(BLAS REQUIRED)
  find_package(LAPACK REQUIRED)
  set(blas_libraries ${LAPACK_LIBRARIES} ${BLAS_LIBRARIES})
  target_link_options(jam_blas INTERFACE ${BLAS_LINKER_FLAGS})
  set(JAM_BLAS_STATIC ${BLAS_LINKER_FLAGS} ${LAPACK_LIBRARIES} ${BLAS_LIBRARIES})
else()
  message(FATAL_ERROR "JAM_BLAS is \"${JAM_BLAS}\": openblas, any or builtin is wanted")
endif()
target_link_libraries(jam_blas INTERFACE ${blas_libraries})

# Integers of 64 bits have the same names: such a routine reads 4 bytes too many of each, here another number.
if(NOT CMAKE_CROSSCOMPILING OR CMAKE_CROSSCOMPILING_EMULATOR)
  include(CheckCXXSourceRuns)
  set(CMAKE_REQUIRED_LIBRARIES ${blas_libraries})
  check_cxx_source_runs("
    extern \"C\" double ddot_(const int *, const double *, const int *, const double *, const int *);
    int main() {
      const int n[2] = {2, -1}, step[2] = {1, -1};
      const double x[2] = {3.0, 4.0};
      return ddot_(n, x, step, x, step) == 25.0 ? 0 : 1;
    }" JAM_BLAS_HAS_INT32)
  unset(CMAKE_REQUIRED_LIBRARIES)
  if(NOT JAM_BLAS_HAS_INT32)
    message(FATAL_ERROR "The BLAS that was found does not compute with integers of 32 bits, which libjam calls it "
                        "with: install one that does (Debian: libopenblas-dev)")
  endif()
endif()
