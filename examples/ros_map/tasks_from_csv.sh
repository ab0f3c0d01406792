#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Makes scenarios from maps of map_server with lists of tasks, and an experiment with all of them.
# tasks_from_csv.sh DATA OUT
# reads DATA/NAME/map.yaml and DATA/NAME/starts_goals.csv, writes OUT/NAME_TEST/scenario.toml and OUT/experiment.toml.
set -euo pipefail
example=$(dirname "${BASH_SOURCE[0]}")/../ros_map.toml
(($# == 2)) || { echo "usage: tasks_from_csv.sh DATA OUT" >&2 && exit 2; }
data=$(realpath -e "$1")
out=$2
mkdir -p "$out"

scenarios=
for tasks in "$data"/*/starts_goals.csv; do
  [[ -e $tasks ]] || { echo "tasks_from_csv.sh: no $data/NAME/starts_goals.csv" >&2 && exit 2; }
  folder=$(dirname "$tasks")
  map=$(basename "$folder")
  while IFS=, read -r test start_x start_y start_theta goal_x goal_y goal_theta; do
    name=${map}_$test
    mkdir -p "$out/$name"
    cat >"$out/$name/scenario.toml" <<END
[scenario]
name        = "$name"
title       = "$map, task $test"
description = "a map of map_server and one of its tasks"

[map]
file = "$folder/map.yaml"

[[robot]]
start = [$start_x, $start_y, $start_theta]
goal  = [$goal_x, $goal_y, $goal_theta]
END
    scenarios+="[[scenario]]"$'\n'"use = \"./$name/scenario.toml\""$'\n\n'
  done < <(tail -n +2 "$tasks" | tr -d '\r')
done

# The example with these scenarios instead of its own.
awk -v scenarios="$scenarios" '
  /^\[\[scenario\]\]/ { printf "%s", scenarios; skipping = 1 }
  !skipping { print }
  /^$/ { skipping = 0 }' "$example" >"$out/experiment.toml"
