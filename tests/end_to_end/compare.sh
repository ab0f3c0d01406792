#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# `compare` of runs before and after a change: its table and the exit statuses of --fail-if.
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"

before=$scratch/before
after=$scratch/after
sed 's/^use = "crossing"$/&\nrobots = 2\ntasks = { drawn = 40 }/' "$here/crossing.toml" >"$scratch/tasks.toml"
expect_status 0 "$host" "$scratch/tasks.toml" --quiet --trials 40 --out "$before"
cp -r "$before" "$after"

expect_status 0 "$host" compare "$before" "$after" --fail-if "success < -0.02"
grep -Eq "^160 trials in both: " "$scratch/stdout" || fail "not all trials are matched: $(cat "$scratch/stdout")"
grep -Eq "success +160 +40 .* 0.000 \[-0.[0-9]+, \+0.[0-9]+\] +=" "$scratch/stdout" || fail "equal runs differ: $(cat "$scratch/stdout")"

# published results, a folder with manifest.json and trials.csv alone, are compared as the run that they are of
python3 "$here/../../examples/dmrp1/reference.py" "$before" "$scratch/published"
for first in "$before" "$scratch/published"; do
  expect_status 0 "$host" compare "$first" "$after" --metric success,path_length
  grep -v "^before" "$scratch/stdout" >"$first.txt"
done
cmp "$before.txt" "$scratch/published.txt" || fail "published results are compared in another way than their run"
sed '3s/[^,]*$/many/' "$scratch/published/trials.csv" >"$scratch/trials.csv"
mv "$scratch/trials.csv" "$scratch/published"
expect_status 2 "$host" compare "$scratch/published" "$after"
grep -Eq "published/trials.csv:3:[0-9]+: pfd must be a number, not 'many'" "$scratch/stderr" ||
  fail "a damaged field is not named: $(cat "$scratch/stderr")"
sed -i '1s/,seed,/,seeds,/' "$scratch/published/trials.csv"
expect_status 2 "$host" compare "$scratch/published" "$after"
grep -q "published/trials.csv:1:1: there is no column seed" "$scratch/stderr" ||
  fail "a missing column is not named: $(cat "$scratch/stderr")"

# fewer arrive in every trial
forge "$after" "UPDATE value SET value = 0.1 WHERE metric = 'success' AND subject_kind = 'system'"
expect_status 1 "$host" compare "$before" "$after" --fail-if "success < -0.02" --fail-if "success > 0.02"
grep -q "success < -0.02: YES" "$scratch/stdout" || fail "the condition is not named"
expect_status 0 "$host" compare "$after" "$before" --fail-if "success < -0.02"
# no interval can lie on one side of what it straddles
forge "$before" "UPDATE value SET value = 0.5 WHERE metric = 'success' AND subject_kind = 'system'"
forge "$after" "UPDATE value SET value = (SELECT repetition % 2 FROM trial WHERE trial.id = trial_id) WHERE
  metric = 'success' AND subject_kind = 'system'"
expect_status 4 "$host" compare "$before" "$after" --fail-if "success < -0.02"

# three crowds on one task are three observations: no p
expect_status 0 "$host" "$here/crossing.toml" --quiet --trials 3 --out "$scratch/few"
cp -r "$scratch/few" "$scratch/changed"
forge "$scratch/changed" "UPDATE value SET value = 0.1 WHERE metric = 'success' AND subject_kind = 'system'"
expect_status 0 "$host" compare "$scratch/few" "$scratch/changed" --metric success
grep -Eq "success +12 +3 .* 0.100 .* –$" "$scratch/stdout" ||
  fail "three observations have a p: $(cat "$scratch/stdout")"

# of two runs that share a part of their tasks, that part is counted
expect_status 0 "$host" "$scratch/tasks.toml" --quiet --trials 10 --out "$scratch/part"
expect_status 0 "$host" compare "$before" "$scratch/part" --metric success
grep -q "^40 trials in both, 120 only before, 0 only after: 10 drawn tasks$" "$scratch/stdout" ||
  fail "tasks of one run alone are counted: $(cat "$scratch/stdout")"

refused() {
  expect_status 2 "$host" compare "${@:2}"
  [[ $(messages) == 1 ]] || fail "not one line: $(cat "$scratch/stderr")"
  grep -Eq "$1" "$scratch/stderr" || fail "'$(cat "$scratch/stderr")' does not match '$1'"
}
expect_status 0 "$host" compare "$scratch/few" "$scratch/changed" --metric success --json
grep -Eq '"differences":\[\{"metric":"success","pairs":12,"n":3,' "$scratch/stdout" || fail "no JSON of the differences"
[[ $(wc -l <"$scratch/stdout") == 1 ]] || fail "more than one JSON object: $(cat "$scratch/stdout")"

refused "did you mean 'success'" "$before" "$after" --fail-if "sucess < 0"
refused "not of the form" "$before" "$after" --fail-if "success = 0"
refused "is no run directory" "$before" "$scratch"
forge "$after" "UPDATE trial SET seed = seed + 1"
refused "no trial has scenario, robots, seed and labels" "$before" "$after"
