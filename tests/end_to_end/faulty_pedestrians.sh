#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# A pedestrian model that fails is a fault of its trial; trials of other models are unaffected.
source "$(dirname "${BASH_SOURCE[0]}")/faults.sh"

begin_experiment faults global_planner local_controller
use faults global_planner dmrp.planner.cbs
use faults local_controller dmrp.controller.dwa
use faults metric dmrp.metric.success
for fault in none nan too_fast crash throw; do use faults pedestrian_model test.pedestrian.faulty "$fault"; done
run_with_faults faults 1

expect() { expect_fault faults "pedestrian_model = '$1'" "$2|test.pedestrian.faulty|step|50||${4:-}" "$3"; }
expect nan bad_output "person .* the velocity \(0, nan\)"
expect too_fast bad_output "person .* the velocity \(5.5, 0\)"
expect crash crash "Segmentation fault" 11
expect throw error_status "^thrown on purpose$"
[[ $(query "$scratch/faults" "SELECT count(*) FROM trial WHERE outcome <> 'fault'") == 2 ]] ||
  fail "the social force model and people who stand are no faults"
