#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# check.sh SOURCE_DIR: what a script can check of CONTRIBUTING.md's dialect. Prints each breach as file:line: text; exit
# status 1 if there is one.
set -euo pipefail
shopt -s inherit_errexit
export LC_ALL=C
cd "$1"
breaches=0

breach() {
  echo "$1: $2"
  breaches=$((breaches + 1))
}

# files PATTERN FOLDER...: the files of these folders whose path matches; frozen headers are copies
files() {
  local pattern=$1
  shift
  find "$@" \( -name build -o -name node_modules -o -path '*/abi/frozen/1.0' \) -prune -o -type f -regextype egrep -regex "$pattern" -print | sort
}

# forbid WHY PATTERN FILE...: reports every line that matches
forbid() {
  local why=$1 pattern=$2 file line text
  shift 2
  while IFS=: read -r file line text; do
    breach "$file:$line" "$why: $text"
  done < <(grep -nHE "$pattern" "$@" || true)
}

# report_from AWK_PROGRAM FILE...: a breach for each line `FILE:LINE<tab>TEXT` that the program prints
report_from() {
  local place text
  while IFS=$'\t' read -r place text; do
    breach "$place" "$text"
  done < <(awk "$@")
}

# the first line, or the second after #!
check_licences() {
  report_from 'FNR == 1 || (FNR == 2 && after_interpreter) {
      after_interpreter = FNR == 1 && /^#!/
      if (!after_interpreter && !/SPDX-License-Identifier: MIT/) print FILENAME ":" FNR "\tdoes not begin with the SPDX line"
    }' "$@"
}

# the first line of a C++ header that is no comment
check_pragma_once() {
  # shellcheck disable=SC2016
  report_from 'FNR == 1 { begun = 0 }
    !begun && !/^[ \t]*(\/\/.*)?$/ {
      begun = 1
      if ($0 != "#pragma once") print FILENAME ":" FNR "\tdoes not begin with #pragma once"
    }' "$@"
}

# An include in quotes starts at the library's folder: the root or plugins/. Within the SDK it is relative, and within a
# template, whose files stand in one folder.
check_includes() {
  local file line text header
  while IFS=: read -r file line text; do
    header=${text#*\"} header=${header%%\"*}
    [[ $file != examples/templates/* || ! -e ${file%/*}/$header ]] || continue
    if [[ $header == *../* ]]; then
      breach "$file:$line" "includes by a path upwards: $header"
    elif [[ $header != */* || (! -e $header && ! -e plugins/$header) ]]; then
      breach "$file:$line" "does not include from the library's folder: $header"
    fi
  done < <(grep -nHE '^[[:space:]]*#[[:space:]]*include[[:space:]]*"' "$@" || true)
}

# The folder of the source that a folder under tests/unit mirrors.
source_folder() {
  case $1 in
    sdk/*) echo "sdk/include/dmrp/${1#sdk/}" ;;
    core* | host* | sdk) echo "$1" ;;
    bench*) echo "tests/$1" ;;
    *) echo "plugins/$1" ;;
  esac
}

check_tests() {
  local file folder
  while IFS= read -r file; do
    [[ $file == *_test.cpp ]] || breach "$file:1" "holds test cases, but is not named x_test.cpp"
  done < <(grep -rlE '^[[:space:]]*(TEST_CASE|SCENARIO|TEMPLATE_TEST_CASE)' --include='*.cpp' tests)
  while IFS= read -r folder; do
    [[ -d $(source_folder "$folder") ]] || breach "tests/unit/$folder:1" "mirrors no folder of the source"
  done < <(find tests/unit -mindepth 1 -type d -printf '%P\n' | sort)
}

parts=(core host plugins examples tests)
mapfile -t cpp < <(files '.*\.(h|hpp|c|cpp)' "${parts[@]}")
mapfile -t headers < <(files '.*\.hpp' "${parts[@]}" sdk)
mapfile -t licensed < <(files '.*(\.(h|hpp|c|cpp|sh|awk|js|cjs|css|cmake)|/CMakeLists\.txt)' . && files '.*' .ci)

check_licences "${licensed[@]}"
check_pragma_once "${headers[@]}"
check_includes "${cpp[@]}"
check_tests
forbid "asks FCL what it answers wrongly (core/world/collision_shapes.hpp)" \
  "\b(enable_signed_distance|GST_INDEP|continuousCollide|ContinuousCollision|fcl::(Cylinder|Capsule|Cone)[df]?)\b" "${cpp[@]}"
forbid "imports all of std" '^[[:space:]]*using namespace std\b' "${cpp[@]}"
mapfile -t programs < <(files '.*\.(h|hpp|c|cpp)' core host plugins examples)
forbid "changes the locale of the process" '^[^/]*\bsetlocale\(' "${programs[@]}"

((breaches == 0)) || { echo "$breaches breaches" && exit 1; }
echo "${#licensed[@]} files, ${#headers[@]} C++ headers: one dialect"
