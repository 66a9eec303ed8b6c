# cmake -DNM= -DOBJCOPY= -DARCHIVE= -P static_names.cmake: gives the C++ names of a static library that are not in
# jam::inside a prefix of their own. They are inline functions of Eigen and others. A program has them too, where it
# uses Eigen, and the linker keeps one of two: compiled there with -mavx2, vectors are aligned to 32 bytes, and libjam,
# which frees them, takes 16. Names of section groups (n of nm) change with those of their functions.
execute_process(COMMAND ${NM} -P ${ARCHIVE} OUTPUT_VARIABLE listed ERROR_QUIET COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "\n_Z[^ \n]+ [A-TV-Zun] " names "${listed}")
list(TRANSFORM names REPLACE "^.(_Z[^ ]+).*" "\\1")
list(FILTER names EXCLUDE REGEX "3jam6inside")
list(REMOVE_DUPLICATES names)
list(TRANSFORM names REPLACE "(.+)" "\\1 jam_inside\\1")
list(JOIN names "\n" names)
file(WRITE ${ARCHIVE}.names "${names}\n")
execute_process(COMMAND ${OBJCOPY} -D --redefine-syms=${ARCHIVE}.names ${ARCHIVE} COMMAND_ERROR_IS_FATAL ANY)
