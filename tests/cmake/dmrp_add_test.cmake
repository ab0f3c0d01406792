# SPDX-License-Identifier: MIT
# dmrp_add_test(NAME SOURCES file... [LIBRARIES target...] [GROUPS group...])
#
# A Catch2 program. Each group of its test cases is one test of CTest, whose output names what failed;
# `build/release/tests/NAME "name of a test case"` runs a single test case. Catch's main is linked, never compiled.
#
#   group      test cases              test                   label
#   fast       without the tags below  FOLDER/NAME            FOLDER, as in `ctest -L core`
#   slow       [slow]                  FOLDER/NAME/slow       slow: CI runs it without sanitizers only
#   data       [data]                  FOLDER/NAME/data       FOLDER; it reads DMRP_TEST_DATA, SKIPPED where there is none
#   slow_data  [data][slow]            FOLDER/NAME/slow_data  slow; likewise
#
# GROUPS names those that the program has; without it, it has fast ones only. An empty group fails.
# The target tests_FOLDER builds the programs of one folder.
function(dmrp_add_test name)
  cmake_parse_arguments(PARSE_ARGV 1 test "" "" "SOURCES;LIBRARIES;GROUPS")
  if(NOT test_SOURCES OR test_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "dmrp_add_test(NAME SOURCES file... [LIBRARIES target...] [GROUPS group...])")
  endif()
  cmake_path(GET CMAKE_CURRENT_SOURCE_DIR FILENAME area)

  add_executable(${name} ${test_SOURCES})
  target_compile_definitions(${name} PRIVATE DMRP_TEST_DATA="${DMRP_TEST_DATA}"
                                             $<$<BOOL:${DMRP_FEWER_DRAWS}>:DMRP_FEWER_DRAWS>)
  target_link_libraries(${name} PRIVATE ${test_LIBRARIES} dmrp_test_settings Catch2::Catch2WithMain)
  dmrp_use_precompiled_headers(dmrp_test_headers ${name})
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  if(NOT TARGET tests_${area})
    add_custom_target(tests_${area})
  endif()
  add_dependencies(tests_${area} ${name})

  if(NOT test_GROUPS)
    set(test_GROUPS fast)
  endif()
  foreach(group IN LISTS test_GROUPS)
    dmrp_add_test_group(${name} ${area} ${group})
  endforeach()
endfunction()

function(dmrp_add_test_group name area group)
  set(specification_fast "~[slow]~[data]")
  set(specification_slow "[slow]~[data]")
  set(specification_data "[data]~[slow]")
  set(specification_slow_data "[data][slow]")
  if(NOT DEFINED specification_${group})
    message(FATAL_ERROR "dmrp_add_test(${name}): there is no group ${group}")
  endif()

  set(test ${area}/${name}/${group})
  if(group STREQUAL fast)
    set(test ${area}/${name})
  endif()
  add_test(NAME ${test} COMMAND ${name} --warn NoTests ${specification_${group}})
  if(group MATCHES slow)
    set_tests_properties(${test} PROPERTIES LABELS slow)
  else()
    set_tests_properties(${test} PROPERTIES LABELS ${area})
  endif()
  # What skips where data are missing has the tag [data]; else the skip would count as passed.
  if(group MATCHES data)
    set_tests_properties(${test} PROPERTIES SKIP_REGULAR_EXPRESSION "skipped: ")
  else()
    set_tests_properties(${test} PROPERTIES FAIL_REGULAR_EXPRESSION "skipped: ")
  endif()
endfunction()
