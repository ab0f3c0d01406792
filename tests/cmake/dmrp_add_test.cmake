# SPDX-License-Identifier: MIT
# dmrp_add_test(NAME SOURCES file... [LIBRARIES target...] [WITHOUT_SANITIZERS])
#
# A Catch2 program. Each of its sources PATH_test.cpp is one test of CTest, FOLDER/PATH, whose output names what failed;
# `build/TREE/tests/NAME "name of a test case"` runs a single test case. Catch's main is linked, never compiled.
# A test whose output has "skipped: " counts as SKIPPED.
#
# Labels: FOLDER and unit. CI runs these tests in the presets release and clang, the latter under sanitizers.
#
#   WITHOUT_SANITIZERS   for what sanitizers would change or make too slow: absent where there are sanitizers
#
# The target tests_FOLDER builds the programs of one folder, the target `units` all of them.
add_custom_target(units)

# dmrp_run_nightly(TEST...): these tests of this folder cost more than they tell before each change: the preset nightly runs
# them, release does not.
function(dmrp_run_nightly)
  set_property(TEST ${ARGN} APPEND PROPERTY LABELS nightly)
endfunction()

# dmrp_sanitize_nightly(TEST...): these unit tests drive or search for so long that sanitizers take most of CI's time for
# them, on lines that other tests run too: release runs them, the preset clang does not, nightly does both.
function(dmrp_sanitize_nightly)
  if(DMRP_SANITIZE)
    set_property(TEST ${ARGN} APPEND PROPERTY LABELS long)
  endif()
endfunction()

function(dmrp_add_test name)
  cmake_parse_arguments(PARSE_ARGV 1 test "WITHOUT_SANITIZERS" "" "SOURCES;LIBRARIES")
  if(NOT test_SOURCES OR test_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "dmrp_add_test(NAME SOURCES file... [LIBRARIES target...] [WITHOUT_SANITIZERS])")
  endif()
  cmake_path(GET CMAKE_CURRENT_SOURCE_DIR FILENAME area)

  add_executable(${name} ${test_SOURCES})
  target_compile_definitions(${name} PRIVATE DMRP_TEST_DATA="${DMRP_TEST_DATA}"
                                             $<$<BOOL:${DMRP_FEWER_DRAWS}>:DMRP_FEWER_DRAWS>)
  target_link_libraries(${name} PRIVATE ${test_LIBRARIES} dmrp_test_settings Catch2::Catch2WithMain)
  dmrp_use_precompiled_headers(dmrp_test_headers ${name})
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  if(CMAKE_CURRENT_SOURCE_DIR MATCHES "/tests/unit/")  # where each file has a namespace of its own
    set_target_properties(${name} PROPERTIES UNITY_BUILD ${DMRP_UNITY_BUILD} UNITY_BUILD_BATCH_SIZE 24)
  endif()
  if(NOT TARGET tests_${area})
    add_custom_target(tests_${area})
  endif()
  add_dependencies(tests_${area} ${name})

  if(test_WITHOUT_SANITIZERS AND DMRP_SANITIZE)
    set_target_properties(${name} PROPERTIES EXCLUDE_FROM_ALL ON)
    return()
  endif()
  add_dependencies(units ${name})
  foreach(source IN LISTS test_SOURCES)
    if(source MATCHES "^(.*/)?([^/]+)_test\\.cpp$")
      set(test ${area}/${CMAKE_MATCH_1}${CMAKE_MATCH_2})
      add_test(NAME ${test} COMMAND ${name} --warn NoTests --filenames-as-tags "[#${CMAKE_MATCH_2}_test]")
      set_tests_properties(
        ${test} PROPERTIES LABELS "${area};unit" SKIP_REGULAR_EXPRESSION "skipped: " ENVIRONMENT
                           "LSAN_OPTIONS=suppressions=${PROJECT_SOURCE_DIR}/tests/support/leaks_of_others.txt:print_suppressions=0")
    endif()
  endforeach()
endfunction()
