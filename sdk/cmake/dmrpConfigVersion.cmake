# SPDX-License-Identifier: MIT
# Before 1.0 a minor version may change the contract: find_package(dmrp 0.1) takes 0.1.x, find_package(dmrp 0) any 0.x.
include(${CMAKE_CURRENT_LIST_DIR}/dmrpSameMinorVersion.cmake)
if(PACKAGE_FIND_VERSION_COUNT EQUAL 1 AND PACKAGE_VERSION MATCHES "^${PACKAGE_FIND_VERSION_MAJOR}[.]")
  set(PACKAGE_VERSION_COMPATIBLE TRUE)
endif()
