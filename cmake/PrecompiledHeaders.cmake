# The standard library is most of what a source compiles: it is compiled once for all targets whose flags are the same. GCC takes the
# level of optimization from what was compiled before, whatever the source is told, and so there is one for each level. Where each
# source is compiled alone (IFOV_JOIN_SOURCES) nothing is, so that the build shows that it includes what it needs.
if(CCACHE)
  # ccache takes such objects only if it need not look for __TIME__ and #define in what was compiled before.
  execute_process(COMMAND ${CCACHE} --get-config sloppiness OUTPUT_VARIABLE CCACHE_SLOPPINESS OUTPUT_STRIP_TRAILING_WHITESPACE)
  string(REGEX REPLACE ", *" "," CCACHE_SLOPPINESS "pch_defines,time_macros,${CCACHE_SLOPPINESS}")
  string(REGEX REPLACE ",$" "" CCACHE_SLOPPINESS "${CCACHE_SLOPPINESS}")
endif()

# A target of headers alone, for ifov_precompile of others; its flags must be theirs.
function(ifov_precompiled name)
  set(source ${CMAKE_BINARY_DIR}/precompiled/${name}.cpp)
  if(NOT EXISTS ${source})
    file(WRITE ${source} "")
  endif()
  add_library(${name} OBJECT ${source})
  target_precompile_headers(${name} PRIVATE ${ARGN})
  ifov_precompiled_options(${name})
endfunction()

function(ifov_precompile target headers)
  target_precompile_headers(${target} REUSE_FROM ${headers})
  ifov_precompiled_options(${target})
endfunction()

function(ifov_precompiled_options target)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # In what was compiled before, GCC no longer knows the standard library's own lines, whose warnings it keeps to itself.
    target_compile_options(${target} PRIVATE -fpch-preprocess -Wno-array-bounds -Wno-restrict -Wno-stringop-overflow
                           -Wno-stringop-overread)
  else()
    target_compile_options(${target} PRIVATE "SHELL:-Xclang -fno-pch-timestamp")
  endif()
  if(CCACHE)
    set_target_properties(${target} PROPERTIES CXX_COMPILER_LAUNCHER
                          "env;CCACHE_SLOPPINESS=${CCACHE_SLOPPINESS};${CCACHE}")
  endif()
endfunction()
