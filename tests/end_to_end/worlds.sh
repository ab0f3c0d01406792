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
