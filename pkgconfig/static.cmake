# The target jam_static: libjam.a, which carries all of libjam. What it needs itself is told by jam.pc (pkg-config
# --static) and by the CMake target jam::static: JAM_STATIC_LIBRARIES.
add_library(jam_static STATIC $<TARGET_OBJECTS:jam_objects>)
add_library(jam::static ALIAS jam_static)
target_include_directories(jam_static PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
                                             $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
if(CMAKE_NM AND CMAKE_OBJCOPY)
  add_custom_command(TARGET jam_static POST_BUILD
                     COMMAND ${CMAKE_COMMAND} -DNM=${CMAKE_NM} -DOBJCOPY=${CMAKE_OBJCOPY}
                             -DARCHIVE=$<TARGET_FILE:jam_static>
                             -P ${PROJECT_SOURCE_DIR}/pkgconfig/static_names.cmake VERBATIM)
else()
  message(STATUS "libjam.a: without nm and objcopy functions of Eigen keep their names, which a program may have too")
endif()
set(JAM_STATIC_LIBRARIES ${JAM_BLAS_STATIC} ${CLP_STATIC_LDFLAGS} ${ZLIB_STATIC_LDFLAGS})
if(JAM_VORO)
  # by its name: a path would bind jam.pc to this machine, and to the shared library where both are there
  get_filename_component(voro_folder ${VORO_LIBRARY} DIRECTORY)
  if(NOT voro_folder IN_LIST CMAKE_CXX_IMPLICIT_LINK_DIRECTORIES)
    list(APPEND JAM_STATIC_LIBRARIES -L${voro_folder})
  endif()
  list(APPEND JAM_STATIC_LIBRARIES -lvoro++)
endif()
list(APPEND JAM_STATIC_LIBRARIES -lstdc++ -lpthread -lm)
if(CMAKE_DL_LIBS)
  list(APPEND JAM_STATIC_LIBRARIES -l${CMAKE_DL_LIBS})
endif()
target_link_libraries(jam_static INTERFACE ${JAM_STATIC_LIBRARIES})
set_target_properties(jam_static PROPERTIES OUTPUT_NAME jam EXPORT_NAME static)
