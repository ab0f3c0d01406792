# SPDX-License-Identifier: MIT
# dmrp_add_plugin(NAME SOURCES file... [LIBRARIES target...])
#
# Builds libNAME.so: a plugin library that exports dmrp_entry_v1 and nothing else.
function(dmrp_add_plugin name)
  # Of this file's folder, wherever the function is called from.
  set(version_script ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/plugin_exports.map)
  cmake_parse_arguments(PARSE_ARGV 1 plugin "" "" "SOURCES;LIBRARIES")
  if(NOT plugin_SOURCES OR plugin_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "dmrp_add_plugin(NAME SOURCES file... [LIBRARIES target...])")
  endif()
  add_library(${name} MODULE ${plugin_SOURCES})
  target_link_libraries(${name} PRIVATE dmrp::sdk ${plugin_LIBRARIES})
  # The C++ layer needs C++17; a plugin in C may belong to a project without C++.
  get_property(languages GLOBAL PROPERTY ENABLED_LANGUAGES)
  if(CXX IN_LIST languages)
    target_compile_features(${name} PRIVATE cxx_std_17)
  endif()
  # -ffp-contract=off: results must not depend on which instructions the compiler fuses.
  target_compile_options(${name} PRIVATE -ffp-contract=off)
  target_link_options(${name} PRIVATE -Wl,--version-script=${version_script})
  set_target_properties(
    ${name}
    PROPERTIES C_VISIBILITY_PRESET hidden
               CXX_VISIBILITY_PRESET hidden
               VISIBILITY_INLINES_HIDDEN ON
               POSITION_INDEPENDENT_CODE ON
               LINK_DEPENDS ${version_script})
endfunction()
