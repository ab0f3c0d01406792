#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# A library of built-in plugins passes every case, without a warning.
# Called as: built_in.sh DMRP_HOST LIBRARY
set -uo pipefail
found=$("$1" check "$2")
status=$?
if ((status != 0)) || grep -Eq '^  (warn|fail|crash) ' <<<"$found"; then
  echo "$found"
  echo "FAILED: status $status" >&2
  exit 1
fi
