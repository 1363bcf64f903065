# One folder under src/ is one room: a static library ifov_<room> made of every .cpp in the folder, with the
# rooms below it that it may include (ROOMS) and the outside libraries it uses (LIBRARIES, private to it).
# Include paths start at src/, so that an include names the room it reaches into, and at include/ for the public headers.
# The code can stand in a shared library, and of it nothing is visible but what IFOV_API says (include/ifov/api.h).
function(ifov_room name)
  cmake_parse_arguments(ROOM "" "" "ROOMS;LIBRARIES" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  set(target ifov_${name})
  if(sources)
    add_library(${target} STATIC ${sources})
    set(scope PUBLIC)
    ifov_compile_options(${target})
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden
                                               VISIBILITY_INLINES_HIDDEN ON)
    target_link_libraries(${target} PRIVATE ${ROOM_LIBRARIES})
  else()
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
  endif()
  target_include_directories(${target} ${scope} ${CMAKE_SOURCE_DIR}/src ${CMAKE_SOURCE_DIR}/include)
  foreach(room ${ROOM_ROOMS})
    target_link_libraries(${target} ${scope} ifov_${room})
  endforeach()
endfunction()

# x86-64-v3 is the baseline, and no floating-point contraction: the same document gives the same bytes.
function(ifov_compile_options target)
  target_compile_options(${target} PRIVATE -march=x86-64-v3 -ffp-contract=off -fno-math-errno -Wall -Wextra
                         -Wshadow -Wconversion -Wno-sign-conversion -Werror)
  ifov_harden(${target})
endfunction()
