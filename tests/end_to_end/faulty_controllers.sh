#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Every fault of a controller becomes a row with its kind, plugin, step and robot; only its trial is lost.
source "$(dirname "${BASH_SOURCE[0]}")/faults.sh"

begin_experiment faults local_controller
use faults metric dmrp.metric.success
use faults metric dmrp.metric.path_length
use faults local_controller dmrp.controller.pure_pursuit
echo 'label = "pursuit"' >>"$scratch/faults.toml"
faults=(crash abort exit throw throw_number rounding unknown_status hang nan infinite error)
$limited && faults+=(memory)
for fault in "${faults[@]}"; do use faults local_controller test.controller.faulty "$fault"; done
use faults local_controller test.controller.faulty throw ', where = "start"' "throw in start"
use faults local_controller test.controller.faulty crash ', where = "set_path"' "crash in set_path"
use faults local_controller test.controller.faulty none "" none
use faults local_controller test.controller.faulty no_solution ', at_s = 0.0' "no solution"
run_with_faults faults 1

# at 1 s, the fiftieth physics step, in the controller of robot 1; one row in the trials of each planner
site='test.controller.faulty|step|50|1'
expect() {
  expect_fault faults "local_controller = '$1' AND global_planner = 'together'" "$2" "$3"
  expect_fault faults "local_controller = '$1' AND global_planner = 'each alone'" "$2" "$3"
}
expect crash "crash|$site|11" "Segmentation fault"
expect abort "crash|$site|6" "Aborted"
expect exit "exit|$site|" "ended with status 0"
expect throw "error_status|$site|" "^thrown on purpose$"
expect throw_number "error_status|$site|" "no std::exception"
expect rounding "abi_breach|$site|" "floating-point control"
expect unknown_status "abi_breach|$site|" "status 99"
expect hang "hang|$site|" "did not return within"
expect nan "bad_output|$site|" "nan"
expect infinite "bad_output|$site|" "inf"
expect error "error_status|$site|" "^failed on purpose$"
if $limited; then expect memory "out_of_memory|$site|" "."; fi
expect "throw in start" "error_status|test.controller.faulty|start|0|0|" "^thrown on purpose$"
expect "crash in set_path" "crash|test.controller.faulty|set_path|0|0|11" "Segmentation fault"

run=$scratch/faults
[[ $(query "$run" "SELECT count(*) FROM trial WHERE outcome = 'fault' AND id NOT IN (SELECT trial_id FROM fault)
       OR outcome <> 'fault' AND id IN (SELECT trial_id FROM fault)") == 0 ]] || fail "outcomes and faults disagree"
[[ $(query "$run" "SELECT count(*) FROM value JOIN trial ON trial.id = trial_id WHERE outcome = 'fault'") == 0 ]] ||
  fail "a trial that ended in a fault has no values"
[[ $(query "$run" "SELECT count(*) FROM trial WHERE local_controller IN ('none', 'no solution')
       AND outcome = 'failed'") == 4 ]] || fail "robots that stand still, or whose controllers know no way, are results"

# the trials of other controllers are the same without the faulty ones
begin_experiment alone local_controller
use alone metric dmrp.metric.success
use alone metric dmrp.metric.path_length
use alone local_controller dmrp.controller.pure_pursuit
echo 'label = "pursuit"' >>"$scratch/alone.toml"
run_with_faults alone 0
values() {
  query "$1" "SELECT global_planner, outcome, metric, subject_kind, subject, printf('%!.17g', value.value)
    FROM value JOIN trial ON trial.id = trial_id JOIN metric ON metric.name = metric
    WHERE local_controller = 'pursuit' AND wall_clock = 0 ORDER BY 1, 3, 4, 5"
}
[[ -n $(values "$scratch/alone") ]] || fail "there should be values to compare"
[[ $(values "$run") == "$(values "$scratch/alone")" ]] || fail "faults of one controller change another's values"

# the command in the row runs that trial again
rerun=$(query "$run" "SELECT rerun FROM fault JOIN trial ON trial.id = trial_id WHERE local_controller = 'crash'
  AND global_planner = 'together'")
cd "$scratch" || exit 1
expect_status 1 env PATH="$(dirname "$host"):$PATH" bash -c "$rerun"
again=$(ls -d rerun-*)
[[ $(query "$again" "SELECT count(*), kind, signal FROM fault") == "1|crash|11" ]] || fail "'$rerun' shows no crash"
