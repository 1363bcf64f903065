# One folder under src/ is one room: a static library ifov_<room> made of every .cpp in the folder, with the
# rooms below it that it may include (ROOMS) and the outside libraries it uses (LIBRARIES, private to it).
# Include paths start at src/, so that an include names the room it reaches into, and at include/ for the public headers.
# The code can stand in a shared library, and of it nothing is visible but what IFOV_API says (include/ifov/api.h).
function(ifov_room name)
  cmake_parse_arguments(ROOM "" "" "ROOMS;LIBRARIES" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  ifov_library(ifov_${name} "${sources}" "${ROOM_ROOMS}" "${ROOM_LIBRARIES}")
endfunction()

# A room that others want in part is several libraries ifov_<room>_<part>, each made of some of its folders (FOLDERS; "."
# for the room's own files).
# PARTS are those of the same room that it may include. ROOMS of whoever wants no more than a part names <room>_<part>;
# ifov_<room> is all parts that have been declared before ifov_whole_room.
function(ifov_part room part)
  cmake_parse_arguments(PART "" "" "FOLDERS;PARTS;ROOMS;LIBRARIES" ${ARGN})
  set(sources)
  foreach(folder ${PART_FOLDERS})
    if(folder STREQUAL ".")
      file(GLOB found CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
    else()
      file(GLOB_RECURSE found CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${folder}/*.cpp)
    endif()
    list(APPEND sources ${found})
  endforeach()
  list(TRANSFORM PART_PARTS PREPEND ${room}_)
  ifov_library(ifov_${room}_${part} "${sources}" "${PART_PARTS};${PART_ROOMS}" "${PART_LIBRARIES}")
  set_property(GLOBAL APPEND PROPERTY IFOV_PARTS_OF_${room} ifov_${room}_${part})
endfunction()

function(ifov_whole_room room)
  get_property(parts GLOBAL PROPERTY IFOV_PARTS_OF_${room})
  add_library(ifov_${room} INTERFACE)
  target_link_libraries(ifov_${room} INTERFACE ${parts})
endfunction()

function(ifov_library target sources rooms libraries)
  if(sources)
    add_library(${target} STATIC ${sources})
    set(scope PUBLIC)
    ifov_compile_options(${target})
    ifov_join_sources(${target} "${sources}")
    if(IFOV_JOIN_SOURCES)
      ifov_precompile(${target} FIRST ifov_core HEADERS <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <map>
                      <memory> <numbers> <optional> <span> <string> <string_view> <variant> <vector>)
    endif()
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden
                                               VISIBILITY_INLINES_HIDDEN ON)
    foreach(library ${libraries})
      string(MAKE_C_IDENTIFIER ifov_late_${library} late)
      if(TARGET ${late})
        set(library ${late})
      endif()
      target_link_libraries(${target} PRIVATE ${library})
    endforeach()
  else()
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
  endif()
  target_include_directories(${target} ${scope} ${CMAKE_SOURCE_DIR}/src ${CMAKE_SOURCE_DIR}/include)
  foreach(room ${rooms})
    target_link_libraries(${target} ${scope} ifov_${room})
  endforeach()
endfunction()

# The sources of a folder are compiled some at a time, which takes a fifth of the time: most of it went into the same headers.
# Names in unnamed namespaces of one folder must differ, therefore; where they rightly do not (a class Reader for each format), the
# folder stands in APART of its CMakeLists.txt. What is edited to add a model, a camera and so on is compiled alone, so that to add
# one takes seconds (tests/docs does it nine times). Debug builds and other compilers compile each source alone (Makefile).
option(IFOV_JOIN_SOURCES "Compile the sources of a folder some at a time" ON)
set(IFOV_JOINED 10)
set_property(DIRECTORY ${CMAKE_SOURCE_DIR} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS docs/developer/extending.md)
file(STRINGS ${CMAKE_SOURCE_DIR}/docs/developer/extending.md rows REGEX "^\\| \\[.*`src/")
string(REGEX MATCHALL "src/[a-z0-9_/]+\\.cpp" IFOV_EDITED_TO_ADD "${rows}")
function(ifov_join_sources target sources)
  if(NOT IFOV_JOIN_SOURCES)
    return()
  endif()
  foreach(source ${sources})
    get_filename_component(folder ${source} DIRECTORY)
    file(RELATIVE_PATH folder ${CMAKE_CURRENT_SOURCE_DIR} ${folder})
    string(MAKE_C_IDENTIFIER "in_${folder}" group)
    math(EXPR number "${count_${group}}0 / 10 / ${IFOV_JOINED}")
    math(EXPR count_${group} "${count_${group}}0 / 10 + 1")
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group}_${number})
    if("${folder}" STREQUAL "")
      set(folder .)
    endif()
    file(RELATIVE_PATH name ${CMAKE_SOURCE_DIR} ${source})
    if(folder IN_LIST APART OR name IN_LIST IFOV_EDITED_TO_ADD)
      set_source_files_properties(${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    endif()
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")  # takes a class of a source for one of a header
    target_compile_options(${target} PRIVATE -Wno-subobject-linkage)
  endif()
endfunction()

# No floating-point contraction: the same document gives the same bytes on all machines with one IFOV_MARCH.
set(IFOV_MARCH x86-64-v3 CACHE STRING "Instruction set (-march): x86-64-v2, x86-64-v3, x86-64-v4, native, ...")
function(ifov_compile_options target)
  target_compile_options(${target} PRIVATE -march=${IFOV_MARCH} -ffp-contract=off -fno-math-errno -Wall -Wextra
                         -Wshadow -Wconversion -Wno-sign-conversion -Werror)
  ifov_harden(${target})
endfunction()

# What a processor needs for IFOV_MARCH, as words of __builtin_cpu_supports, each of which src/cli/processor.cpp asks for; and the
# level of the x86-64 psABI that holds most of it (2 to 4, or 1), which the loader of libifov asks for.
function(ifov_processor_needs result level)
  execute_process(COMMAND ${CMAKE_CXX_COMPILER} -march=${IFOV_MARCH} -dM -E -x c++ /dev/null
                  OUTPUT_VARIABLE macros ERROR_VARIABLE error RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "IFOV_MARCH: the compiler does not know '${IFOV_MARCH}'; expected x86-64-v3 or another -march\n${error}")
  endif()
  set(needs "")
  foreach(feature SSE3 SSSE3 SSE4_1 SSE4_2 POPCNT AVX AVX2 BMI BMI2 FMA AVX512F AVX512BW AVX512CD AVX512DQ AVX512VL AVX512VBMI
                  AVX512VNNI AVX512BITALG VAES VPCLMULQDQ)
    if(macros MATCHES "#define __${feature}__ 1")
      string(TOLOWER ${feature} word)
      string(REPLACE "sse4_" "sse4." word ${word})
      string(APPEND needs "IFOV_NEEDS(${word}) ")
    endif()
  endforeach()
  set(${result} "${needs}" PARENT_SCOPE)

  set(highest 1)
  set(level_2 SSE3 SSSE3 SSE4_1 SSE4_2 POPCNT)
  set(level_3 AVX AVX2 BMI BMI2 F16C FMA LZCNT MOVBE)
  set(level_4 AVX512F AVX512BW AVX512CD AVX512DQ AVX512VL)
  foreach(above 2 3 4)
    math(EXPR below "${above} - 1")
    if(highest EQUAL below)
      set(highest ${above})
      foreach(feature ${level_${above}})
        if(NOT macros MATCHES "#define __${feature}__ 1")
          set(highest ${below})
        endif()
      endforeach()
    endif()
  endforeach()
  set(${level} ${highest} PARENT_SCOPE)
endfunction()
