#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Worlds without robots, with random robots, with recorded people, and with noise and latencies:
# called as worlds.sh DMRP_HOST SOURCE_DIR.
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
source_dir=$2

# The crossing, with another scenario and other tables instead of its planners and controllers: crossing_with SCENARIO [TOML line...]
crossing_with() {
  cat <<EOT
[experiment]
name = "worlds"
seed = 7
trials = 2
plugins = ["libdmrp_planners.so", "libdmrp_controllers.so", "libdmrp_pedestrians.so", "libdmrp_metrics.so"]
[[global_planner]]
use = "dmrp.planner.ecbs"
[[local_controller]]
use = "dmrp.controller.pure_pursuit"
[[pedestrian_model]]
use = "dmrp.pedestrian.social_force"
[[scenario]]
use = "$1"
EOT
  shift
  printf '%s\n' "$@"
}

# run NAME: NAME.toml with one worker and with two: the same bits.
run() {
  expect_status 0 "$host" "$scratch/$1.toml" --quiet --jobs 1 --out "$scratch/$1"
  expect_status 0 "$host" "$scratch/$1.toml" --quiet --jobs 2 --out "$scratch/$1.two"
  [[ $(values_of "$scratch/$1") == "$(values_of "$scratch/$1.two")" ]] || fail "$1: --jobs 2 differs from --jobs 1"
  [[ $(query "$scratch/$1" "SELECT count(*) FROM fault") == 0 ]] || fail "$1: there are faults"
}

# the same crowd without robots: one trial per model and repetition, with the seeds of the trials with robots
crossing_with crossing 'robots = [0, 2]' >"$scratch/pair.toml"
run pair
[[ $(query "$scratch/pair" "SELECT count(*), count(DISTINCT seed) FROM trial") == "4|2" ]] || fail "four trials, two seeds"
[[ $(query "$scratch/pair" "SELECT count(*) FROM trial WHERE robots = 0 AND global_planner = '' AND local_controller = ''
  AND pedestrian_model <> '' AND outcome = 'succeeded' AND sim_time_s = 60") == 2 ]] || fail "trials without robots"
[[ -z $(query "$scratch/pair" "SELECT t.id, m.name FROM trial t, metric m WHERE NOT EXISTS (SELECT 1 FROM value v
   WHERE v.trial_id = t.id AND v.metric = m.name AND v.subject_kind = 'system')") ]] || fail "a metric has no value"
[[ -z $(query "$scratch/pair" "SELECT metric FROM value JOIN trial ON id = trial_id WHERE robots = 0 AND value IS NOT NULL
   AND metric IN ('success', 'completion_time', 'path_length', 'planning_time', 'pfd', 'sto')") ]] ||
  fail "metrics of robots have values in trials without robots"

# random robots: other tasks in each repetition, the same for all combinations; with latency, noise and replanning
crossing_with crossing 'robots = [0, 1, 3]' '[simulation]' 'replan_period_s = 2' 'planning_latency_s = 0.7' \
  'control_latency_s = 0.05' '[robot]' 'actuation_latency_s = 0.1' \
  'odometry = { noise = [0.01, 0.01, 0.01, 0.01], fix_period_s = 1 }' >"$scratch/drawn.toml"
run drawn
[[ $(query "$scratch/drawn" "SELECT count(DISTINCT value) FROM value JOIN trial ON id = trial_id WHERE robots = 3
  AND metric = 'planned_length' AND subject_kind = 'robot' AND subject = 0") == 2 ]] || fail "tasks should differ"
expect_status 0 "$host" "$scratch/drawn/effective.toml" --quiet --out "$scratch/again"
[[ $(values_of "$scratch/again") == "$(values_of "$scratch/drawn")" ]] || fail "effective.toml gives other worlds"

# the enlarged mall plans and drives
for agents in 4 100; do
  expect_status 0 "$host" plan --scenario mall_large --agents $agents --seed 1 --planner dmrp.planner.eecbs --json
  grep -q '"valid": true' "$scratch/stdout" || fail "mall_large: no plan for $agents robots"
done
crossing_with mall_large 'robots = 20' '[simulation]' 'time_limit_s = 20' '[record]' 'traces = "none"' \
  >"$scratch/large.toml"
expect_status 0 "$host" "$scratch/large.toml" --quiet --trials 1 --out "$scratch/large"
[[ $(query "$scratch/large" "SELECT count(*) FROM value WHERE metric = 'success' AND subject_kind = 'robot'") == 20 ]] ||
  fail "mall_large: 20 robots should be measured"

# recorded people
expect_status 0 "$host" "$source_dir/examples/recorded_crowd.toml" --quiet --out "$scratch/recorded"
[[ $(query "$scratch/recorded" "SELECT count(*) FROM trial WHERE pedestrian_model = '' AND outcome <> 'fault'") == 2 ]] ||
  fail "two trials of recorded people"
grep -q 'recorded_crowd/crowd.csv' "$scratch/recorded/manifest.json" || fail "the manifest has no recording"

# two rooms with a door that cells of 1 m miss: validate, draw and run say so; "auto" takes cells that do not
cat >"$scratch/rooms.toml" <<'EOT'
[scenario]
name = "rooms"
title = "Two rooms"
description = "Two rooms with a door"
size_m = [12, 6]
time_limit_s = 60
[[box]]
name = "south"
center_m = [5, 1.275]
size_m = [0.1, 2.55]
[[box]]
name = "north"
center_m = [5, 4.725]
size_m = [0.1, 2.55]
EOT
crossing_with ./rooms.toml 'robots = 2' 'tasks = "drawn"' '[[global_planner]]' 'use = "dmrp.planner.pibt"' \
  >"$scratch/rooms_e.toml"
missed='rooms.toml:5:10: 1 of 2 regions cannot be reached with cells of 1 m; grid_resolution_m = 0.4 reaches all'
expect_status 0 "$host" validate "$scratch/rooms_e.toml"
grep -q "$missed, but dmrp.planner.pibt cannot plan with it" "$scratch/stderr" || fail "validate: a room is cut off"
expect_status 0 "$host" draw "$scratch/rooms.toml" --agents 2 --svg "$scratch/rooms.svg"
grep -q "$missed" "$scratch/stderr" || fail "draw: a room is cut off"
expect_status 0 "$host" "$scratch/rooms_e.toml" --trials 1 --out "$scratch/rooms"
grep -q "$missed" "$scratch/stderr" || fail "run: a room is cut off"
crossing_with ./rooms.toml 'robots = 2' 'tasks = "drawn"' '[simulation]' 'grid_resolution_m = "auto"' >"$scratch/auto.toml"
expect_status 0 "$host" "$scratch/auto.toml" --trials 1 --out "$scratch/auto"
grep -q 'grid_resolution_m = "auto" takes 0.4 m' "$scratch/stdout" || fail "run: which cells \"auto\" took"
grep -q 'regions cannot be reached' "$scratch/stderr" && fail "run: nothing is cut off with cells of 0.4 m"
grep -q '^grid_resolution_m *= 0.4' "$scratch/auto/effective.toml" || fail "effective.toml has no size of cells"

# a gap of 0.6 m lets people of 0.4 m through wherever the grid lies, and one of 0.38 m nobody
for i in $(seq 0 19); do
  for gap in 0.6 0.38; do
    {
      sed -e '/^\[\[box/,$d' "$scratch/rooms.toml"
      awk -v y="$(awk "BEGIN { print 2.75 + 0.0125 * $i }")" -v gap=$gap 'BEGIN {
        printf "[[box]]\nname = \"s\"\ncenter_m = [5, %.6f]\nsize_m = [0.1, %.6f]\n", (y - gap / 2) / 2, y - gap / 2
        printf "[[box]]\nname = \"n\"\ncenter_m = [5, %.6f]\nsize_m = [0.1, %.6f]\n", (6 + y + gap / 2) / 2, 6 - y - gap / 2
        print "[[region]]\nname = \"a\"\nlower_m = [0.5, 0.5]\nupper_m = [2.5, 5.5]"
        print "[[region]]\nname = \"b\"\nlower_m = [9, 0.5]\nupper_m = [11, 5.5]"
        print "[[flow]]\nname = \"f\"\nfrom = \"a\"\nto = \"b\"\npeople = 3"
      }'
    } >"$scratch/gap.toml"
    crossing_with ./gap.toml 'robots = 0' >"$scratch/gap_e.toml"
    if [[ $gap == 0.6 ]]; then
      expect_status 0 "$host" validate "$scratch/gap_e.toml"
    else
      expect_status 2 "$host" validate "$scratch/gap_e.toml"
      grep -q "nobody can walk from 'a' to 'b'" "$scratch/stderr" || fail "gap of 0.38 m at offset $i"
    fi
  done
done
