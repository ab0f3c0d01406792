#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The collision monitor behind a controller that ignores people, and local routes of one that follows its path. Called as: navigation.sh DMRP_HOST
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"

cat >"$scratch/monitor.toml" <<EOT
[experiment]
name = "monitor"
seed = 3
trials = 6
plugins = ["libdmrp_planners.so", "libdmrp_controllers.so", "libdmrp_pedestrians.so", "libdmrp_metrics.so"]
[[scenario]]
use = "lane"
[[global_planner]]
use = "dmrp.planner.cbs"
[[local_controller]]
use = "dmrp.controller.pure_pursuit"
params = { use_collision_detection = false }
[[pedestrian_model]]
use = "dmrp.pedestrian.social_force"
[robot]
v_max = 1.6 # too fast for people to step aside
[navigation]
sweep = { monitor = [false, true] }
EOT
expect_status 0 "$host" "$scratch/monitor.toml" --quiet --jobs 1 --out "$scratch/one"
expect_status 0 "$host" "$scratch/monitor.toml" --quiet --jobs 2 --out "$scratch/two"
[[ $(values_of "$scratch/one") == "$(values_of "$scratch/two")" ]] || fail "--jobs should change no bit"

# sum_of METRIC MONITOR: over the trials without (false) or with (true) the monitor
sum_of() {
  query "$scratch/one" "SELECT CAST(sum(value.value) AS INTEGER) FROM value JOIN swept USING (trial_id)
    WHERE metric = '$1' AND subject_kind = 'system' AND swept.value = '$2'"
}
(($(sum_of collisions_at_fault true) < $(sum_of collisions_at_fault false))) ||
  fail "contacts at fault: $(sum_of collisions_at_fault false) without, $(sum_of collisions_at_fault true) with the monitor"
[[ $(sum_of interventions false) == 0 ]] || fail "there should be no interventions without the monitor"
(($(sum_of interventions true) > 0)) || fail "the monitor should intervene"
[[ $(query "$scratch/one" "SELECT DISTINCT severity FROM event WHERE metric = 'interventions'") == info ]] ||
  fail "each intervention should be an event"

# off by default: no value, and no other bits
grep -v -e '^.navigation' -e '^sweep' "$scratch/monitor.toml" >"$scratch/without.toml"
expect_status 0 "$host" "$scratch/without.toml" --quiet --out "$scratch/without"
[[ $(query "$scratch/without" "SELECT count(*) FROM metric WHERE name = 'interventions'") == 0 ]] ||
  fail "interventions should be measured where there is a monitor"
of_first="SELECT metric, subject_kind, subject, quote(value) FROM value JOIN metric ON name = metric WHERE trial_id = 0
  AND wall_clock = 0 AND metric NOT IN ('interventions', 'intervention_time', 'recoveries') ORDER BY 1, 2, 3, 4"
[[ $(query "$scratch/without" "$of_first") == "$(query "$scratch/one" "$of_first")" ]] ||
  fail "a monitor that is off should change nothing"

# --- local routes: around a robot that stands in the way
mkdir "$scratch/standing"
cat >"$scratch/standing/scenario.toml" <<EOT
[scenario]
name = "standing"
title = "Standing"
description = "a robot stands on the path of another"
size_m = [12.0, 4.0]
time_limit_s = 60.0
[[robot]]
name = "drives"
start = [1.5, 1.5, 0.0]
goal = [10.5, 1.5]
[[robot]]
name = "stands"
start = [6.0, 1.5, 0.0]
goal = [6.0, 1.5]
EOT
cat >"$scratch/route.toml" <<EOT
[experiment]
name = "route"
seed = 4
trials = 1
plugins = ["libdmrp_planners.so", "libdmrp_controllers.so", "libdmrp_pedestrians.so", "libdmrp_metrics.so"]
[[scenario]]
use = "./standing/scenario.toml"
[[global_planner]]
use = "dmrp.planner.individual"
[[local_controller]]
use = "dmrp.controller.pure_pursuit"
[[pedestrian_model]]
use = "dmrp.pedestrian.social_force"
[navigation]
sweep = { route = ["path", "around"], monitor = [false, true] }
EOT
expect_status 0 "$host" "$scratch/route.toml" --quiet --jobs 1 --out "$scratch/route_one"
expect_status 0 "$host" "$scratch/route.toml" --quiet --jobs 2 --out "$scratch/route_two"
[[ $(values_of "$scratch/route_one") == "$(values_of "$scratch/route_two")" ]] || fail "--jobs should change no bit"
outcomes=$(query "$scratch/route_one" "SELECT group_concat(value || ':' || outcome, ' ') FROM (SELECT swept.value, outcome
  FROM trial JOIN swept ON trial_id = trial.id WHERE key = 'route' ORDER BY trial.id)")
[[ $outcomes == "path:failed path:failed around:succeeded around:succeeded" ]] || fail "routes: $outcomes"

# settings are conditions: the tasks of a world are counted once
sed -e 's|use = "./standing/scenario.toml"|use = "crossing"\nrobots = 2\ntasks = "drawn"|' -e 's/^trials = 1/trials = 3/' \
  -e '$a [[local_controller]]\nuse = "dmrp.controller.stop_and_wait"' "$scratch/route.toml" >"$scratch/tasks.toml"
expect_status 0 "$host" "$scratch/tasks.toml" --out "$scratch/tasks"
grep -q '^  3 drawn tasks in this world' "$scratch/stdout" || fail "12 trials of 3 tasks: $(grep ' over ' "$scratch/stdout")"
