# SPDX-License-Identifier: MIT
# dmrp_add_test(NAME SOURCES file... [LIBRARIES target...] [SLOW])
#
# A Catch2 program whose test cases become tests of CTest. Catch's main is linked, never compiled.
# The label of a test is its folder's name (`ctest -L core`). SLOW says that the program has test cases with the tag
# [slow]: they get the label slow instead, and CI runs them without sanitizers only.
# The target tests_FOLDER builds the programs of one folder.
function(dmrp_add_test name)
  cmake_parse_arguments(PARSE_ARGV 1 test "SLOW" "" "SOURCES;LIBRARIES")
  if(NOT test_SOURCES OR test_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "dmrp_add_test(NAME SOURCES file... [LIBRARIES target...] [SLOW])")
  endif()
  cmake_path(GET CMAKE_CURRENT_SOURCE_DIR FILENAME area)

  add_executable(${name} ${test_SOURCES})
  target_compile_definitions(${name} PRIVATE DMRP_TEST_DATA="${DMRP_TEST_DATA}")
  target_link_libraries(${name} PRIVATE ${test_LIBRARIES} dmrp_build_settings Catch2::Catch2WithMain)
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  if(NOT TARGET tests_${area})
    add_custom_target(tests_${area})
  endif()
  add_dependencies(tests_${area} ${name})

  if(test_SLOW)
    catch_discover_tests(${name} TEST_SPEC "~[slow]" TEST_PREFIX "${area}/" PROPERTIES LABELS ${area})
    catch_discover_tests(${name} TEST_SPEC "[slow]" TEST_PREFIX "${area}/" PROPERTIES LABELS slow)
  else()
    catch_discover_tests(${name} TEST_PREFIX "${area}/" PROPERTIES LABELS ${area})
  endif()
endfunction()
