# SPDX-License-Identifier: MIT
# What every target of the tree is compiled with: warnings, determinism, sanitizers.

# dmrp_build_settings: for all but Catch2 programs, which take dmrp_test_settings. The address and undefined-behaviour
# sanitizers watch what these programs link, not the tests' own sources: they are half of what there is to compile, and
# instrumented they take twice as long.
add_library(dmrp_build_settings INTERFACE)
add_library(dmrp_test_settings INTERFACE)
add_library(dmrp_sanitizers INTERFACE)
target_link_libraries(dmrp_build_settings INTERFACE dmrp_test_settings dmrp_sanitizers)

# -ffp-contract=off: the same bits everywhere, no fused multiply-add that the source does not ask for.
target_compile_options(
  dmrp_test_settings
  INTERFACE -ffp-contract=off
            -Wall
            -Wextra
            -Wpedantic
            # A batch has the anonymous names of several sources; the release build with tests checks each alone.
            $<IF:$<BOOL:${DMRP_UNITY_BUILD}>,-Wno-shadow,-Wshadow>
            # A batch is no header: what it includes may use anonymous names.
            $<$<AND:$<BOOL:${DMRP_UNITY_BUILD}>,$<COMPILE_LANG_AND_ID:CXX,GNU>>:-Wno-subobject-linkage>
            -Wcast-align
            $<$<COMPILE_LANGUAGE:CXX>:-Woverloaded-virtual>
            $<$<COMPILE_LANGUAGE:CXX>:-Wnon-virtual-dtor>
            # False alarms of gcc 12 in its own string and vector at -O3 (its bug 105651 and relatives).
            "$<$<CXX_COMPILER_ID:GNU>:-Wno-restrict;-Wno-stringop-overflow;-Wno-array-bounds;-Wno-stringop-overread>"
            $<$<BOOL:${DMRP_WARNINGS_AS_ERRORS}>:-Werror>)

if(DMRP_SANITIZE)
  target_compile_options(dmrp_sanitizers INTERFACE -fsanitize=${DMRP_SANITIZE} -fno-omit-frame-pointer
                                                   -fno-sanitize-recover=all)
  target_link_options(dmrp_test_settings INTERFACE -fsanitize=${DMRP_SANITIZE})
endif()
if(DMRP_SANITIZE STREQUAL "thread") # it misunderstands what it does not see
  target_link_libraries(dmrp_test_settings INTERFACE dmrp_sanitizers)
endif()
