#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Every header of the SDK compiles alone, and twice in a row, in the languages that it promises, by gcc and clang,
# without a warning. The C headers also have no padding that the compiler put in, declare everything as extern "C", and
# have at most 150 lines. Called as: headers.sh INCLUDE_DIR
set -uo pipefail
include=$(realpath "$1")

# compile COMPILER STANDARD HEADER...: prints what went wrong
compile() {
  local compiler=$1 standard=$2 language=c extra=""
  [[ $standard == *++* ]] && language=c++
  [[ $standard == c11 ]] && extra=-Wpadded
  printf '#include <dmrp/%s>\n' "${@:3}" "${@:3}" |
    "$compiler" -x "$language" -std="$standard" -pedantic -Wall -Wextra -Werror $extra -I "$include" -fsyntax-only - ||
    echo "FAILED: ${*:3} as $standard by $compiler"
}
export -f compile
export include

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
    lines=$(wc -l <"$header")
    ((lines <= 150)) || echo "FAILED: $header has $lines lines"
    ! grep -qE '^(typedef|struct|enum|extern|union) ' "$header" || grep -q '^extern "C" {$' "$header" ||
      echo "FAILED: $header declares without extern \"C\""
  done
}
problems=$(check_texts)
[[ -z $problems ]] || { echo "$problems"; exit 1; }

# The C headers by the first and the last standards and by C11, which finds padding. The C++ headers take longer: one by
# one in C++17 by the first compiler, all at once elsewhere.
list_compilations() {
  local compiler standard
  for compiler in "${compilers[@]}"; do
    for standard in c99 c11 c++11 c++20; do printf "$compiler $standard %s\n" "${c_headers[@]}"; done
    for standard in c++17 c++20; do echo "$compiler $standard ${cpp_headers[*]}"; done
  done
  printf "${compilers[0]} c++17 %s\n" "${cpp_headers[@]}"
}
problems=$(list_compilations | xargs -P 2 -L 1 bash -c 'compile "$@"' _ 2>&1)
[[ -z $problems ]] || { echo "$problems"; exit 1; }
echo "$(list_compilations | wc -l) compilations of ${#c_headers[@]} C and ${#cpp_headers[@]} C++ headers by ${compilers[*]}"
((skipped == 0)) || exit 77
