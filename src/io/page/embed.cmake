# Puts the parts of the page into one C++ file: page.html with page.css and all scripts, in order of their names.
#   cmake -DFOLDER=... -DOUT=... -P embed.cmake
file(READ ${FOLDER}/page.html html)
file(READ ${FOLDER}/page.css css)
file(GLOB scripts ${FOLDER}/*.js)
list(SORT scripts)
set(js "")
foreach(script ${scripts})
  file(READ ${script} text)
  string(APPEND js "${text}")
endforeach()
string(REPLACE "@CSS@" "${css}" html "${html}")
string(REPLACE "@JS@" "${js}" html "${html}")
string(FIND "${html}" "@DATA@" place)
string(SUBSTRING "${html}" 0 ${place} head)
math(EXPR place "${place} + 6")
string(SUBSTRING "${html}" ${place} -1 tail)
# Raw strings of at most 64 KiB each are what every compiler takes.
file(WRITE ${OUT} "#include \"io/page.hpp\"\nnamespace jam::inside {\n"
                  "const char *const page_head = R\"JAM(${head})JAM\";\n"
                  "const char *const page_tail = R\"JAM(${tail})JAM\";\n}  // namespace jam::inside\n")
