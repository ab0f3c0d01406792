#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Every plan is validated, and no failure of a planner ends the run.
source "$(dirname "${BASH_SOURCE[0]}")/faults.sh"

begin_experiment faults global_planner local_controller
use faults local_controller dmrp.controller.dwa
use faults metric dmrp.metric.success
use faults global_planner dmrp.planner.cbs
echo 'label = "sound"' >>"$scratch/faults.toml"
faults=(none no_solution timeout crash throw rounding conflict teleport wrong_start wrong_end beside_centre into_wall nan
  no_time path_twice missing_path)
$limited && faults+=(memory)
for fault in "${faults[@]}"; do use faults global_planner test.planner.faulty "$fault"; done
run_with_faults faults 1

expect() { expect_fault faults "global_planner = '$1'" "$2|test.planner.faulty|plan|0||${4:-}" "$3"; }
expect crash crash "Segmentation fault" 11
expect throw error_status "^thrown on purpose$"
expect rounding abi_breach "floating-point control"
expect conflict bad_output "vertex conflict of robots 0 and 1 at step 3"
expect teleport bad_output "robot 0, waypoint 3"
expect wrong_start bad_output "not at its start \(0.5, 2.5\)"
expect wrong_end bad_output "robot 0 ends at \(5.5, 2.5\), not at its goal"
expect beside_centre bad_output "robot 0, waypoint 3 .*not on a cell's centre"
expect into_wall bad_output "robot 0, waypoint 2 \(1.5, 3.5\) is not on a free cell"
expect nan bad_output "robot 0, waypoint 3"
expect no_time bad_output "robot 0, waypoint 1"
expect path_twice error_status "refused the path of robot 0"
expect missing_path bad_output "without a path for every robot"
if $limited; then expect memory out_of_memory "memory_mb = 400"; fi

outcomes=$(query "$scratch/faults" "SELECT global_planner, outcome, (SELECT count(*) FROM fault WHERE trial_id = trial.id),
  (SELECT count(*) FROM value WHERE trial_id = trial.id AND metric = 'success' AND subject_kind = 'system'
  AND value = (outcome = 'succeeded')) FROM trial WHERE outcome <> 'fault' ORDER BY id")
[[ $outcomes == "sound|succeeded|0|1
none|succeeded|0|1
no_solution|failed|0|1
timeout|failed|0|1" ]] || fail "these are results, no faults: $outcomes"
