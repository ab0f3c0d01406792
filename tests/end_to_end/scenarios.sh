#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The shipped scenarios keep their design targets: called as scenarios.sh DMRP_HOST.
# total lengths of the paths, within 3 %; pairs of robots that come nearer than 2 m in a run without people; people and
# time limits; no warning, so starts and goals are more than 2 m apart; up-to-date pictures.
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
shipped=$(dirname "$host")/../share/dmrp/scenarios

# expect_length SCENARIO PLANNER METRES
expect_length() {
  expect_status 0 "$host" draw "$1" --planner "$2" --svg "$scratch/$1.$2.svg"
  local total
  total=$(sed -n "s/^$2: \([0-9.]*\) m in all.*/\1/p" "$scratch/stderr")
  awk -v total="$total" -v target="$3" 'BEGIN { exit !(total >= 0.97 * target && total <= 1.03 * target) }' ||
    fail "$1: $2 plans $total m in all, not $3 m"
  (($(grep -c 'stroke-width:2.5;' "$scratch/$1.$2.svg") == 5)) || # the legend has one too
    fail "$1: the picture should show four paths"
}

# The shipped world without people: flows come last in the file.
empty_world() {
  mkdir -p "$scratch/empty/$1"
  awk '/^\[\[flow\]\]/ { exit } { print }' "$shipped/$1/scenario.toml" >"$scratch/empty/$1/scenario.toml"
}

# experiment_on SCENARIO [TOML line...]: CBS and DWA, one trial. The targets are the scenarios': robots cut the steps
# aside short by which a plan keeps them apart. IBTR with a threshold of speed that no robot exceeds
# has an event whenever two active robots are within 2 m.
experiment_on() {
  cat <<EOF
[experiment]
name = "scenarios"
seed = 1
trials = 1
plugins = ["libdmrp_planners.so", "libdmrp_controllers.so", "libdmrp_pedestrians.so", "libdmrp_metrics.so"]
[[scenario]]
use = "$1"
[[global_planner]]
use = "dmrp.planner.cbs"
[[local_controller]]
use = "dmrp.controller.dwa"
params_file = "controllers/tuned/dwa.toml"
params = { leave_padding = false }
[[metric]]
use = "dmrp.metric.success"
[[metric]]
use = "dmrp.metric.collisions"
[[metric]]
use = "dmrp.metric.ibtr"
params = { distance_m = 2.0, speed_fraction = 10.0 }
EOF
  shift
  printf '%s\n' "$@"
}

# expect_encounters SCENARIO PAIRS: at least; all robots arrive without a contact with static shapes.
expect_encounters() {
  local run=$scratch/run-$1
  empty_world "$1"
  experiment_on "$scratch/empty/$1" >"$scratch/$1.toml"
  expect_status 0 "$host" "$scratch/$1.toml" --out "$run" --quiet
  [[ $(query "$run" "SELECT outcome FROM trial") == succeeded ]] || fail "$1: not everybody arrived"
  [[ $(query "$run" "SELECT sum(value) FROM value WHERE metric = 'collisions_static'") == 0.0 ]] ||
    fail "$1: a robot touched something static"
  local pairs
  pairs=$(query "$run" "SELECT count(DISTINCT subjects) FROM event WHERE metric = 'ibtr'")
  ((pairs >= $2)) || fail "$1: $pairs pairs of robots came nearer than 2 m, at least $2 should"
}

# expect_world SCENARIO PEOPLE SECONDS: valid without a warning, with these people and time limit, and a picture.
expect_world() {
  experiment_on "$1" '[[pedestrian_model]]' 'use = "dmrp.pedestrian.social_force"' >"$scratch/$1.valid.toml"
  expect_status 0 "$host" validate "$scratch/$1.valid.toml"
  [[ ! -s $scratch/stderr ]] || fail "$1: $(cat "$scratch/stderr")"
  local people
  people=$(awk '$1 == "people" { sum += $3 } END { print sum }' "$shipped/$1/scenario.toml")
  ((people == $2)) || fail "$1: $people people, not $2"
  grep -q "^time_limit_s = $3\$" "$shipped/$1/scenario.toml" || fail "$1: the time limit is not $3 s"
  grep -q "]($1.svg)" "$shipped/$1/README.md" || fail "$1: the README shows no picture"
  # without paths: a planner may choose others of the same length
  cmp -s <(grep -v 'stroke-width:2.5;' "$scratch/$1.dmrp.planner.cbs.svg") \
    <(grep -v 'stroke-width:2.5;' "$shipped/$1/$1.svg") ||
    fail "$1.svg is old: dmrp-host draw $1 --planner dmrp.planner.cbs --svg $1.svg"
}

expect_length mall dmrp.planner.cbs 63
expect_length mall dmrp.planner.ecbs8 59.5
expect_world mall 12 180.0
expect_encounters mall 2

expect_length library dmrp.planner.cbs 80
expect_length library dmrp.planner.ecbs8 77.7
expect_world library 8 180.0
expect_encounters library 1

expect_length office dmrp.planner.cbs 43
expect_length office dmrp.planner.ecbs8 33
expect_world office 5 120.0
expect_encounters office 1
