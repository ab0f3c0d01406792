#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# One plan for a task: trials that differ in controller or pedestrian model alone have the plan that the first one made.
# Called as: plans.sh DMRP_HOST LIBRARY_OF_FAULTS
source "$(dirname "${BASH_SOURCE[0]}")/faults.sh"
cd "$scratch" || exit 1

# experiment NAME FAULT: two planners, of which one has a fault, two controllers, two repetitions: eight trials
experiment() {
  begin_experiment "$1" global_planner
  sed -i 's/^trials .*/trials = 2/' "$1.toml"
  use "$1" metric dmrp.metric.success
  use "$1" metric dmrp.metric.compute_time
  use "$1" global_planner dmrp.planner.cbs
  use "$1" global_planner test.planner.faulty "$2"
}
plans_of() { (cd "$1/plans" && sha256sum ./*.csv); }
# the numbers that a clock measured, too
planning_of() {
  query "$1" "SELECT repetition, global_planner, count(DISTINCT value), count(*) FROM value JOIN trial ON id = trial_id
    WHERE metric = 'plan_call_mean' GROUP BY repetition, global_planner"
}
calls_of() { grep -c 'test.planner.faulty .*: plans' "$1/log.txt"; }

experiment shared none
for jobs in 1 2; do
  expect_status 0 "$host" shared.toml --quiet --jobs $jobs --out shared_$jobs
  [[ $(calls_of shared_$jobs) == 2 ]] || fail "one call a repetition, not $(calls_of shared_$jobs)"
  (($(planning_of shared_$jobs | grep -c '|1|2$') == 4)) || fail "one planning time a plan: $(planning_of shared_$jobs)"
  (($(find shared_$jobs/plans -type f | wc -l) == 8)) || fail "four plans, of two files each: $(ls shared_$jobs/plans)"
done
[[ $(plans_of shared_1) == "$(plans_of shared_2)" ]] || fail "the plans depend on --jobs"
[[ $(values_of shared_1) == "$(values_of shared_2)" ]] || fail "the results depend on --jobs"
digests() {
  rm -rf digests
  expect_status 0 "$host" bundle "$1" --out digests
  cut -d ' ' -f 1 digests/trace_digests.txt
}
expected=$(digests shared_1)
[[ $(digests shared_2) == "$expected" ]] || fail "the traces depend on --jobs"

# --resume and --trials plan what is missing, and nothing else
query shared_2 "PRAGMA foreign_keys = ON; DELETE FROM trial WHERE id % 2 = 0"
expect_status 0 "$host" shared.toml --quiet --resume --trials 3 --out shared_2
[[ $(calls_of shared_2) == 3 ]] || fail "the third repetition alone is new: $(calls_of shared_2) calls"
[[ $(digests shared_2 | head -8) == "$expected" ]] || fail "a run that went on has other traces"

# a bundle has them, and verify reads them: a planner that would plan otherwise is not asked
experiment restless restless
expect_status 0 "$host" restless.toml --quiet --jobs 1 --out restless --bundle restless-bundle
expect_status 0 "$host" verify restless-bundle --trials 8 --trust
grep -q "8 trials run again, equal to the bit" stdout || fail "$(cat stdout stderr)"

# where something can replan, the planner is asked in each trial, and must give the same plan
cp restless.toml replanning.toml
printf '\n[simulation]\nreplan_period_s = 100.0\n' >>replanning.toml
expect_status 0 "$host" replanning.toml --quiet --jobs 1 --out replanning
[[ $(calls_of replanning) == 4 ]] || fail "a call a trial, not $(calls_of replanning)"
unlike=$(query replanning "SELECT id FROM trial WHERE NOT repeatable")
[[ $unlike == "3
7" ]] || fail "the second trial of each repetition has another plan than the first, not: $unlike"
grep -q "its first plan is another than the run has stored" replanning/manifest.json || fail "the manifest tells no reason"

# of a fault of the planner each trial of the plan has a row, without another call
expect_rows() {  # FAULT ROW DETAIL_PATTERN
  expect_status 1 "$host" "$1.toml" --quiet --jobs 2 --out "$1"
  expect_fault "$1" "global_planner = '$1'" "$(printf '%s\n' "$2" "$2" "$2" "$2")" "$3"
}
experiment throw throw
expect_rows throw 'error_status|test.planner.faulty|plan|0||' '^thrown on purpose$'
(($(calls_of throw) == 2)) || fail "$(calls_of throw) calls"
expect_status 1 "$host" throw.toml --quiet --resume --retry-faults --out throw
(($(calls_of throw) == 4)) || fail "--retry-faults should ask again: $(calls_of throw) calls"
experiment crash crash
expect_rows crash 'crash|test.planner.faulty|plan|0||11' 'Segmentation fault'

# shards join if they have made the same plans
for shard in 0 1 2; do expect_status 0 "$host" shared.toml --quiet --shard $shard/3 --out part_$shard; done
expect_status 0 "$host" merge joined part_0 part_1 part_2
[[ $(plans_of joined) == "$(plans_of shared_1)" ]] || fail "the joined run has other plans"
plan=$(cd part_1/plans && printf '%s\n' *planner_01*.json | head -1)
sed -i 's/"paths_sha256": "./&x/' "part_1/plans/$plan"
expect_status 2 "$host" merge none part_0 part_1 part_2
grep -q "part_[12]: plan ${plan%.json} is another than that of part_[01]" stderr || fail "$(cat stderr)"

# a stored plan that was changed is named; if its digest was changed, too, then the mistake in it
sed -i '3s/,[^,]*,/,late,/' "shared_1/plans/${plan%.json}.csv"
query shared_1 "PRAGMA foreign_keys = ON; DELETE FROM trial"
expect_status 2 "$host" shared.toml --quiet --resume --out shared_1
grep -q "${plan%.json}.csv: was changed after the planner was asked" stderr || fail "$(cat stderr)"
digest=$(sha256sum <"shared_1/plans/${plan%.json}.csv" | cut -d ' ' -f 1)
sed -i "s/\"paths_sha256\": \"[0-9a-f]*/\"paths_sha256\": \"$digest/" "shared_1/plans/$plan"
query shared_1 "PRAGMA foreign_keys = ON; DELETE FROM trial"
expect_status 1 "$host" shared.toml --quiet --resume --out shared_1
query shared_1 "SELECT detail FROM fault" | grep -q "${plan%.json}.csv:3:3: t_ns must be a whole number, not 'late'" ||
  fail "$(query shared_1 "SELECT detail FROM fault")"
