# cmake -DIN=jam.h -DOUT=FILE -P bare_header.cmake: the header without its comments. OUT stays untouched where it would
# be the same, so that an edited comment compiles nothing again.
file(READ ${IN} text)
string(REGEX REPLACE "/\\*([^*]|\\*+[^*/])*\\*+/" "" text "${text}")
string(REGEX REPLACE "[ \t\n]*\n" "\n" text "${text}")
set(had "")
if(EXISTS ${OUT})
  file(READ ${OUT} had)
endif()
if(NOT had STREQUAL text)
  file(WRITE ${OUT} "${text}")
endif()
