# Writes OUTPUT, which defines the parts of the report page as text: cmake -DOUTPUT=FILE -DTEMPLATE=FILE -DSTYLE=FILE -DLIBRARY=FILE
# "-DSCRIPTS=FILE;FILE" -P embed.cmake. The scripts are joined in the order given.
cmake_minimum_required(VERSION 3.25)

set(source "#include \"support/report_parts.hpp\"\n\nnamespace examples {\n")
# Bytes as numbers: compilers need not take long texts.
function(embed name)
  set(bytes "")
  foreach(file IN LISTS ARGN)
    file(READ ${file} content HEX)
    string(APPEND bytes ${content} "0a")
  endforeach()
  string(REGEX REPLACE "(................................)" "\\1\n" bytes "${bytes}")
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
  set(source
      "${source}\nnamespace {\nconstexpr unsigned char ${name}_bytes[] = {\n${bytes}};\n}\n\nstd::string_view report_${name}() {\n  return {reinterpret_cast<const char*>(${name}_bytes), sizeof ${name}_bytes};\n}\n"
      PARENT_SCOPE)
endfunction()

embed(template ${TEMPLATE})
embed(style ${STYLE})
embed(library ${LIBRARY})
embed(script ${SCRIPTS})
file(WRITE ${OUTPUT} "${source}\n}  // namespace examples\n")
