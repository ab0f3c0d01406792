#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# A library without a fault passes; each case finds the fault that was planted for it; every case has one, and stands in
# the table of the documentation.
# Called as: planted_faults.sh DMRP_HOST LIBRARY LIBRARY_THAT_EXPORTS PAGE [SANITIZERS]
set -uo pipefail
host=$1 library=$2 exports=$3 page=$4 sanitizers=${5:-}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

fail() {
  echo "FAILED: $*" >&2
  exit 1
}

# subject|case|planted fault|result|what the finding says
faults=(
  'library|load/open|init fails|fail|no weights'
  'library|load/floating_point|rounds upward|fail|control bits'
  'library|load/process_state|sets the environment|fail|DMRP_TEST_SET'
  'library|load/threads|starts a thread|fail|starts 1 thread'
  'library|load/prints|prints|warn|6 bytes'
  'library|load/time|loads slowly|warn|to load'
  'library|load/init_twice|second init fails|fail|already loaded'
  'metric|descriptor/id|short id|warn|reverse DNS'
  'metric|descriptor/version|odd version|warn|semantic'
  'metric|descriptor/license|odd licence|warn|SPDX'
  'metric|descriptor/texts|no summary|warn|summary'
  'metric|descriptor/parameters|no doc|warn|no doc'
  'metric|descriptor/values|no unit|warn|no unit'
  'metric|descriptor/flags|unknown flag|warn|0x4000'
  'controller|descriptor/extensions|misspelt extension|warn|did you mean'
  'metric|descriptor/static|changes its descriptor|fail|another'
  'metric|parameters/defaults|refuses the default|fail|level is one'
  'metric|parameters/minimum|refuses the minimum|fail|level = 0.*level is zero'
  'metric|parameters/maximum|refuses the maximum|fail|level = 10.*level is ten'
  'controller|parameters/maximum|works long at the maximum|crash|level = 10'
  'metric|parameters/drawn|refuses other values|fail|level = '
  'people|parameters/choices|refuses a choice|fail|mode = "odd".*mode is odd'
  'metric|lifecycle/create_and_destroy|crashes at the 50th|crash|Aborted'
  'controller|lifecycle/start_and_destroy|uses the world in destroy|crash|destroy'
  'controller|lifecycle/start_after_start|keeps the last trial|fail|instead of'
  'metric|lifecycle/interleaved|shares a variable|fail|instead of'
  'metric|lifecycle/many_trials|tires|fail|instead of'
  'planner|lifecycle/static_variables|shares a variable|warn|changes static variables'
  'people|lifecycle/process_state|changes the folder|fail|working directory'
  'planner|status/ordinary_trial|odd status|fail|unknown status 99'
  'controller|status/ordinary_trial|writes to its input|crash|wrote to its input'
  'people|status/ordinary_trial|writes to the world|crash|wrote to its input'
  'people|status/ordinary_trial|writes too far|crash|beyond the end'
  'controller|status/ordinary_trial|reads beyond the agents|crash|beyond the end'
  'controller|status/ordinary_trial|keeps an agent|crash|for an earlier call'
  'metric|determinism/after_another_trial|keeps the first world|crash|for an earlier call or trial'
  'planner|status/no_way|calls it an error|fail|DMRP_ERROR'
  'metric|status/no_plan|wants a plan|fail|no system value'
  'people|status/no_robots|wants no agent|fail|DMRP_ERROR'
  'planner|determinism/same_seed|shares a variable|fail|instead of'
  'people|determinism/after_another_trial|keeps the last trial|fail|instead of'
  'people|determinism/after_other_meetings|remembers whom it met|fail|instead of'
  'controller|determinism/in_another_place|reads its address|fail|instead of'
  'people|determinism/in_another_place|reads what it never set|fail|instead of'
  'controller|determinism/leaping_clocks|stops by the clock|fail|instead of'
  'controller|determinism/long_trial|slips rarely|fail|instead of'
  'people|determinism/other_hours|works by day|fail|instead of'
  'planner|determinism/other_environment|reads its home|fail|instead of'
  'controller|numbers/limits|commands degrees|fail|times what the robot'
  'controller|numbers/nobody_near|divides by the agents|fail|nan'
  'people|numbers/crowd|has room for 100|crash|Aborted'
  'controller|numbers/touching|divides by the gap|fail|nan'
  'planner|numbers/goal_at_start|divides by the length|fail|invalid plan'
  'controller|numbers/one_waypoint|wants two waypoints|fail|two waypoints'
  'people|numbers/far_away|fears distance|fail|nan'
  'controller|numbers/drives|cannot drive sideways|fail|DMRP_ERROR'
  'controller|numbers/headings|fears headings|fail|nan'
  'metric|growth/longer_structs|compares struct_size|fail|another world'
  'metric|growth/unknown_constants|takes every contact|fail|instead of'
  'people|growth/longer_host|compares the host|fail|DMRP_ERROR'
  'planner|plans/windows|calls every path whole|fail|not at its goal'
  'planner|plans/goals|counts goals from 0|fail|goal'
  'planner|plans/resting|moves the dead|fail|not active'
  'controller|paths/ends|keeps its first path|fail|as if it had not been handed over'
  'controller|paths/directions|drives to the east|fail|in the direction'
  'people|people/groups|takes group 0 for a group|fail|instead of'
  'people|people/reactions|counts reactions|fail|instead of'
  'metric|metrics/channels|reads calls|fail|instead of'
  'controller|numbers/beyond_limits|takes a root of speeds|fail|nan'
  'controller|numbers/at_one_place|divides by the distance of two|fail|nan'
  'people|numbers/pressed|flees from a crowd|fail|velocity'
  'controller|numbers/later_goals|looks its goal up|crash|beyond the end'
  'metric|memory/bounds|counts by class|crash|beyond a block of its memory'
  'controller|steps/allocations|keeps more and more|warn|keeps about'
  'controller|steps/waiting|sleeps|warn|waits in'
  'people|should_stop/asks|computes in silence|fail|never asks should_stop'
  'planner|should_stop/often|never asks|warn|computes for'
  'controller|should_stop/first_ask|asks for ever|fail|told to stop'
  'controller|should_stop/later_ask|times out|fail|DMRP_TIMEOUT'
  'controller|threads/moves_between_threads|is bound to its thread|fail|instead of'
  'metric|threads/concurrent_instances|is one at a time|crash|two instances at the same time'
  'people|memory/leaks|leaks|fail|loses about'
  'people|extensions/undeclared|asks for the undeclared|warn|lidar'
  'controller|extensions/not_offered|needs the optional|crash|without dmrp.annotate'
  'people|trial/whole|wants a shape|fail|no shape'
  'metric|extensions/own_getter|offers anything|fail|not NULL'
)

skipped_by_sanitizers='memory/leaks\|memory/bounds\|steps/allocations\|should_stop/asks\|should_stop/often'
# a sanitizer reports what crashes at a fence
fenced='wrote to its input\|beyond the end\|for an earlier call'
[[ -z $sanitizers ]] || mapfile -t faults < <(printf '%s\n' "${faults[@]}" | grep -v "$skipped_by_sanitizers\\|$fenced")
for row in "${faults[@]}"; do
  IFS='|' read -r subject name fault result text <<<"$row"
  only="$subject $name\$"
  [[ $subject == library ]] || only="($only|^$only)"
  status=0
  DMRP_TEST_FAULT=$fault "$host" check "$library" --only "$only" >"$scratch/out" 2>&1 || status=$?
  ! grep -q "skip *$name: this kernel does not" "$scratch/out" || continue
  expected=1
  [[ $result != warn ]] || expected=0
  if ((status != expected)) || ! grep -Eq "^  $result +$name: .*$text" "$scratch/out"; then
    cat "$scratch/out"
    fail "'$fault' should be found by $name as $result: $text (status $status)"
  fi
  grep -q '^        rule: .' "$scratch/out" && grep -q '^        mend: .' "$scratch/out" || fail "$name explains nothing"
done

"$host" check "$exports" --only load/exports >"$scratch/out" || fail "exports are a warning"
grep -q 'warn *load/exports: .*planted_export' "$scratch/out" || fail "planted_export should be found"

# a plugin that says that it depends on timing is not tried on determinism
DMRP_TEST_FAULT='says that it draws in a thread' "$host" check "$library" --only 'controller determinism' >"$scratch/out" ||
  fail "timing that is declared is no fault: $(cat "$scratch/out")"
grep -q 'skip *determinism/same_seed, .*depend on timing: draws in a thread' "$scratch/out" ||
  fail "cases that do not apply should be skipped: $(cat "$scratch/out")"

# no finding without a fault
"$host" check "$library" --json >"$scratch/all.json" || { grep -B3 -A3 '"fail"\|"crash"' "$scratch/all.json"; fail "the library has no fault"; }
! grep -Eq '"result": "(warn|fail|crash)"' "$scratch/all.json" || fail "the library has no fault: $(grep -A1 '"warn"' "$scratch/all.json")"

# every case has its fault, and its row in the page
grep -o '"case": "[^"]*"' "$scratch/all.json" | cut -d'"' -f4 | sort -u >"$scratch/cases"
{
  printf '%s\n' "${faults[@]}" | cut -d'|' -f2
  echo load/exports
  [[ -z $sanitizers ]] || grep -o '[a-z_]*/[a-z_]*' <<<"$skipped_by_sanitizers"
} | sort -u >"$scratch/found"
diff "$scratch/cases" "$scratch/found" || fail "cases without a planted fault, or faults without a case"
grep -o '^- `[a-z_]*/[a-z_]*`' "$page" | tr -d '` -' | sort -u >"$scratch/documented"
diff "$scratch/cases" "$scratch/documented" || fail "the list of $page has other cases"
