# SPDX-License-Identifier: MIT
# What every target of the tree is compiled with: warnings, determinism, sanitizers.

add_library(dmrp_build_settings INTERFACE)

# -ffp-contract=off: the same bits everywhere, no fused multiply-add that the source does not ask for.
target_compile_options(
  dmrp_build_settings
  INTERFACE -ffp-contract=off
            -Wall
            -Wextra
            -Wpedantic
            -Wshadow
            -Wcast-align
            $<$<COMPILE_LANGUAGE:CXX>:-Woverloaded-virtual>
            $<$<COMPILE_LANGUAGE:CXX>:-Wnon-virtual-dtor>
            # False alarms of gcc 12 in its own string and vector at -O3 (its bug 105651 and relatives).
            "$<$<CXX_COMPILER_ID:GNU>:-Wno-restrict;-Wno-stringop-overflow;-Wno-array-bounds;-Wno-stringop-overread>"
            $<$<BOOL:${DMRP_WARNINGS_AS_ERRORS}>:-Werror>)

if(DMRP_SANITIZE)
  target_compile_options(dmrp_build_settings INTERFACE -fsanitize=${DMRP_SANITIZE} -fno-omit-frame-pointer
                                                       -fno-sanitize-recover=all)
  target_link_options(dmrp_build_settings INTERFACE -fsanitize=${DMRP_SANITIZE})
endif()
