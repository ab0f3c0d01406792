#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# A metric that fails, even one that ends its process, loses only its own values.
source "$(dirname "${BASH_SOURCE[0]}")/faults.sh"

built_in=(success path_length completion_time sto ibtr ldf pfd collisions speed idle_time)
begin_experiment faults global_planner
use faults global_planner dmrp.planner.cbs
faults=(crash exit rounding silent infinite beyond undeclared throw_in_begin flood)
$limited && faults+=(memory)
# faulty ones before, between and after the others
use faults metric test.metric.none
for i in "${!built_in[@]}"; do
  [[ -z ${faults[i]:-} ]] || use faults metric "test.metric.${faults[i]}"
  use faults metric "dmrp.metric.${built_in[i]}"
done
run_with_faults faults 1

begin_experiment alone global_planner
use alone global_planner dmrp.planner.cbs
for metric in "${built_in[@]}"; do use alone metric "dmrp.metric.$metric"; done
run_with_faults alone 0

trials() { query "$scratch/$1" "SELECT id, outcome, sim_time_s FROM trial ORDER BY id"; }
values() {
  query "$scratch/$1" "SELECT trial_id, metric, subject_kind, subject, printf('%!.17g', value) FROM value
    WHERE metric NOT LIKE 'test_%' ORDER BY 1, 2, 3, 4; SELECT trial_id, metric, from_s, to_s, subjects, text,
    people, severity, x_m, y_m FROM event ORDER BY 1, 2, 3, 4, 5, 6, 7"
}
[[ $(trials faults) == "$(trials alone)" ]] || fail "faults of metrics change the trials"
[[ -n $(values alone) && $(values faults) == "$(values alone)" ]] || fail "faults of metrics change others' values"
[[ $(query "$scratch/faults" "SELECT DISTINCT metric FROM value WHERE metric LIKE 'test_%'") == test_none ]] ||
  fail "of the metrics under test only test_none should have given values"

expect() {
  for trial in 0 1; do
    expect_fault faults "trial.id = $trial AND plugin = 'test.metric.$1'" "$2|test.metric.$1|$3||${5:-}" "$4"
  done
}
samples=$(query "$scratch/faults" "SELECT value FROM value WHERE metric = 'test_none' AND trial_id = 0")
[[ ${samples%.*} -gt 50 ]] || fail "test_none should count samples, not give '$samples'"
expect crash crash "observe|9" "Segmentation fault" 11
expect exit exit "observe|9" "ended with status 0"
expect rounding abi_breach "observe|9" "floating-point control"
expect throw_in_begin error_status "begin|0" "^thrown on purpose$"
if $limited; then expect memory out_of_memory "observe|9" "."; fi
for trial in 0 1; do
  steps=$(query "$scratch/faults" "SELECT CAST(value AS INTEGER) FROM value WHERE metric = 'test_none' AND trial_id = $trial")
  for fault in "silent|bad_output|gave no system value of test_silent" \
    "flood|bad_output|the values and events of a metric in one trial take more than 32 MB" \
    "infinite|error_status|refused a value of test_infinite" \
    "beyond|error_status|refused a value of test_beyond.*it is [0-9]*, but its descriptor declares 0 to 1" "undeclared|error_status|refused a value of test_other"; do
    IFS='|' read -r name kind detail <<<"$fault"
    expect_fault faults "trial.id = $trial AND plugin = 'test.metric.$name'" \
      "$kind|test.metric.$name|finish|$steps||" "$detail"
  done
done

# a metric that fails once is measured again in the next trial
begin_experiment once global_planner local_controller
sed -i 's/^trials .*/trials = 3/' "$scratch/once.toml"
use once global_planner dmrp.planner.cbs
use once local_controller dmrp.controller.dwa
use once metric test.metric.recovers
expect_status 1 "$host" "$scratch/once.toml" --quiet --jobs 1 --out "$scratch/once"
[[ $(query "$scratch/once" "SELECT trial_id FROM fault") == 0 &&
  $(query "$scratch/once" "SELECT group_concat(trial_id) FROM value WHERE metric = 'test_recovers'") == 1,2 ]] ||
  fail "a metric should recover from an error by start()"
