# One test of ctest for each suite of a GoogleTest program, `room.Suite`, and not for each of its tests: some 1,500 starts of a
# process cost more than most of the tests do. A suite that fails names its tests (ctest --output-on-failure), and
# tools/run_tests.py counts and names them one by one.
#
# Included by CMake, it defines ifov_discover_suites(); run with -P after a program is linked, it writes the program's tests.
if(NOT CMAKE_SCRIPT_MODE_FILE)
  set(IFOV_SUITES_SCRIPT ${CMAKE_CURRENT_LIST_FILE})

  function(ifov_discover_suites target room)
    set(listed ${CMAKE_CURRENT_BINARY_DIR}/${target}_suites.cmake)
    set(included ${CMAKE_CURRENT_BINARY_DIR}/${target}_include.cmake)
    file(WRITE ${included} "if(EXISTS \"${listed}\")\n  include(\"${listed}\")\nelse()\n  add_test(${room}.NOT_BUILT ${target}_NOT_BUILT)\nendif()\n")
    set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${included})
    add_custom_command(TARGET ${target} POST_BUILD BYPRODUCTS ${listed} VERBATIM
      COMMAND ${CMAKE_COMMAND} -D PROGRAM=$<TARGET_FILE:${target}> -D ROOM=${room} -D LISTED=${listed} -P ${IFOV_SUITES_SCRIPT})
  endfunction()
  return()
endif()

execute_process(COMMAND ${PROGRAM} --gtest_list_tests OUTPUT_VARIABLE output RESULT_VARIABLE result TIMEOUT 60)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "${PROGRAM} --gtest_list_tests: ${result}\n${output}")
endif()
# Its lines: `Suite.`, then two spaces and the name of each of its tests, both perhaps with a comment.
string(REGEX REPLACE "[][;]" " " output "${output}")
string(REPLACE "\n" ";" lines "${output}")
set(suites)
foreach(line ${lines})
  if(line MATCHES "^([A-Za-z0-9_/]+)[.]( +#.*)?$")
    set(suite ${CMAKE_MATCH_1})
    list(APPEND suites ${suite})
    set(tests_of_${suite} 0)
  elseif(line MATCHES "^  [A-Za-z0-9_]")
    math(EXPR tests_of_${suite} "${tests_of_${suite}} + 1")
  endif()
endforeach()
# Suites of many tests first, and before them those of few that take longest, so that none of them is left over at the end.
set(longest session.DirectionalSurroundings facade.FileAssets transport.Rami studies.SensorStudy studies.AtmosphereNodes
            studies.AtmosphereFluxes studies.TemperatureStudy exposure.SurfacesOfTimes exposure.ImageHalfWidths
            atmosphere.AtmosphereErrorTest atmosphere.CloudsRoundEarth atmosphere.LinesOfSight session.CachedAtmosphere
            session.MappedParameters session.PolarizedSkylight render.Highlights)
set(script)
foreach(suite ${suites})
  set(cost ${tests_of_${suite}})
  list(FIND longest "${ROOM}.${suite}" place)
  if(NOT place EQUAL -1)
    set(cost 90)
  endif()
  string(APPEND script "add_test(\"${ROOM}.${suite}\" \"${PROGRAM}\" \"--gtest_filter=${suite}.*\")\n"
    "set_tests_properties(\"${ROOM}.${suite}\" PROPERTIES TIMEOUT 600 COST ${cost})\n")
endforeach()
file(WRITE ${LISTED} "${script}")
