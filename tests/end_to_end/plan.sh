#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# `dmrp-host plan`: called as plan.sh DMRP_HOST CHECK_PATHS LIBRARY_OF_FAULTS [SANITIZERS]. CHECK_PATHS
# validates the path files independently.
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
check_paths=$2
faults=$3
sanitizers=${4:-}
planners=$(dirname "$host")/../lib/dmrp/plugins/libdmrp_planners.so
maps=$here/maps
keys="solved valid cost lower_bound makespan plan_turns planning_ms high_level_expanded low_level_expanded peak_rss_mb status"

# json FILE EXPRESSION: of SQL, with the document as `json`
json() {
  sqlite3 -batch :memory: "SELECT $2 FROM (SELECT CAST(readfile('$1') AS TEXT) AS json)" || fail "sqlite3: $2"
}
value() { json "$scratch/stdout" "coalesce(json_extract(json, '$.$1'), 'null')"; }
expect_value() { [[ $(value "$1") == "$2" ]] || fail "$1 is $(value "$1"), not $2: $(cat "$scratch/stdout")"; }

# plan STATUS MAP AGENTS ARGUMENT...: as JSON, with all keys
plan() {
  expect_status "$1" "$host" plan --map "$maps/$2.map" --scen "$maps/$2.scen" --agents "$3" --json "${@:4}"
  local key
  for key in $keys; do
    [[ -n $(json "$scratch/stdout" "json_type(json, '$.$key')") ]] || fail "no key '$key': $(cat "$scratch/stdout")"
  done
}

# --- every planner of the library: its paths are valid, and its figures agree with them

"$host" plugins --json "$planners" >"$scratch/plugins.json" || fail "plugins --json"
sqlite3 -batch -separator ' ' :memory: "SELECT json_extract(plugin.value, '\$.id'),
  json_extract(plugin.value, '\$.connectivity'), json_extract(plugin.value, '\$.flags') LIKE '%uncoordinated%'
  FROM json_each(CAST(readfile('$scratch/plugins.json') AS TEXT)) AS library,
  json_each(library.value, '\$.plugins') AS plugin" >"$scratch/planners"
[[ $(wc -l <"$scratch/planners") -ge 2 ]] || fail "the library should have planners"

while read -r id connectivity uncoordinated; do
  for case in "bay 2" "rooms 1" "rooms 8"; do
    read -r map agents <<<"$case"
    csv=$scratch/paths.csv
    plan 0 "$map" "$agents" --planner "$id" --seed 7 --paths "$csv"
    [[ ! -s $scratch/stderr ]] || fail "$id on $map: $(cat "$scratch/stderr")"
    expect_value solved 1
    expect_value valid 1
    expect_value status ok
    expected=0
    ((uncoordinated && agents > 1)) && expected=1
    judged=$("$check_paths" "$maps/$map.map" "$maps/$map.scen" "$agents" "$connectivity" "$csv" 2>/dev/null)
    [[ $? == "$expected" ]] || fail "$id on $map: $judged"
    [[ $(printf 'cost %.6f makespan %d' "$(value cost)" "$(value makespan)") == "${judged% conflicts*}" ]] ||
      fail "$id on $map: $judged is not what the host says: $(cat "$scratch/stdout")"
    [[ $(json "$scratch/stdout" "coalesce(json_extract(json, '\$.lower_bound') <= json_extract(json, '\$.cost') + 1e-6, 1)
      AND json_extract(json, '\$.planning_ms') > 0 AND json_extract(json, '\$.peak_rss_mb') > 1") == 1 ]] ||
      fail "$id on $map: impossible figures: $(cat "$scratch/stdout")"
    # the same seed gives the same file
    plan 0 "$map" "$agents" --planner "$id" --seed 7 --paths "$scratch/again.csv"
    cmp -s "$csv" "$scratch/again.csv" || fail "$id on $map: another file from the same seed"
  done
  plan 0 cut_off 1 --planner "$id" --paths "$csv"
  expect_value solved 0
  expect_value status no_solution
  expect_value valid null
  expect_value cost null
  [[ ! -e $csv ]] || fail "$id: the paths of an earlier plan are still there"
done <"$scratch/planners"

# --- figures computed by hand: one robot along the bay's corridor; the mall, as text

plan 0 bay 1 --planner dmrp.planner.cbs --paths "$scratch/one.csv"
expect_value cost 6
expect_value makespan 6
expect_value plan_turns 0
[[ $(cat "$scratch/one.csv") == $'agent,t,x,y\n0,0,0,2\n0,1,1,2\n0,2,2,2\n0,3,3,2\n0,4,4,2\n0,5,5,2\n0,6,6,2' ]] ||
  fail "$(cat "$scratch/one.csv")"
plan 0 rooms 8 --planner dmrp.planner.individual
[[ $(value conflicts) -gt 0 ]] || fail "conflicts of uncoordinated paths should be counted"
expect_status 0 "$host" plan --scenario mall --planner dmrp.planner.cbs
grep -q "cost  *63$" "$scratch/stdout" || fail "$(cat "$scratch/stdout")"

# --- planners that break their contract: one line, status 1

# expect_fault FAULT STATUS_WORD PATTERN ARGUMENT...
expect_fault() {
  expect_status 1 "$host" plan --scenario crossing --planner test.planner.faulty --plugin "$faults" --set "fault=$1" \
    --paths "$scratch/faulty.csv" --json "${@:4}"
  expect_value status "$2"
  expect_value solved 0
  [[ $(grep -Ecv "^(=|AddressSan)|^ *#|^$|: plans$" "$scratch/stderr") == 1 ]] || fail "$1: not one line: $(cat "$scratch/stderr")"
  grep -Eq "$3" "$scratch/stderr" || fail "$1: $(cat "$scratch/stderr")"
  [[ ! -e $scratch/faulty.csv ]] || fail "$1: paths of no plan"
}
expect_status 0 "$host" plan --scenario crossing --planner test.planner.faulty --plugin "$faults" --json
expect_value cost 13
expect_fault crash crash "^test.planner.faulty: plan\(\): crashed \(signal 11, Segmentation fault\)$"
expect_fault abort crash "signal 6"
expect_fault exit exit "ended the process with status 0"
expect_fault throw error_status "thrown on purpose"
expect_fault unknown_status abi_breach "unknown status 99"
expect_fault rounding abi_breach "floating-point control"
expect_fault hang hang "plan\(\): did not stop when its time of 0.2 s was over" --time-limit 0.2
expect_fault conflict bad_output "vertex conflict of robots 0 and 1 at step 3"
expect_value valid 0
expect_fault teleport bad_output "robot 0, waypoint 3"
expect_fault into_wall bad_output "not on a free cell"
expect_fault missing_path bad_output "without a path for every robot"
if [[ -z $sanitizers ]]; then (
  ulimit -v 700000
  expect_fault memory out_of_memory "test.planner.faulty: plan\(\): "
) || exit 1; fi
expect_status 0 "$host" plan --scenario crossing --planner test.planner.faulty --plugin "$faults" --set fault=timeout --json
expect_value status timeout

# figures of a planner that contradict its paths are no fault
expect_status 0 "$host" plan --scenario crossing --planner test.planner.faulty --plugin "$faults" --set fault=wrong_cost --json
expect_value cost 13
grep -q "^warning: test.planner.faulty: the planner reports a cost of 12, its paths cost 13$" "$scratch/stderr" ||
  fail "$(cat "$scratch/stderr")"

# --- drawn tasks; the memory limit

expect_status 0 "$host" plan --map "$maps/rooms.map" --draw 12 --seed 3 --planner dmrp.planner.lns --paths "$scratch/drawn.csv" --json
expect_value solved 1
expect_value robots 12
expect_status 0 "$host" plan --map "$maps/rooms.map" --draw 12 --seed 3 --planner dmrp.planner.lns --paths "$scratch/again.csv" --json
cmp -s "$scratch/drawn.csv" "$scratch/again.csv" || fail "other tasks from the same seed"
expect_status 0 "$host" plan --map "$maps/rooms.map" --draw 12 --seed 4 --planner dmrp.planner.lns --paths "$scratch/again.csv" --json
cmp -s "$scratch/drawn.csv" "$scratch/again.csv" && fail "the same tasks from another seed"
if [[ -z $sanitizers ]]; then
  expect_fault memory out_of_memory "test.planner.faulty: plan\(\): .*memory_mb = 700" --memory-limit 700
fi

# --- mistakes: one line, status 2

cd "$scratch" || exit 1
cp "$maps"/*.map "$maps"/*.scen .
# expect_mistake PATTERN ARGUMENT...
expect_mistake() {
  expect_status 2 "$host" plan "${@:2}"
  [[ $(messages) == 1 && ! -s $scratch/stdout ]] || fail "not one line: $(cat "$scratch/stderr")"
  grep -Eq -- "$1" "$scratch/stderr" || fail "'$(cat "$scratch/stderr")' does not match '$1'"
}
on_map() { expect_mistake "$1" --map "$2" --scen "$3" --agents "${4:-1}" --planner dmrp.planner.cbs "${@:5}"; }
on_map "^none.map: there is no such file$" none.map bay.scen
on_map "^none.scen: there is no such file$" bay.map none.scen
on_map "^--agents 3: bay.scen has 2 tasks$" bay.map bay.scen 3
on_map "^bay.scen:2:11: the task is for another map: 'bay.map' of 7 x 3 cells, not 10 x 9$" rooms.map bay.scen
on_map "^bay.scen:1:1: expected 'type octile'" bay.scen bay.scen
on_map "^bay.map:1:1: expected 'version 1'" bay.map bay.map
# broken PATTERN SED [FILE]
broken() {
  cp "$maps/bay.map" broken.map
  cp "$maps/bay.scen" broken.scen
  sed -i "$2" "broken.${3:-map}"
  on_map "^broken.${3:-map}:$1" broken.map broken.scen 2
}
broken "3:1: expected 'height N'" 2d
broken "2:8: height must be a whole number, not 'x'" 's/height 3/height x/'
broken "2:8: height must be 1 to 10000, not 0" 's/height 3/height 0/'
broken "3:7: width must be 1 to 10000, not 99999999999999999999" 's/width 7/width 99999999999999999999/'
broken "3:1: the map is too large" 's/height 3/height 9999/;s/width 7/width 9999/'
broken "4:1: expected 'map'" 4d
broken "6:5: unknown cell 'x'" '6s/\./x/'
broken "7:7: the row has 6 cells, not width = 7" '7s/\.$//'
broken "5:8: the row has 8 cells, not width = 7" '5s/$/@/'
broken "7:1: the map ends after 2 rows, before height = 3" 7d
broken "8:1: a row beyond height = 3" '$p'
broken "3:[0-9]*: a task has 9 fields .*, not 8" '3s/\t6$//' scen
broken "2:15: the start's x must be 0 to 6, not 7" '2s/\t0\t2\t6/\t7\t2\t6/' scen
broken "2:19: the goal \(6, 1\) is on a blocked cell" '2s/\t6\t2\t6$/\t6\t1\t6/' scen
broken "3:1: agents 0 and 1 both start at \(0, 2\)" '3s/\t6\t2\t0/\t0\t2\t1/' scen
broken "3:1: agents 0 and 1 both end at \(6, 2\)" '3s/\t0\t2\t6$/\t6\t2\t6/' scen
expect_mistake "no such planner.*did you mean 'dmrp.planner.cbs'" --scenario mall --planner dmrp.planner.csb
expect_mistake "^--set node_limits=4: unknown key .*did you mean 'node_limit'" --scenario mall --planner dmrp.planner.cbs --set node_limits=4
expect_mistake "^--set node_limit=few: 'node_limit' must be an integer" --scenario mall --planner dmrp.planner.cbs --set node_limit=few
expect_mistake "needs --map, --scen and --agents together, or --map and --draw, or --scenario, with or without --agents" --map bay.map --scen bay.scen --planner dmrp.planner.cbs
expect_mistake "there is no such library" --scenario mall --planner dmrp.planner.cbs --plugin ./nothing.so
expect_mistake "there is no folder" --scenario mall --planner dmrp.planner.cbs --paths nowhere/paths.csv
expect_mistake "time-limit" --scenario mall --planner dmrp.planner.cbs --time-limit -1

# a renamed map is a warning only
cp bay.map other.map
expect_status 0 "$host" plan --map other.map --scen bay.scen --agents 2 --planner dmrp.planner.cbs
[[ $(cat stderr) == "warning: bay.scen: its tasks are for 'bay.map', not 'other.map'" ]] || fail "$(cat stderr)"
