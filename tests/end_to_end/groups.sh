#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# People who walk in groups, with every model: metrics of groups have values, and the same values from the traces.
# Called as groups.sh DMRP_HOST SOURCE_DIR CHECK_VALUES.
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
example=$2/examples/groups.toml check_values=$3
run=$scratch/run

expect_status 0 "$host" "$example" --quiet --trials 1 --jobs 1 --out "$run"
expect_status 0 "$host" "$example" --quiet --trials 1 --jobs 2 --out "$scratch/two"
[[ $(values_of "$run") == "$(values_of "$scratch/two")" ]] || fail "--jobs 2 differs from --jobs 1"
[[ $(query "$run" "SELECT count(*), sum(outcome = 'fault'), sum(repeatable) FROM trial") == "3|0|3" ]] ||
  fail "three sound trials should be there"
[[ $(query "$run" "SELECT count(*) FROM value WHERE metric IN ('group_intrusions', 'group_intrusion_time')
  AND value IS NOT NULL") == 18 ]] || fail "each trial and each robot of it should have both values"
[[ $(query "$run" "SELECT sum(value) > 0 FROM value WHERE metric = 'group_intrusions' AND subject_kind = 'system'") == 1 ]] ||
  fail "no robot ever came between companions"
[[ -z $(query "$run" "SELECT metric FROM value WHERE value IS NULL AND subject_kind = 'system'
  AND metric NOT IN ('completion_time', 'person_standoff', 'first_cause', 'culprit', 'held_behind',
    'after_standstill', 'impact_speed')") ]] ||
  fail "a value is undefined that should not be"

expect_status 0 "$host" evaluate "$run" --csv "$scratch/values.csv"
"$check_values" "$run" "$scratch/values.csv" || fail "the traces give other values"
grep -q ',group_intrusions,' "$scratch/values.csv" || fail "no metric of groups was measured from the traces"

expect_status 0 "$host" "$run/effective.toml" --quiet --out "$scratch/again"
[[ $(values_of "$run") == "$(values_of "$scratch/again")" ]] || fail "effective.toml gives other groups"

# If the path begins at 45 degrees, a pair stands across it: 0.62 m in each direction suffice, a strip of 0.1 m does not.
diagonal() {
  cat >"$scratch/diagonal.toml" <<TOML
[scenario]
name = "diagonal"
title = "Diagonal"
description = "a pair from corner to corner"
size_m = [20.0, 20.0]
time_limit_s = 30.0
[[region]]
name = "from"
lower_m = [3.0, 3.0]
upper_m = $1
[[region]]
name = "to"
lower_m = [16.0, 16.0]
upper_m = [17.0, 17.0]
[[flow]]
name = "pair"
from = "from"
to = "to"
people = 2
group_size = 2
TOML
  cat >"$scratch/diagonal_experiment.toml" <<TOML
[experiment]
name = "diagonal"
seed = 1
trials = 1
plugins = ["libdmrp_pedestrians.so", "libdmrp_metrics.so"]
[[scenario]]
use = "./diagonal.toml"
[[pedestrian_model]]
use = "dmrp.pedestrian.orca"
TOML
}
diagonal "[3.62, 3.62]"
expect_status 0 "$host" validate "$scratch/diagonal_experiment.toml"
diagonal "[3.85, 3.1]"
expect_status 2 "$host" validate "$scratch/diagonal_experiment.toml"
grep -q "no room in region 'from' for a group of 2" "$scratch/stderr" || fail "the strip is room for no pair"
