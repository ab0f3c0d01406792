#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# `dmrp-host new`: what it writes, and what it refuses. That it builds is shown by installed_sdk.sh.
# Called as: new_plugin.sh DMRP_HOST
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
cd "$scratch" || exit 1

# refuses PATTERN ARGUMENT...: one line, status 2, and no folder
refuses() {
  local pattern=$1
  shift
  expect_status 2 "$host" new "$@" mine
  [[ $(messages) == 1 ]] || fail "more than a line: $(cat "$scratch/stderr")"
  grep -Eq -- "$pattern" "$scratch/stderr" || fail "$* should be refused with '$pattern': $(cat "$scratch/stderr")"
}
refuses "no kind of plugin 'plannr' \(did you mean 'planner'\?\): .*controller, metric, pedestrian-model, planner" plannr --id org.example.mine
refuses "'mine' has no '.': .*'org.example.mine'" planner --id mine
refuses "has characters other than letters" planner --id "org.example.my planner"
refuses "has an empty part" planner --id org..mine
refuses "has an empty part" planner --id org.example.
refuses "begins with 'dmrp.'" planner --id dmrp.planner.mine
refuses "id is required" planner
[[ ! -e mine ]] || fail "a refused call should leave no folder"
mkdir mine && touch mine/notes.txt
refuses "mine is not empty" planner --id org.example.mine
rm -r mine && touch mine
refuses "mine is no folder" planner --id org.example.mine
rm mine && mkdir -m 555 locked
((EUID == 0)) || expect_status 2 "$host" new planner --id org.example.mine locked/mine

# every name of the template becomes the author's
for kind in planner controller pedestrian-model metric; do
  expect_status 0 "$host" new "$kind" --id org.example.my-own.my-thing "deep/$kind"
  for file in CMakeLists.txt README.md .gitignore .github/workflows/ci.yml my_thing.cpp my_thing.toml; do
    [[ -s deep/$kind/$file ]] || fail "$kind: no $file"
  done
  ! grep -rqE 'my_plugin|my_kind' "deep/$kind" || fail "$kind: left from the template: $(grep -rE 'my_plugin|my_kind' "deep/$kind")"
  grep -q '"org.example.my-own.my-thing"' "deep/$kind/my_thing.cpp" || fail "$kind: the source should have the id"
  (($(wc -l <"deep/$kind/CMakeLists.txt") <= 40)) || fail "$kind: CMakeLists.txt has over 40 lines"
done
grep -q '^A pedestrian model for dmrp' deep/pedestrian-model/README.md || fail "the README should name the kind"

# where this dmrp-host lies, for find_package()
prefix=$(dirname "$(dirname "$(realpath "$host")")")
grep -qF "HINTS \"$prefix\"" deep/metric/CMakeLists.txt || fail "the folder should know its dmrp: $(cat deep/metric/CMakeLists.txt)"

# ids that contain the template's name, or a target that CMake reserves
expect_status 0 "$host" new metric --id org.example.my_plugin.all ids
grep -q '"org.example.my_plugin.all"' ids/all_plugin.cpp || fail "the id should stay as it was given"
grep -q 'project(all_plugin' ids/CMakeLists.txt || fail "'all' is no name for a target"
