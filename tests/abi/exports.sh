#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# A plugin library exports one symbol and needs nothing but the C++ library.
# Called as: exports.sh LIBRARY [SANITIZERS], which bring libraries of their own.
set -euo pipefail
library=$1
exported=$(nm -D --defined-only "$library" | awk '{print $3}')
if [[ $exported != dmrp_entry_v1 ]]; then
  echo "$library exports $(paste -sd ' ' <<<"$exported")"
  exit 1
fi
[[ -z ${2:-} ]] || exit 0
strange=$(objdump -p "$library" | awk '$1 == "NEEDED" {print $2}' |
  grep -Ev '^(libstdc\+\+|libm|libgcc_s|libc|ld-linux.*)\.so\.[0-9]+$' || true)
if [[ -n $strange ]]; then
  echo "$library needs $(paste -sd ' ' <<<"$strange")"
  exit 1
fi
