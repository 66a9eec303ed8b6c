# The installed targets name the shared library, so a triplet of static libraries gets it too, with a note.
vcpkg_check_linkage(ONLY_DYNAMIC_LIBRARY)
vcpkg_from_github(OUT_SOURCE_PATH SOURCE_PATH REPO libjam/libjam REF "v${VERSION}" SHA512 0 HEAD_REF main)
vcpkg_find_acquire_program(PKGCONFIG)
vcpkg_cmake_configure(
  SOURCE_PATH "${SOURCE_PATH}"
  OPTIONS -DJAM_LAPACK=OFF -DJAM_CLP=OFF -DJAM_USE_VORO=OFF -DJAM_BUILD_CLI=OFF -DJAM_BUILD_TESTS=OFF
          -DJAM_BUILD_EXAMPLES=OFF "-DPKG_CONFIG_EXECUTABLE=${PKGCONFIG}")
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(PACKAGE_NAME jam CONFIG_PATH lib/cmake/jam)
vcpkg_fixup_pkgconfig()
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share")
file(INSTALL "${CMAKE_CURRENT_LIST_DIR}/usage" DESTINATION "${CURRENT_PACKAGES_DIR}/share/${PORT}")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE" "${SOURCE_PATH}/pkgconfig/LINKED.md")
