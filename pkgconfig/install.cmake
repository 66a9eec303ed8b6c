# Installs library, header, jam.pc and the CMake package; included at the end of the top CMakeLists.txt.
include(CMakePackageConfigHelpers)
set(JAM_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/jam)

install(TARGETS jam EXPORT jamTargets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(FILES include/jam/jam.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/jam)

# jam.pc is written at install time, since `cmake --install --prefix` may name another prefix than the configured one.
# It holds full directories: GNUInstallDirs allows absolute ones, which a prefix glued in front would break.
install(CODE "
  set(CMAKE_INSTALL_FULL_LIBDIR \"${CMAKE_INSTALL_LIBDIR}\")
  set(CMAKE_INSTALL_FULL_INCLUDEDIR \"${CMAKE_INSTALL_INCLUDEDIR}\")
  foreach(dir CMAKE_INSTALL_FULL_LIBDIR CMAKE_INSTALL_FULL_INCLUDEDIR)
    get_filename_component(\${dir} \"\${\${dir}}\" ABSOLUTE BASE_DIR \"\${CMAKE_INSTALL_PREFIX}\")
  endforeach()
  set(PROJECT_DESCRIPTION \"${PROJECT_DESCRIPTION}\")
  set(PROJECT_VERSION \"${PROJECT_VERSION}\")
  configure_file(\"${PROJECT_SOURCE_DIR}/pkgconfig/jam.pc.in\" \"${PROJECT_BINARY_DIR}/jam.pc\" @ONLY)
")
install(FILES ${PROJECT_BINARY_DIR}/jam.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

configure_package_config_file(pkgconfig/jamConfig.cmake.in jamConfig.cmake INSTALL_DESTINATION ${JAM_CMAKE_DIR})
# Before 1.0 a minor release may change the API.
write_basic_package_version_file(jamConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/jamConfig.cmake ${PROJECT_BINARY_DIR}/jamConfigVersion.cmake DESTINATION ${JAM_CMAKE_DIR})
install(EXPORT jamTargets NAMESPACE jam:: DESTINATION ${JAM_CMAKE_DIR})

include(pkgconfig/package.cmake)
