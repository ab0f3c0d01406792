#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Two plugin libraries with classes of the same name, built without any flag for visibility, do not disturb each other in
# one process. Called as: same_names.sh INCLUDE_DIR
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
include=$(realpath "$1")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

g++ -std=c++17 -I "$include" "$here/load_both.cpp" -ldl -o "$scratch/load_both"
compilers=(g++)
! command -v clang++ >/dev/null || compilers+=(clang++)
for compiler in "${compilers[@]}"; do
  for level in -O0 -O2; do
    for number in 1 2; do
      "$compiler" -std=c++17 "$level" -shared -fPIC -I "$include" -DNUMBER="$number" "$here/follower.cpp" \
        -o "$scratch/$number.so"
    done
    "$scratch/load_both" "$scratch/1.so" "$scratch/2.so" || { echo "FAILED: $compiler $level" && exit 1; }
  done
done
