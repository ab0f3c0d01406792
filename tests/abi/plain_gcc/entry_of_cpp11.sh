#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# A C++ file that defines a plugin with the C headers alone exports dmrp_entry_v1, under this name and whatever visibility
# it is compiled with, and loads. Called as: entry_of_cpp11.sh INCLUDE_DIR
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
include=$(realpath "$1")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

gcc -std=c99 -I "$include" "$here/describe.c" -ldl -o "$scratch/describe"
compilers=(g++)
! command -v clang++ >/dev/null || compilers+=(clang++)
for compiler in "${compilers[@]}"; do
  for visibility in default hidden; do
    "$compiler" -std=c++11 -pedantic -Wall -Wextra -Werror -shared -fPIC -fvisibility="$visibility" -I "$include" \
      "$here/in_cpp11.cpp" -o "$scratch/still.so"
    ids=$("$scratch/describe" "$scratch/still.so")
    [[ $ids == org.example.still ]] || { echo "FAILED: $compiler, visibility $visibility: '$ids'" && exit 1; }
  done
done
