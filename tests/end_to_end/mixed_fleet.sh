#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Fleets of several types: the example, and all footprints and drives together, repeatable and without faults.
# Called as mixed_fleet.sh DMRP_HOST SOURCE_DIR CHECK_VALUES.
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
example=$2/examples/mixed_fleet.toml check_values=$3
run=$scratch/run

expect_status 0 "$host" "$example" --quiet --trials 2 --jobs 1 --out "$run"
expect_status 0 "$host" "$run/effective.toml" --quiet --jobs 2 --out "$scratch/two"
[[ $(values_of "$run") == "$(values_of "$scratch/two")" ]] || fail "effective.toml with --jobs 2 differs"
[[ $(query "$run" "SELECT count(*), sum(outcome = 'fault'), sum(repeatable) FROM trial") == "2|0|2" ]] ||
  fail "two sound trials should be there"
[[ $(query "$run" "SELECT min(value) FROM value WHERE metric = 'success' AND subject_kind = 'system'") == 1.0 ]] ||
  fail "every robot of the example should arrive"
expect_status 0 "$host" evaluate "$run" --csv "$scratch/values.csv"
"$check_values" "$run" "$scratch/values.csv" || fail "the traces give other values"

# one controller drives all four, and asks for nothing that a drive cannot do
[[ $(query "$run" "SELECT count(DISTINCT subject), sum(value) FROM value WHERE metric = 'clipped_commands' AND subject_kind = 'robot'") == "4|0.0" ]] ||
  fail "no command should be beyond a drive's ability"

# a union of polygons on a holonomic base
sed -e 's/^types .*/types = { default = 1, transporter = 1, tee = 1, tug = 1 }/' -e 's/"dmrp.controller.teb"/"dmrp.controller.pure_pursuit"/' \
  -e '/^params_file/d' "$example" >"$scratch/all.toml"
cat >>"$scratch/all.toml" <<'TOML'
[robot_type.tee]
footprint = { parts_m = [[[-0.4, -0.15], [0.4, -0.15], [0.4, 0.15], [-0.4, 0.15]], [[0.2, -0.4], [0.4, -0.4], [0.4, 0.4], [0.2, 0.4]]] }
drive = "holonomic"
TOML
expect_status 0 "$host" "$scratch/all.toml" --trials 2 --jobs 1 --out "$scratch/all"
grep -q "default [0-2] of 2 · transporter [0-2] of 2 · tee [0-2] of 2 · tug [0-2] of 2" "$scratch/stdout" ||
  fail "arrivals by type are missing: $(<"$scratch/stdout")"
expect_status 0 "$host" "$scratch/all.toml" --quiet --trials 2 --jobs 2 --out "$scratch/all2"
[[ $(values_of "$scratch/all") == "$(values_of "$scratch/all2")" ]] || fail "--jobs 2 differs from --jobs 1"
[[ $(query "$scratch/all" "SELECT sum(outcome = 'fault') FROM trial") == 0 ]] || fail "there are faults"
arrived=$(query "$scratch/all" "SELECT sum(value) FROM value WHERE metric = 'success' AND subject_kind = 'robot'")
((${arrived%.*} >= 4)) || fail "of 8 robots only $arrived arrived"

# controllers that cannot drive one of them: no car for DWA, nothing sideways for E3MoP
refuses() {
  sed "s/\"dmrp.controller.pure_pursuit\"/\"dmrp.controller.$1\"/" "$scratch/all.toml" >"$scratch/$1.toml"
  expect_status 2 "$host" validate "$scratch/$1.toml"
  grep -q "$2" "$scratch/stderr" || fail "$1: $(cat "$scratch/stderr")"
}
refuses dwa Ackermann
refuses e3mop holonomic

# planners that plan for robots of one kind refuse, at their place in the file
sed 's/"dmrp.planner.cbs"/"dmrp.planner.pibt"/' "$example" >"$scratch/pibt.toml"
expect_status 2 "$host" validate "$scratch/pibt.toml"
said="pibt\.toml:[0-9]+:[0-9]+: dmrp\.planner\.pibt cannot plan for scenario 'mall.*': robot . \(radius 0\.[0-9]+ m\) and robot "
said+=". \(radius 0\.[0-9]+ m\) can touch without meeting in a cell: radii of 1\.[0-9]+ m together"
grep -qE "$said" "$scratch/stderr" || fail "validate said: $(<"$scratch/stderr")"
expect_status 2 "$host" "$scratch/pibt.toml" --quiet --out "$scratch/pibt"
expect_status 0 "$host" validate "$example"
