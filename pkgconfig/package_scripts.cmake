# CPack writes scripts that call ldconfig into every package with a shared library. libjam1 has a trigger for it, and
# Debian's policy allows one of the two.
foreach(package ${CPACK_PACKAGE_FILES})
  if(NOT package MATCHES "/libjam[0-9]+_")
    continue()
  endif()
  set(tree ${package}.tree)
  execute_process(COMMAND dpkg-deb -R ${package} ${tree} COMMAND_ERROR_IS_FATAL ANY)
  file(REMOVE ${tree}/DEBIAN/postinst ${tree}/DEBIAN/postrm)
  execute_process(COMMAND dpkg-deb --root-owner-group -b ${tree} ${package} OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
  file(REMOVE_RECURSE ${tree})
endforeach()
