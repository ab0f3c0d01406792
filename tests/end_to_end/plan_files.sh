#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# `[[global_planner]] file`: plans of other programs are driven as those of a planner. Called as: plan_files.sh DMRP_HOST
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
cd "$scratch" || exit 1

# experiment NAME [LINE...]: pure pursuit in the crossing, with one planner of these lines for each `file` or `use`
experiment() {
  {
    printf '[experiment]\nseed = 7\ntrials = 2\n'
    echo 'plugins = ["libdmrp_planners.so", "libdmrp_controllers.so", "libdmrp_pedestrians.so", "libdmrp_metrics.so"]'
    printf '[[scenario]]\nuse = "crossing"\n'
    printf '%s\n' "${@:2}"
    printf '[[local_controller]]\nuse = "dmrp.controller.pure_pursuit"\n'
    printf '[[pedestrian_model]]\nuse = "dmrp.pedestrian.social_force"\n'
  } >"$1.toml"
}
planner='[[global_planner]]'
# refused_once PATTERN ARGUMENT...
refused_once() {
  expect_status 2 "$host" "${@:2}"
  [[ $(messages) == 1 ]] || fail "${*:2}: not one line: $(cat stderr)"
  grep -Eq -- "$1" stderr || fail "${*:2}: '$(cat stderr)' does not match '$1'"
}
# refused PATTERN EXPERIMENT: by validate and by a run, in one line, with nothing half-done
refused() {
  refused_once "$1" validate "$2.toml"
  refused_once "$1" "$2.toml" --quiet --out "$2"
  [[ ! -e $2 ]] || fail "$2: a run directory was left"
}
# values_by PLANNER RUN: every value that no clock measured, and that is not the planner's own
values_by() {
  query "$2" "SELECT repetition, outcome, printf('%!.17g', sim_time_s), metric, subject_kind, subject,
      printf('%!.17g', coordinate), printf('%!.17g', value.value)
    FROM trial JOIN value ON trial_id = trial.id JOIN metric ON metric.name = metric WHERE wall_clock = 0
      AND global_planner = '$1' ORDER BY 1, 4, 5, 6, 7"
}

# --- a plan that is written and read back: the same paths, and the same trials

expect_status 0 "$host" plan --scenario crossing --planner dmrp.planner.cbs --paths cbs.csv
expect_status 0 "$host" plan --scenario crossing --planner dmrp.planner.sipp --paths sipp.csv
experiment both "$planner" 'use = "dmrp.planner.cbs"' 'label = "asked"' "$planner" 'file = "cbs.csv"'
expect_status 0 "$host" both.toml --jobs 2 --out both
[[ ! -s stderr ]] || fail "$(cat stderr)"
for repetition in 0 1; do
  cmp "both/plans/scenario_00_planner_0"{0,1}"_repetition_00000$repetition.csv" || fail "other paths"
done
[[ -n $(values_by cbs both) && $(values_by cbs both) == "$(values_by asked both)" ]] ||
  fail "other values: $(diff <(values_by asked both) <(values_by cbs both) | head)"
[[ $(query both "SELECT count(*) FROM trial WHERE global_planner = 'cbs' AND sim_time_s > 1") == 2 ]] ||
  fail "the plan should be driven"
# a file calls no planner
[[ $(query both "SELECT count(*) FROM value JOIN trial ON trial.id = trial_id WHERE metric IN ('plan_call_mean', 'planning_time')
  AND global_planner = 'cbs' AND value.value IS NOT NULL") == 0 ]] || fail "reading a file takes no planning time"

expect_status 0 "$host" validate "$here/../../examples/solver_plans.toml"

# --- a stored plan, which is in metres, is one that can be read; with a column for tasks

task=$(query both "SELECT DISTINCT task FROM trial")
stored=both/plans/scenario_00_planner_00_repetition_000000.csv
awk -v task="$task" 'NR == 1 { print "task," $0; next } { print task "," $0 }' $stored >metres.csv
experiment metres "$planner" 'file = "metres.csv"'
expect_status 0 "$host" metres.toml --quiet --out metres
cmp $stored metres/plans/scenario_00_planner_00_repetition_000000.csv || fail "other paths"
[[ $(values_by metres metres) == "$(values_by asked both)" ]] || fail "other values of a plan in metres"

# --- a file each; what a file does not hold is no plan

mkdir each
cp cbs.csv each/plan-001.csv
experiment each "$planner" 'file = "each/plan-{repetition}.csv"'
expect_status 0 "$host" each.toml --jobs 1 --out each_run
grep -q "^warning: plan: no plan for 1 of 2 tasks of scenario 'crossing': each/plan-{repetition}.csv: there is no file of \
repetition 0$" stderr || fail "$(cat stderr)"
[[ $(query each_run "SELECT repetition, sim_time_s > 1, outcome FROM trial ORDER BY id") == $'0|0|failed\n1|1|'* ]] ||
  fail "$(query each_run "SELECT * FROM trial")"
echo "task,agent,t,x,y" >empty.csv
experiment empty "$planner" 'file = "empty.csv"'
expect_status 0 "$host" validate empty.toml
grep -q "empty.csv: holds no plan of task $task" stderr || fail "$(cat stderr)"
expect_status 0 "$host" empty.toml --quiet --out empty
grep -q "\"text\": \"empty.csv: holds no plan of task $task\"" empty/plans/*.json || fail "no reason: $(cat empty/plans/*.json)"

# --- any angle: moving discs

printf 'agent,t,x,y\n0,0,0,3\n0,6,6,3\n1,0,3,0\n1,9.5,3,5\n' >any.csv
experiment any "$planner" 'file = "any.csv"' 'any_angle = true'
experiment ordered "$planner" 'file = "any.csv"' 'any_angle = true'
expect_status 0 "$host" any.toml --quiet --out any

# --- what no planner may give is told at its row before the first trial

# wrong NAME PATTERN SED
wrong() {
  sed "$3" cbs.csv >"$1.csv"
  experiment "$1" "$planner" "file = \"$1.csv\"" "${@:4}"
  refused "$2" "$1"
}
wrong jump "^jump.csv:5:1: invalid plan: robot 0, waypoint 3: the move is not one to a neighbour \(scenario 'crossing', repetition 0\)" '5s/,[0-9]*$/,0/'
wrong start "^start.csv:2:1: invalid plan: robot 0 begins at " '2s/.*/0,0,1,3/'
wrong robot "^robot.csv:[0-9]+:1: invalid plan: 1 paths for 2 robots" '/^1,/d'
wrong word "^word.csv:3:5: x must be a number, not 'one'" '3s/.*/0,1,one,3/'
wrong order "^order.csv:3:1: agent must be 0, or the next one, not 2" '3s/^0/2/'
wrong head "^head.csv:1:1: the first line must be " '1s/t/time/'
{
  printf 'agent,t,x,y\n'
  for step in {0..6}; do echo "0,$step,$step,3"; done
  printf '1,0,3,0\n1,1,3,1\n1,2,3,2\n1,3,3,3\n1,4,3,4\n1,5,3,5\n'
} >collides.csv
experiment collides "$planner" 'file = "collides.csv"'
refused "^collides.csv:5:1: invalid plan: vertex conflict of robots 0 and 1 at step 3" collides
printf 'agent,t,x,y\n0,0,0,3\n0,6,6,3\n1,0,3,0\n1,5,3,5\n' >discs.csv
experiment discs "$planner" 'file = "discs.csv"' 'any_angle = true'
refused "^discs.csv:3:1: invalid plan: robots 0 and 1 come within " discs
printf '\n[simulation]\nexecution = "ordered"\n' >>ordered.toml
refused "'ordered' needs plans from cell to cell, which any.csv does not make" ordered

# --- files are never asked again

experiment again "$planner" 'file = "cbs.csv"'
printf '\n[simulation]\nreplan_period_s = 1.0\n' >>again.toml
expect_status 0 "$host" again.toml --out again
grep -q "^warning: again.toml:8:8: plans from a file are never made anew" stderr || fail "$(cat stderr)"
[[ $(values_by cbs again) == "$(values_by cbs both)" ]] || fail "the plan was made anew"
printf 'replan_period_steps = 2\nreplan_window_steps = 2\n' >>again.toml
sed -i '/replan_period_s /d' again.toml
expect_status 2 "$host" validate again.toml
grep -q "cbs.csv cannot plan for a window" stderr || fail "$(cat stderr)"

# --- what the file holds is part of the run

expect_status 0 "$host" both.toml --quiet --jobs 1 --out one_job
[[ $(values_of both) == "$(values_of one_job)" ]] || fail "the results depend on --jobs"
for shard in 0 1; do expect_status 0 "$host" both.toml --quiet --shard $shard/2 --out part_$shard; done
expect_status 0 "$host" merge joined part_0 part_1
[[ $(values_of joined) == "$(values_of both)" ]] || fail "the joined run has other values"
for run in both each_run; do
  expect_status 0 "$host" bundle $run --out $run-bundle
  expect_status 0 "$host" verify $run-bundle
done
expect_status 0 "$host" both-bundle/experiment.toml --quiet --out moved
[[ $(values_of moved) == "$(values_of both)" ]] || fail "the bundle has other values"
expect_status 0 "$host" bundle each.toml --out each-bundle
expect_status 0 "$host" validate each-bundle/experiment.toml
expect_status 0 "$host" both.toml --debug 1
grep -Eq " after [1-9][0-9.]* s$" stdout || fail "$(cat stdout)"
expect_status 0 "$host" both.toml --quiet --resume --trials 3 --out both
cp sipp.csv cbs.csv
expect_status 2 "$host" both.toml --quiet --resume --out both
grep -q "global_planner\[1\].file was " stderr || fail "$(cat stderr)"
cp cbs.csv each/plan-000.csv
expect_status 2 "$host" each.toml --quiet --resume --out each_run
grep -q "global_planner\[0\].file was " stderr || fail "$(cat stderr)"

# --- a file that is edited before it is read ends the run, which keeps what is finished

mkdir many
for repetition in {0..9}; do cp metres.csv "many/$repetition.csv"; done
experiment many "$planner" 'file = "many/{repetition}.csv"'
sed -i 's/^trials = 2/trials = 10/' many.toml
"$host" many.toml --quiet --jobs 1 --out many_run 2>stderr &
run=$!
until compgen -G "many_run/plans/*.json" >/dev/null; do sleep 0.01; done
echo >>many/9.csv
status=0
wait $run || status=$?
[[ $status == 2 ]] || fail "exit status $status: $(cat stderr)"
grep -q "many.toml: changed (it, or a file that it names) while it was being run" stderr || fail "$(cat stderr)"
[[ $(query many_run "SELECT count(*) FROM trial WHERE repetition < 9 AND sim_time_s > 1") == 9 ]] ||
  fail "$(query many_run "SELECT id, outcome FROM trial")"
