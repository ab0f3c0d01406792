#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# What dmrp-host supports of the wishes already, in real trials: the robots arrive, without a fault, and with the same bits
# in a second run. Called as: in_a_trial.sh DMRP_HOST LIBRARY_FOLDER
source "$(dirname "${BASH_SOURCE[0]}")/../end_to_end/checks.sh"
export DMRP_SCENARIO_PATH=$here/../end_to_end/worlds
folder=$(realpath "$2")
cd "$scratch" || exit 1

# experiment NAME PLANNER CONTROLLER PEDESTRIANS LIBRARIES [SETTINGS [ROBOTS]]
experiment() {
  local libraries="" library
  for library in $5; do libraries+=", \"$folder/libwish_$library.so\""; done
  cat >"$1.toml" <<END
[experiment]
name    = "$1"
seed    = 7
trials  = 2
plugins = ["libdmrp_planners.so", "libdmrp_controllers.so", "libdmrp_pedestrians.so", "libdmrp_metrics.so"$libraries]

[[scenario]]
use = "crossing"
robots = ${7:-2}

[[global_planner]]
use = "$2"

[[local_controller]]
use = "$3"

[[pedestrian_model]]
use = "$4"

[simulation]
$6
END
}
cbs=dmrp.planner.cbs pure_pursuit=dmrp.controller.pure_pursuit social_force=dmrp.pedestrian.social_force
ordered='execution = "ordered"'
experiment anytime org.example.anytime $pure_pursuit $social_force anytime_planner "$ordered
replan_period_s = 1.0"
experiment grid_of_each org.example.grid_of_each $pure_pursuit $social_force grid_of_each "" 1
experiment lifelong $cbs org.example.lifelong $social_force lifelong_controller "$ordered"
experiment policy $cbs org.example.policy $social_force learned_policy "$ordered"
experiment any_drive $cbs org.example.any_drive $social_force any_drive "$ordered"
experiment central $cbs org.example.one_at_a_time $social_force one_at_a_time "$ordered"
experiment kinodynamic org.example.kinodynamic org.example.kinodynamic_follower $social_force \
  "kinodynamic_planner kinodynamic_follower" "" 1
experiment messages $cbs org.example.messages $social_force messages "$ordered"
experiment reactions $cbs $pure_pursuit org.example.reactions reactions "$ordered"

for name in anytime grid_of_each lifelong policy any_drive central kinodynamic messages reactions; do
  expect_status 0 "$host" "$name.toml" --quiet --out "$name"
  [[ $(query "$name" "SELECT count(*), min(outcome), max(outcome), min(repeatable), (SELECT count(*) FROM fault) FROM trial") == \
    "2|succeeded|succeeded|1|0" ]] || fail "$name: $(query "$name" "SELECT * FROM trial; SELECT * FROM fault")"
done

# one controller drives the four robots of the mixed fleet, the tug by its steering angle: it sees no walls, so not all arrive
sed -e "s|\"libdmrp_metrics.so\"|&, \"$folder/libwish_any_drive.so\"|" -e 's/^use  *= "dmrp.controller.teb"/use = "org.example.any_drive"/' \
  -e '/^params_file/d' "$here/../../examples/mixed_fleet.toml" >mixed_fleet.toml
expect_status 0 "$host" mixed_fleet.toml --quiet --trials 5 --out mixed_fleet
arrived=$(query mixed_fleet "SELECT group_concat(n) FROM (SELECT sum(value) AS n FROM value
  WHERE metric = 'success' AND subject_kind = 'robot' GROUP BY subject)")
[[ $arrived == [45].0,[45].0,[45].0,[45].0 ]] || fail "of five trials of the mixed fleet its robots should arrive in four: $arrived"

# a planner and a controller that keep something between their calls, in other workers
for name in anytime central; do
  expect_status 0 "$host" "$name.toml" --quiet --jobs 1 --out "${name}_again"
  [[ $(values_of "$name") == "$(values_of "${name}_again")" ]] || fail "$name has other values in a second run"
done

# a window is a time: however many waypoints a planner of any angles puts into ten steps, the robot does not stop for it
mkdir empty_hall
cat >empty_hall/scenario.toml <<END
[scenario]
name = "empty_hall"
title = "Empty hall"
description = "one robot drives straight ahead"
size_m = [40.0, 6.0]
time_limit_s = 300.0
[[robot]]
name = "eastward"
start = [1.5, 3.0, 0.0]
goal = [38.5, 3.0]
END
experiment any_angle org.example.straight_ahead $pure_pursuit $social_force straight_ahead "replan_window_steps = 10
replan_period_steps = 5" 1
sed -i -e 's|^use = "crossing"|use = "./empty_hall/scenario.toml"|' -e 's/^trials .*/trials = 1/' \
  -e 's/^use = "org.example.straight_ahead"/&\nsweep = { waypoint_ms = [100, 1000, 9000] }/' any_angle.toml
expect_status 0 "$host" any_angle.toml --quiet --out any_angle
[[ $(query any_angle "SELECT count(*), min(outcome), max(outcome), max(sim_time_s) < 1.1 * min(sim_time_s) FROM trial") == \
  "3|succeeded|succeeded|1" ]] || fail "any angles: $(query any_angle "SELECT global_planner, outcome, sim_time_s FROM trial")"

# the plan in force was the start of most calls, and never became more expensive
kept=$(awk '/kept/ { n++; if ($NF > $(NF - 1)) exit 1 } END { print n + 0 }' anytime/log.txt) ||
  fail "the anytime planner made a plan more expensive: $(cat anytime/log.txt)"
((kept >= 10)) || fail "the anytime planner should have kept plans: $(cat anytime/log.txt)"

# weights that are not there are found before the run begins
cp "$folder/libwish_learned_policy.so" .
sed "s|$folder/libwish_learned|./libwish_learned|" policy.toml >without_weights.toml
expect_status 2 "$host" without_weights.toml --quiet --out without_weights
grep -q 'without_weights.toml:.*/learned_policy.weights: 17 weights are expected' "$scratch/stderr" ||
  fail "the host should say which file is missing: $(cat "$scratch/stderr")"
