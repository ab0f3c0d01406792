# SPDX-License-Identifier: MIT
# dmrp_add_test(NAME SOURCES file... [LIBRARIES target...] [LABELS label...])
#
# A Catch2 program whose test cases become tests of CTest. Catch's main is linked, never compiled.
function(dmrp_add_test name)
  cmake_parse_arguments(PARSE_ARGV 1 test "" "" "SOURCES;LIBRARIES;LABELS")
  add_executable(${name} ${test_SOURCES})
  target_link_libraries(${name} PRIVATE ${test_LIBRARIES} dmrp_build_settings Catch2::Catch2WithMain)
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  if(test_LABELS)
    catch_discover_tests(${name} PROPERTIES LABELS "${test_LABELS}")
  else()
    catch_discover_tests(${name})
  endif()
endfunction()
