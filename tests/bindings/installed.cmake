# Runs installed.sh with the folders that the build has in its cache.
load_cache(${BUILD} READ_WITH_PREFIX cached_ JAM_PYTHON_DIR CMAKE_INSTALL_LIBDIR)
execute_process(COMMAND sh ${SOURCE}/tests/bindings/installed.sh ${BUILD} ${SOURCE} ${cached_JAM_PYTHON_DIR}
                ${cached_CMAKE_INSTALL_LIBDIR}
                RESULT_VARIABLE status)
if(status)
  message(FATAL_ERROR "installed.sh failed: ${status}")
endif()
