# The Debian packages libjam1, libjam-dev, python3-jam, jam-tools and jam-doc:
#   cmake -S . -B build -DCMAKE_INSTALL_PREFIX=/usr -DJAM_BUILD_PYTHON=ON -DJAM_BUILD_FORTRAN=ON -DJAM_BUILD_STATIC=ON
#   cmake --build build && (cd build && cpack -G DEB)
# Only for /usr: directories of libraries and Python differ below other prefixes.
if(NOT CMAKE_INSTALL_PREFIX STREQUAL "/usr")
  return()
endif()
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME jam)
string(REPLACE - ~ CPACK_PACKAGE_VERSION ${JAM_VERSION})  # for Debian 1.1.0~dev is before 1.1.0
set(CPACK_PACKAGE_CONTACT "The libjam authors <libjam@users.noreply.github.com>")
set(CPACK_PACKAGE_VENDOR libjam)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_SET_DESTDIR ON)  # so that what is written at install time names /usr
set(CPACK_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR})
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "jammed packings of hard spheres")
set(about "libjam makes jammed packings of hard spheres by event-driven
 molecular dynamics and linear programming. It finds their contact
 networks, forces and vibrational modes in two to eight dimensions.")

# jam_package(COMPONENT NAME SECTION SUMMARY): one package; its documents lie where Debian wants them.
function(jam_package component name section summary)
  string(TOUPPER ${component} key)
  set(CPACK_DEBIAN_${key}_PACKAGE_NAME ${name} PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_PACKAGE_SECTION ${section} PARENT_SCOPE)
  set(CPACK_COMPONENT_${key}_DESCRIPTION "${summary}\n ${about}" PARENT_SCOPE)
  set(made ${PROJECT_BINARY_DIR}/debian/${name})
  file(MAKE_DIRECTORY ${made})
  file(READ ${PROJECT_SOURCE_DIR}/LICENSE license)
  string(REGEX MATCH "Copyright.*" license "${license}")
  string(STRIP "${license}" license)
  string(REGEX MATCH "Copyright[^\n]*" copyright "${license}")
  string(REPLACE "\n\n" "\n.\n" license "${license}")
  string(REPLACE "\n" "\n " license "${license}")
  string(REGEX REPLACE "^Copyright (\\(c\\) )?" "" copyright "${copyright}")
  file(WRITE ${made}/copyright "Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: libjam

Files: *
Copyright: ${copyright}
License: Expat
 ${license}
")
  file(WRITE ${made}/changelog.txt "${name} (${CPACK_PACKAGE_VERSION}) unstable; urgency=medium

  * See CHANGELOG.md of the source.

 -- The libjam authors <libjam@users.noreply.github.com>  Thu, 01 Jan 2026 00:00:00 +0000
")
  execute_process(COMMAND gzip -9nc ${made}/changelog.txt OUTPUT_FILE ${made}/changelog.gz)
  install(FILES ${made}/copyright ${made}/changelog.gz DESTINATION share/doc/${name} COMPONENT ${component})
endfunction()

set(CPACK_COMPONENTS_ALL runtime dev doc)
jam_package(runtime libjam${JAM_ABI} libs "Jammed packings of hard spheres: shared library")
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
file(WRITE ${PROJECT_BINARY_DIR}/debian/triggers "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA ${PROJECT_BINARY_DIR}/debian/triggers)
set(CPACK_POST_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/pkgconfig/package_scripts.cmake)
jam_package(dev libjam-dev libdevel "Jammed packings of hard spheres: C, C++, Fortran and Julia")
set(CPACK_COMPONENT_DEV_DEPENDS runtime)
if(JAM_BUILD_FORTRAN)
  # a module file serves the compilers that write the same version of it
  execute_process(COMMAND gfortran -dumpversion OUTPUT_VARIABLE version OUTPUT_STRIP_TRAILING_WHITESPACE)
  execute_process(COMMAND dpkg-query -W -f "\${Provides}" gfortran-${version} OUTPUT_VARIABLE provides ERROR_QUIET)
  if(provides MATCHES "gfortran-mod-[0-9]+")
    set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "gfortran-${version} | ${CMAKE_MATCH_0}")
  endif()
endif()
jam_package(doc jam-doc doc "Jammed packings of hard spheres: guide and examples")
set(CPACK_DEBIAN_DOC_PACKAGE_ARCHITECTURE all)
file(GLOB pages ${PROJECT_SOURCE_DIR}/bindings/docs/*.md ${PROJECT_SOURCE_DIR}/README.md)
install(FILES ${pages} DESTINATION share/doc/jam-doc COMPONENT doc)
foreach(language c cpp fortran julia octave python)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/examples/${language} DESTINATION share/doc/jam-doc/examples COMPONENT doc
          PATTERN __pycache__ EXCLUDE)
endforeach()

if(JAM_BUILD_CLI)
  list(APPEND CPACK_COMPONENTS_ALL tools)
  jam_package(tools jam-tools science "Jammed packings of hard spheres: program jam-pack")
  set(CPACK_COMPONENT_TOOLS_DEPENDS runtime)
endif()
if(JAM_BUILD_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
  jam_package(python python3-jam python "Jammed packings of hard spheres: Python module")
  set(CPACK_COMPONENT_PYTHON_DEPENDS runtime)
  # the compiled module belongs to one minor version of Python
  execute_process(COMMAND ${JAM_PYTHON} -c
                  "import sys; v = sys.version_info; print(f'{v[0]}.{v[1]};{v[0]}.{v[1] + 1}', end='')"
                  OUTPUT_VARIABLE versions)
  list(GET versions 0 this)
  list(GET versions 1 next)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= ${this}), python3 (<< ${next}), python3-numpy")
  # as dh_python3 would write them
  file(WRITE ${PROJECT_BINARY_DIR}/debian/postinst "#!/bin/sh
set -e
if command -v py3compile >/dev/null; then py3compile -p python3-jam; fi
")
  file(WRITE ${PROJECT_BINARY_DIR}/debian/prerm "#!/bin/sh
set -e
if command -v py3clean >/dev/null; then py3clean -p python3-jam; fi
")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
      ${PROJECT_BINARY_DIR}/debian/postinst ${PROJECT_BINARY_DIR}/debian/prerm)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "python3-scipy, python3-matplotlib, python3-h5py, python3-tqdm")
endif()
include(CPack)
