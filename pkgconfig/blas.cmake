# The target jam_blas: what dense products (JAM_BLAS) and full spectra (JAM_LAPACK) are linked with, if anything.
# JAM_BLAS_STATIC: the same for a static libjam. JAM_NOT_COMPILED: the sources of the other choices.
add_library(jam_blas INTERFACE)
set(JAM_BLAS_STATIC "")
set(found FALSE)
if(JAM_BLAS STREQUAL "any")
  find_package(BLAS REQUIRED)
elseif(JAM_BLAS STREQUAL "openblas")
  pkg_check_modules(OPENBLAS REQUIRED IMPORTED_TARGET openblas)
elseif(NOT JAM_BLAS STREQUAL "builtin")
  message(FATAL_ERROR "JAM_BLAS is \"${JAM_BLAS}\": builtin, openblas or any is wanted")
elseif(JAM_LAPACK AND NOT LAPACK_LIBRARIES AND NOT BLA_VENDOR)  # unless another one is named
  pkg_check_modules(OPENBLAS QUIET IMPORTED_TARGET openblas)
endif()
if(OPENBLAS_FOUND AND NOT JAM_BLAS STREQUAL "any" AND (JAM_LAPACK OR NOT JAM_BLAS STREQUAL "builtin"))
  set(blas_libraries PkgConfig::OPENBLAS)
  set(blas_static ${OPENBLAS_STATIC_LDFLAGS})
  set(found TRUE)
elseif(JAM_LAPACK OR JAM_BLAS STREQUAL "any")
  if(JAM_LAPACK)
    find_package(LAPACK QUIET)
  endif()
  set(blas_libraries ${LAPACK_LIBRARIES} ${BLAS_LIBRARIES})
  set(blas_static ${BLAS_LINKER_FLAGS} ${blas_libraries})
  set(found ${LAPACK_FOUND})
endif()

# jam_computes(ANSWER CODE): whether a program runs with these libraries and ends with 0. Integers of 64 bits have the
# same names: such a routine reads 4 bytes too many of each, here another number.
function(jam_computes answer code)
  if(CMAKE_CROSSCOMPILING AND NOT CMAKE_CROSSCOMPILING_EMULATOR)
    set(${answer} TRUE PARENT_SCOPE)
    return()
  endif()
  include(CheckCXXSourceRuns)
  set(CMAKE_REQUIRED_QUIET TRUE)
  set(CMAKE_REQUIRED_LIBRARIES ${blas_libraries})
  check_cxx_source_runs("${code}" ${answer})
  set(${answer} "${${answer}}" PARENT_SCOPE)
endfunction()

set(lapack FALSE)
if(JAM_LAPACK AND found)
  jam_computes(JAM_LAPACK_COMPUTES "
    extern \"C\" {
    void dsterf_(const int *, double *, double *, int *);
    void dlatrd_(); void dsyr2k_(); void dsytd2_(); void dstedc_(); void dormtr_();
    }
    void (*volatile others[])() = {dlatrd_, dsyr2k_, dsytd2_, dstedc_, dormtr_};
    int main() {
      const int n[2] = {2, -1};
      double d[2] = {1.0, 1.0}, e[1] = {1.0};
      int info[2] = {1, 1};
      dsterf_(n, d, e, info);
      return others[0] && info[0] == 0 && d[0] < 0.5 && d[1] > 1.5 ? 0 : 1;
    }")
  set(lapack ${JAM_LAPACK_COMPUTES})
endif()
if(NOT lapack AND JAM_LAPACK AND NOT JAM_LAPACK STREQUAL "AUTO")
  message(FATAL_ERROR "JAM_LAPACK is ${JAM_LAPACK} and no LAPACK with integers of 32 bits was found (Debian: "
                      "libopenblas-dev)")
endif()
if(NOT JAM_BLAS STREQUAL "builtin")
  jam_computes(JAM_BLAS_HAS_INT32 "
    extern \"C\" double ddot_(const int *, const double *, const int *, const double *, const int *);
    int main() {
      const int n[2] = {2, -1}, step[2] = {1, -1};
      const double x[2] = {3.0, 4.0};
      return ddot_(n, x, step, x, step) == 25.0 ? 0 : 1;
    }")
  if(NOT JAM_BLAS_HAS_INT32)
    message(FATAL_ERROR "The BLAS that was found does not compute with integers of 32 bits, which libjam calls it "
                        "with: install one that does (Debian: libopenblas-dev)")
  endif()
endif()

set(JAM_NOT_COMPILED "linalg/blas/fortran|")
if(NOT JAM_BLAS STREQUAL "builtin")
  set(JAM_NOT_COMPILED "linalg/blas/builtin|")
endif()
if(lapack)
  string(APPEND JAM_NOT_COMPILED "analysis/dense_no_lapack")
  if(blas_libraries STREQUAL "PkgConfig::OPENBLAS")
    set(JAM_LAPACK_OPENBLAS TRUE)  # for tests
  endif()
  message(STATUS "Dense products: ${JAM_BLAS}; full spectra: LAPACK")
else()
  string(APPEND JAM_NOT_COMPILED "analysis/dense_lapack")
  message(STATUS "Dense products: ${JAM_BLAS}; full spectra: own loops")
endif()
if(lapack OR NOT JAM_BLAS STREQUAL "builtin")
  target_link_libraries(jam_blas INTERFACE ${blas_libraries})
  target_link_options(jam_blas INTERFACE ${BLAS_LINKER_FLAGS})
  set(JAM_BLAS_STATIC ${blas_static})
else()
  string(APPEND JAM_NOT_COMPILED "|linalg/blas/single_thread")
endif()
set(JAM_NOT_COMPILED "/(${JAM_NOT_COMPILED})[.]cpp$")
