#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# A robot that is only home with the recovery ladder. Called as: recovery.sh DMRP_HOST
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"

cat >"$scratch/ladder.toml" <<EOT
[experiment]
name = "ladder"
seed = 5
trials = 1
plugins = ["libdmrp_planners.so", "libdmrp_controllers.so", "libdmrp_metrics.so"]
[[scenario]]
use = "$here/worlds/parked/scenario.toml"
[[global_planner]]
use = "dmrp.planner.cbs"
[[local_controller]]
use = "dmrp.controller.stop_and_wait"
[recovery]
steps = ["backup", "replan"]
sweep = { retries = [0, 6] }
EOT
expect_status 0 "$host" "$scratch/ladder.toml" --quiet --out "$scratch/ladder"
[[ $(query "$scratch/ladder" "SELECT outcome FROM trial ORDER BY id") == $'failed\nsucceeded' ]] ||
  fail "the robot should be home with the ladder, and only with it"
[[ $(query "$scratch/ladder" "SELECT value FROM value WHERE metric = 'recoveries' AND subject_kind = 'robot'
  ORDER BY trial_id, subject") == $'0.0\n0.0\n1.0\n0.0' ]] || fail "one recovery of one robot"
# its type forbids to drive backwards
[[ $(query "$scratch/ladder" "SELECT text FROM event WHERE metric = 'recoveries'") == "robot 0 recovers: replan" ]] ||
  fail "the recovery should be an event with its step"
head -1 "$scratch/ladder/trials.csv" | grep -q 'recovery.retries.*recoveries' || fail "trials.csv lacks the recoveries"

# off by default: no value, and no other bits
grep -v -e recovery -e '^steps' -e '^sweep' "$scratch/ladder.toml" >"$scratch/without.toml"
expect_status 0 "$host" "$scratch/without.toml" --quiet --out "$scratch/without"
[[ $(query "$scratch/without" "SELECT count(*) FROM metric WHERE name = 'recoveries'") == 0 ]] ||
  fail "recoveries should be measured where robots have them"
of_first="SELECT metric, subject_kind, subject, quote(value) FROM value JOIN metric ON name = metric
  WHERE trial_id = 0 AND wall_clock = 0 AND metric NOT IN ('recoveries', 'interventions', 'intervention_time')
  ORDER BY 1, 2, 3"
[[ $(query "$scratch/without" "$of_first") == "$(query "$scratch/ladder" "$of_first")" ]] ||
  fail "a ladder without retries should change nothing"

# an experiment that names the metric measures it
printf '[[metric]]\nuse = "dmrp.metric.recoveries"\n' >>"$scratch/without.toml"
expect_status 0 "$host" "$scratch/without.toml" --quiet --out "$scratch/named"
[[ $(query "$scratch/named" "SELECT value FROM value WHERE subject_kind = 'system'") == 0.0 ]] || fail "no recovery"
