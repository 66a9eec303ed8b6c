# Installs library, header, pkg-config files and the CMake package; included at the end of the top CMakeLists.txt.
# Components: runtime (the shared library), dev (what compiles against it), python, tools (jam-pack), doc, guide,
# license.
include(CMakePackageConfigHelpers)
set(JAM_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/jam)

install(TARGETS jam EXPORT jamTargets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT runtime
        NAMELINK_COMPONENT dev)
if(JAM_BUILD_STATIC)
  install(TARGETS jam_static EXPORT jamTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT dev)
  list(JOIN JAM_STATIC_LIBRARIES " " private_libraries)
endif()
# A component of its own: Debian's packages have the licence in their copyright files.
install(FILES LICENSE pkgconfig/LINKED.md DESTINATION ${CMAKE_INSTALL_DATADIR}/licenses/libjam COMPONENT license)
install(FILES include/jam/jam.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/jam COMPONENT dev)

# The .pc files are written at install time, since `cmake --install --prefix` may name another prefix than the
# configured
# one. They hold full directories: GNUInstallDirs allows absolute ones, which a prefix glued in front would break.
set(pc_files jam)
if(JAM_BUILD_FORTRAN)
  list(APPEND pc_files jam-fortran)
endif()
install(CODE "
  set(CMAKE_INSTALL_FULL_LIBDIR \"${CMAKE_INSTALL_LIBDIR}\")
  set(CMAKE_INSTALL_FULL_INCLUDEDIR \"${CMAKE_INSTALL_INCLUDEDIR}\")
  foreach(dir CMAKE_INSTALL_FULL_LIBDIR CMAKE_INSTALL_FULL_INCLUDEDIR)
    get_filename_component(\${dir} \"\${\${dir}}\" ABSOLUTE BASE_DIR \"\${CMAKE_INSTALL_PREFIX}\")
  endforeach()
  set(PROJECT_DESCRIPTION \"${PROJECT_DESCRIPTION}\")
  set(PROJECT_VERSION \"${PROJECT_VERSION}\")
  set(JAM_LIBS_PRIVATE \"${private_libraries}\")
  foreach(name ${pc_files})
    configure_file(\"${PROJECT_SOURCE_DIR}/pkgconfig/\${name}.pc.in\" \"${PROJECT_BINARY_DIR}/\${name}.pc\" @ONLY)
  endforeach()
  message(STATUS \"pkg-config: PKG_CONFIG_PATH=\${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig\")
" COMPONENT dev)
foreach(name ${pc_files})
  install(FILES ${PROJECT_BINARY_DIR}/${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT dev)
endforeach()

configure_package_config_file(pkgconfig/jamConfig.cmake.in jamConfig.cmake INSTALL_DESTINATION ${JAM_CMAKE_DIR})
# Before 1.0 a minor release may change the API.
if(PROJECT_VERSION_MAJOR EQUAL 0)
  set(compatibility SameMinorVersion)
else()
  set(compatibility SameMajorVersion)
endif()
write_basic_package_version_file(jamConfigVersion.cmake COMPATIBILITY ${compatibility})
install(FILES ${PROJECT_BINARY_DIR}/jamConfig.cmake ${PROJECT_BINARY_DIR}/jamConfigVersion.cmake
        DESTINATION ${JAM_CMAKE_DIR} COMPONENT dev)
install(EXPORT jamTargets NAMESPACE jam:: DESTINATION ${JAM_CMAKE_DIR} COMPONENT dev)

if(PROJECT_IS_TOP_LEVEL)
  add_custom_target(uninstall COMMAND ${CMAKE_COMMAND} -DBUILD=${PROJECT_BINARY_DIR}
                                      -P ${PROJECT_SOURCE_DIR}/pkgconfig/uninstall.cmake VERBATIM)
  include(pkgconfig/package.cmake)
endif()
