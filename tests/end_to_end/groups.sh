#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# People who walk in groups, by every model: what is measured of groups has values, and the same ones from the traces.
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
  AND metric <> 'completion_time'") ]] || fail "a value is undefined that should not be"

expect_status 0 "$host" evaluate "$run" --csv "$scratch/values.csv"
"$check_values" "$run" "$scratch/values.csv" || fail "the traces give other values"
grep -q ',group_intrusions,' "$scratch/values.csv" || fail "nothing was measured of groups in the traces"

expect_status 0 "$host" "$run/effective.toml" --quiet --out "$scratch/again"
[[ $(values_of "$run") == "$(values_of "$scratch/again")" ]] || fail "effective.toml gives other groups"
