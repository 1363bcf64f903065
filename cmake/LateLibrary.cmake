# ifov_late_library(<target> <name>): who names <target> among the outside LIBRARIES of a room gets its headers and the definition
#   IFOV_LATE_<NAME>="lib<name>.so.32"
# and does not link it: the library, which the system's linker finds as <name>, is loaded when a function of it is first called
# (core/late_library.h). A call that goes past that is an undefined reference.
function(ifov_late_library target name)
  string(TOUPPER ${name} word)
  find_library(IFOV_FILE_${word} ${name} REQUIRED)
  mark_as_advanced(IFOV_FILE_${word})
  execute_process(COMMAND ${CMAKE_OBJDUMP} -p ${IFOV_FILE_${word}} OUTPUT_VARIABLE about ERROR_QUIET)
  if(NOT about MATCHES "SONAME +([^ \n]+)")
    message(FATAL_ERROR "${IFOV_FILE_${word}} is no shared library with a name of its own (SONAME)")
  endif()
  string(MAKE_C_IDENTIFIER ifov_late_${target} late)
  add_library(${late} INTERFACE)
  target_include_directories(${late} SYSTEM INTERFACE $<TARGET_PROPERTY:${target},INTERFACE_INCLUDE_DIRECTORIES>)
  target_compile_definitions(${late} INTERFACE "IFOV_LATE_${word}=\"${CMAKE_MATCH_1}\"")
endfunction()
