#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Plugins of others with one fault each, in a folder beside the test data: each is found, and `ok` has none. Some faults are
# against advice alone: a warning.
# Called as: faulty_of_others.sh DMRP_HOST INCLUDE_DIR FOLDER
set -uo pipefail
host=$1 include=$2 folder=$3
[[ -f $folder/ok.cpp ]] || { echo "skipped: no $folder/ok.cpp" && exit 77; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

failures=0
for source in "$folder"/*.cpp; do
  name=$(basename "$source" .cpp)
  # They were written for draft 2 (docs/migration/from_draft_2.md).
  sed 's/std::min<std::size_t>(o.released_waypoint, *path_.size()-1)/path_.size()-1/' "$source" >"$scratch/$name.cpp"
  "${CXX:-g++}" -std=c++17 -O2 -fPIC -shared -fvisibility=hidden -I "$include" "$scratch/$name.cpp" -o "$scratch/$name.so" || exit 1
  status=0
  "$host" check "$scratch/$name.so" >"$scratch/out" || status=$?
  found=$(grep -cE '^  (warn|fail|crash) ' "$scratch/out")
  echo "$name: $found findings, status $status"
  if [[ $name == ok ]]; then ((found == 0 && status == 0)); else ((found > 0 && status <= 1)); fi || ((++failures))
done
((failures == 0)) || { echo "FAILED: $failures plugins" && exit 1; }
