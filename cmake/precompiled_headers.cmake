# SPDX-License-Identifier: MIT
# Headers that many sources include are compiled once. No source relies on it: each includes what it uses, and compiles
# with CMAKE_DISABLE_PRECOMPILE_HEADERS=ON too (.ci/nightly). Headers of this tree are never among them: a change of one
# would rebuild everything.

# The parts of the standard library that are large, or that nearly every source includes.
set(DMRP_STANDARD_HEADERS
    <algorithm>
    <array>
    <cmath>
    <cstdint>
    <filesystem>
    <fstream>
    <functional>
    <limits>
    <map>
    <memory>
    <numbers>
    <numeric>
    <optional>
    <set>
    <span>
    <sstream>
    <stdexcept>
    <string>
    <string_view>
    <tuple>
    <utility>
    <variant>
    <vector>)

# dmrp_add_precompiled_headers(NAME HEADERS <header>... LIBRARIES target... [OPTIONS option...] [EXECUTABLE])
# A set of headers, for targets with the same flags: OPTIONS and what LIBRARIES ask for. As for a library, or with
# EXECUTABLE as for a program: their position-independent code differs.
function(dmrp_add_precompiled_headers name)
  cmake_parse_arguments(PARSE_ARGV 1 set "EXECUTABLE" "" "HEADERS;LIBRARIES;OPTIONS")
  add_library(${name} OBJECT ${PROJECT_SOURCE_DIR}/cmake/precompiled_headers.cpp)
  if(set_EXECUTABLE)
    set_target_properties(${name} PROPERTIES POSITION_INDEPENDENT_CODE OFF)
    list(APPEND set_OPTIONS -fPIE)
  endif()
  target_compile_options(${name} PRIVATE ${set_OPTIONS})
  target_link_libraries(${name} PRIVATE ${set_LIBRARIES})
  target_precompile_headers(${name} PRIVATE ${set_HEADERS})
endfunction()

# dmrp_use_precompiled_headers(NAME TARGET...)
function(dmrp_use_precompiled_headers name)
  foreach(target IN LISTS ARGN)
    target_precompile_headers(${target} REUSE_FROM ${name})
  endforeach()
endfunction()
