# ifov_embed_data(<target> <file> <symbol>): compiles a text file from data/ into a target, where
#   namespace ifov::data { extern const std::string_view <symbol>; }
# is its content. The source is made at build time, again whenever the file changes.
#
# As a script (cmake -P, with IN, OUT and SYMBOL set) it makes that source.
if(CMAKE_SCRIPT_MODE_FILE AND DEFINED SYMBOL)
  file(READ ${IN} content)
  # In pieces, because compilers limit the length of one literal.
  string(LENGTH "${content}" length)
  set(pieces "")
  set(at 0)
  while(at LESS length)
    string(SUBSTRING "${content}" ${at} 8000 piece)
    string(APPEND pieces "R\"data(${piece})data\"\n")
    math(EXPR at "${at} + 8000")
  endwhile()
  file(WRITE ${OUT} "#include <string_view>\n\nnamespace ifov::data {\nextern const std::string_view ${SYMBOL};\n"
                    "const std::string_view ${SYMBOL} =\n${pieces};\n}\n")
  return()
endif()

set(IFOV_EMBED_SCRIPT ${CMAKE_CURRENT_LIST_FILE})
function(ifov_embed_data target file symbol)
  set(source ${CMAKE_CURRENT_BINARY_DIR}/${symbol}.cpp)
  add_custom_command(OUTPUT ${source}
    COMMAND ${CMAKE_COMMAND} -DIN=${file} -DOUT=${source} -DSYMBOL=${symbol} -P ${IFOV_EMBED_SCRIPT}
    DEPENDS ${file} ${IFOV_EMBED_SCRIPT} VERBATIM)
  target_sources(${target} PRIVATE ${source})
endfunction()
