#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Every header of the SDK compiles alone, and twice in a row, in the languages that it promises, by gcc and clang,
# without a warning, and the templates of EXAMPLES_DIR compile. The C headers also have no padding that the compiler put
# in, declare everything as extern "C", and have at most 150 lines, without what later minor versions append.
# Called as: headers.sh INCLUDE_DIR EXAMPLES_DIR [FLAG of the compilers]
set -uo pipefail
include=$(realpath "$1") examples=$(realpath "$2") flag=${3:-}

# compile COMPILER STANDARD SOURCE|HEADER...: prints what went wrong
compile() {
  local compiler=$1 standard=$2 flags=(-x c)
  [[ $standard == *++* ]] && flags=(-x c++)
  [[ $standard == c11 && $3 == *.h ]] && flags+=(-Wpadded)
  flags+=(-std="$standard" -pedantic -Wall -Wextra -Wconversion -Werror -I "$include" -fsyntax-only)
  [[ -z $flag ]] || flags+=("$flag")
  if [[ $3 == /* ]]; then cat "$3"; else printf '#include <dmrp/%s>\n' "${@:3}" "${@:3}"; fi |
    "$compiler" "${flags[@]}" - || echo "FAILED: ${*:3} as $standard by $compiler"
}
export -f compile
export include flag

compilers=()
for compiler in gcc clang; do
  if command -v "$compiler" >/dev/null; then
    compilers+=("$compiler")
  else
    echo "skipped: $compiler is not there"
  fi
done
((${#compilers[@]} > 0)) || exit 1
skipped=$((2 - ${#compilers[@]}))

cd "$include/dmrp" || exit 1
mapfile -t c_headers < <(find . -name '*.h' -printf '%P\n' | sort)
mapfile -t cpp_headers < <(find . -name '*.hpp' -printf '%P\n' | sort)
((${#c_headers[@]} > 0 && ${#cpp_headers[@]} > 0)) || { echo "FAILED: no headers in $include/dmrp"; exit 1; }

# dmrp.h and status.h declare nothing of their own, and neither does abi.h but in macros.
check_texts() {
  local header lines
  for header in "${c_headers[@]}"; do
    lines=$(awk '/^#if DMRP_TARGET_MINOR/, /^#endif/ { next } { ++count } END { print count }' "$header")
    ((lines <= 150)) || echo "FAILED: $header has $lines lines"
    ! grep -qE '^(typedef|struct|enum|extern|union) ' "$header" || grep -q '^extern "C" {$' "$header" ||
      echo "FAILED: $header declares without extern \"C\""
  done
}
problems=$(check_texts)
[[ -z $problems ]] || { echo "$problems"; exit 1; }

# The C headers one by one by the first and the last standards and by C11, which finds padding. The C++ headers take
# longer: one by one in C++17 by the first compiler, all at once elsewhere. Each compiler compiles the templates once.
list_compilations() {
  local compiler standard
  for compiler in "${compilers[@]}"; do
    for standard in c99 c11 c++11 c++20; do printf "$compiler $standard %s\n" "${c_headers[@]}"; done
    for standard in c17 c++14 c++17; do echo "$compiler $standard ${c_headers[*]}"; done
    for standard in c++17 c++20; do echo "$compiler $standard ${cpp_headers[*]}"; done
    for standard in c99 c11 c17; do echo "$compiler $standard $examples/other_languages/planner.c"; done
  done
  printf "${compilers[0]} c++17 %s\n" "${cpp_headers[@]}" "$examples"/templates/*/my_plugin.cpp
  printf "${compilers[-1]} c++20 %s\n" "$examples"/templates/*/my_plugin.cpp
}
problems=$(list_compilations | xargs -P 2 -L 1 bash -c 'compile "$@"' _ 2>&1)
[[ -z $problems ]] || { echo "$problems"; exit 1; }
count=$(list_compilations | wc -l)
echo "$count compilations of ${#c_headers[@]} C and ${#cpp_headers[@]} C++ headers and the templates by ${compilers[*]}"
((skipped == 0)) || exit 77
