# SPDX-License-Identifier: MIT
# ccache is used where it is found, unless a launcher is given or DMRP_CCACHE is OFF.
option(DMRP_CCACHE "Compile through ccache where it is found" ON)
find_program(DMRP_CCACHE_PROGRAM ccache)
mark_as_advanced(DMRP_CCACHE_PROGRAM)

if(DMRP_CCACHE AND DMRP_CCACHE_PROGRAM)
  # What its manual asks for where headers are precompiled.
  set(sloppiness pch_defines,time_macros,include_file_mtime,include_file_ctime)
  foreach(language C CXX)
    if(NOT CMAKE_${language}_COMPILER_LAUNCHER)
      set(CMAKE_${language}_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=${sloppiness}
                                              ${DMRP_CCACHE_PROGRAM})
    endif()
  endforeach()
endif()
