#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# A library that is built with AddressSanitizer is checked by a host that is not: no limit of memory ends it, and what the
# sanitizer finds is a finding. Called as: sanitized.sh DMRP_HOST LIBRARY C_COMPILER
set -uo pipefail
host=$1 library=$2
runtime=$("$3" -print-file-name=libasan.so)
if [[ ! -e $runtime ]]; then
  echo "skipped: $3 has no libasan.so"
  exit 77
fi
found=$(mktemp)
trap 'rm -f "$found"' EXIT

fail() {
  cat "$found"
  echo "FAILED: $*" >&2
  exit 1
}
check() {
  LD_PRELOAD=$runtime ASAN_OPTIONS=detect_leaks=0 "$host" check "$library" --only "$1" >"$found" 2>&1
}

check 'status|memory' || fail "the library has no fault"
grep -q '^  skip *memory/bounds, memory/leaks: a sanitizer' "$found" || fail "leaks are not counted"
export DMRP_TEST_FAULT='reads freed memory'
! check 'status/ordinary' || fail "freed memory is read"
grep -q '^  crash *status/ordinary_trial: .*step()' "$found" || fail "the finding names step()"
grep -q 'it printed: .*heap-use-after-free' "$found" || fail "the sanitizer's words should be there"
