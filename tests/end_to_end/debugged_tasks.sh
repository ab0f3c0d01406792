#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# `run FILE --debug TRIAL` meets the drawn task that the trial met in the run, also when the tasks begin again.
# Called as: debugged_tasks.sh DMRP_HOST
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
experiment=$scratch/drawn.toml
sed 's/^use = "crossing"/&\nrobots = 2\ntasks = { drawn = 2, conflicts_min = 1, conflicts_max = 1, crossing = "any" }/' \
  "$here/crossing.toml" >"$experiment"
expect_status 0 "$host" "$experiment" --quiet --out "$scratch/run"
for trial in 1 5 9; do # the repetitions 0, 1 and 2 of one combination
  expect_status 0 "$host" run "$experiment" --debug "$trial"
  stored=$(query "$scratch/run" "SELECT printf('%g', value) FROM value
    WHERE trial_id = $trial AND metric = 'path_length' AND subject_kind = 'system'")
  grep -Eq "^  path_length +$stored\$" "$scratch/stdout" || fail "trial $trial: not $stored: $(cat "$scratch/stdout")"
done
