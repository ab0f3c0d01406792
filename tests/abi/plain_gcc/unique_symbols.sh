#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# A plugin library that is built without any flag for visibility has no unique symbol (STB_GNU_UNIQUE) of the C++ layer or
# the toolkit: such a symbol is one object for the whole process, and a second library would use the first one's.
# Those of the standard library are the same text or number everywhere. Called as: unique_symbols.sh INCLUDE_DIR
set -uo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
include=$(realpath "$1")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
export here include scratch

# check COMPILER FLAG...: prints what is wrong
check() {
  local library=$scratch/$$.so unique
  if ! "$@" -shared -fPIC -I "$include" "$here/all_kinds.cpp" -o "$library" 2>&1; then
    echo "FAILED: $* does not compile all_kinds.cpp"
    return
  fi
  nm -D --defined-only "$library" | grep -q ' dmrp_entry_v1$' || echo "FAILED: $*: no dmrp_entry_v1 is exported"
  unique=$(nm -C "$library" | awk '$2 == "u"' | cut -d ' ' -f 3- | grep -v '^std::')
  [[ -z $unique ]] || echo "FAILED: $*: unique symbols:"$'\n'"$unique"
}
export -f check

# -fkeep-inline-functions: each function of the headers that is no template, whether it is called or not
builds=("g++ -std=c++17 -O0 -fkeep-inline-functions" "g++ -std=c++17 -O2" "g++ -std=c++20 -O0" "g++ -std=c++20 -O2")
! command -v clang++ >/dev/null || builds+=("clang++ -std=c++20 -O2")
problems=$(printf '%s\n' "${builds[@]}" | xargs -P 2 -L 1 bash -c 'check "$@"' _)
[[ -z $problems ]] || { echo "$problems"; exit 1; }
echo "${#builds[@]} builds without unique symbols"
