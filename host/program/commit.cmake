# SPDX-License-Identifier: MIT
# Writes the definition of host/program/commit.hpp, if it changes. Called with -D OUT=FILE -D SOURCE=DIR.
cmake_minimum_required(VERSION 3.25)
execute_process(
  COMMAND git -C ${SOURCE} describe --always --dirty --abbrev=12 --exclude=*
  OUTPUT_VARIABLE commit
  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT commit)
  set(commit "unknown")
endif()
file(CONFIGURE OUTPUT ${OUT} CONTENT "#include \"host/program/commit.hpp\"
const char* const dmrp::host::commit = \"@commit@\";
" @ONLY)
