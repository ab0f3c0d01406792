#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# `verify` runs trials again in another order within a worker, and finds what differs.
# Called as: verify.sh DMRP_HOST LIBRARY_WITH_PLANTED_FAULTS
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
planted=$2
cd "$scratch" || exit 1

expect_status 0 "$host" "$here/crossing.toml" --trials 2 --quiet --jobs 1 --out run
for jobs in 1 2; do
  expect_status 0 "$host" verify run --trials 8 --jobs $jobs --seed $jobs
  grep -q "8 trials run again, equal to the bit" stdout || fail "$(cat stdout)"
  [[ ! -s stderr ]] || fail "nothing is to be said: $(cat stderr)"
done

# what differs: a value, an event, a trace, the experiment
expect_difference() {  # PATTERN RUN_DIR
  expect_status 1 "$host" verify "$2" --trials 100
  grep -Eq -- "$1" stdout || fail "'$(cat stdout)' does not match '$1'"
}
cp -r run changed
change="UPDATE value SET value = 123.25 WHERE trial_id = 5 AND metric = 'path_length' AND subject_kind = 'system'"
query changed "$change"
for command in verify report "compare run"; do
  # shellcheck disable=SC2086  # two words
  expect_status 2 "$host" $command changed
  grep -q "changed/results.sqlite: trial 5 has other values than the run has written: it was changed after the run" stderr ||
    fail "$command: $(cat stderr)"
done
rm -r changed
cp -r run changed
forge changed "$change"
expect_difference '^trial 5: path_length is [0-9.]+, was 123.25$' changed
[[ $(wc -l <stdout) == 2 ]] || fail "one difference, one line: $(cat stdout)"
cp run/traces/trial_000002.mcap changed/traces/trial_000007.mcap
expect_difference "^trial 7: the trace's digest is [0-9a-f]{64}, was [0-9a-f]{64}\$" changed

# the rules are those of the experiment, not of the file that is judged
cp -r run forged
forge forged "$change; UPDATE metric SET wall_clock = 1"
expect_difference '^trial 5: path_length is [0-9.]+, was 123.25$' forged
forge forged "DELETE FROM trial WHERE id = 3; DELETE FROM value WHERE trial_id = 3; DELETE FROM event WHERE trial_id = 3"
expect_difference '^1 of 8 trials are missing$' forged
forge forged "UPDATE trial SET local_controller = 'better' WHERE id = 2"
expect_difference "^trial 2: its controller is 'better', in this experiment '" forged
forge forged "UPDATE trial SET seed = 1 WHERE id = 4"
expect_difference "^trial 4: its seed is '1', in this experiment '" forged
query forged "CREATE TRIGGER falsify AFTER INSERT ON value BEGIN UPDATE value SET value = 0 WHERE rowid = NEW.rowid; END"
expect_status 2 "$host" verify forged
grep -q "forged/results.sqlite: has a trigger 'falsify' that no dmrp-host makes" stderr || fail "$(cat stderr)"
expect_status 2 "$host" "$here/crossing.toml" --trials 3 --quiet --resume --out forged
grep -q "has a trigger 'falsify'" stderr || fail "$(cat stderr)"
cp -r run imposter
query imposter "ALTER TABLE value RENAME TO kept; CREATE VIEW value AS WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL
  SELECT i FROM n) SELECT 0 AS trial_id, 'x' AS metric, 'system' AS subject_kind, i AS subject, 0 AS coordinate, 0 AS value FROM n"
expect_status 2 timeout 60 "$host" report imposter
grep -q "has a view 'value' that no dmrp-host makes" stderr || fail "$(cat stderr)"
# a plan or a trace that is not the row's
cp -r run swapped
cp run/traces/trial_000002.mcap swapped/traces/trial_000007.mcap
expect_status 2 "$host" evaluate swapped --trial 7
grep -q "trial 7: swapped/traces/trial_000007.mcap was changed after the run" stdout stderr || fail "$(cat stdout stderr)"
plan=swapped/plans/scenario_00_planner_00_repetition_000000
sed -i '2s/,[^,]*$/,1/' $plan.csv
expect_status 2 "$host" verify swapped --trials 8 --jobs 1
grep -q "$plan.csv: was changed after the planner was asked" stderr || fail "$(cat stderr)"
sed -i "s/\"paths_sha256\": \"[0-9a-f]*/\"paths_sha256\": \"$(sha256sum <$plan.csv | cut -d ' ' -f 1)/" $plan.json
expect_status 2 "$host" "$here/crossing.toml" --trials 3 --quiet --resume --out swapped
grep -q "trial [0-9]*: had another plan than plans/scenario_00_planner_00_repetition_000000.csv" stderr || fail "$(cat stderr)"
cp -r run relabelled
forge relabelled "UPDATE trial SET local_controller = 'better' WHERE id = 2"
expect_status 2 "$host" "$here/crossing.toml" --trials 3 --quiet --resume --out relabelled
grep -q "relabelled: trial 2: its controller is 'better', in this experiment '" stderr || fail "$(cat stderr)"

sed -i 's/^seed .*/seed = 8/' changed/effective.toml
expect_difference '^experiment.seed is 8, was 7$' changed
rm changed/effective.toml
expect_status 2 "$host" verify changed
grep -q 'effective.toml: there is no such experiment file' stderr || fail "$(cat stderr)"

# a plugin that keeps something from trial to trial is found, because the order is another
sed -e "s|\"libdmrp_metrics.so\"|\"$planted\"|" "$here/crossing.toml" >leaky.toml
expect_status 0 "$host" leaky.toml --trials 2 --quiet --jobs 1 --out leaky_good
expect_status 0 "$host" verify leaky_good --trials 8 --jobs 1
export DMRP_TEST_FAULT='shares a variable'
expect_status 0 "$host" leaky.toml --trials 2 --quiet --jobs 1 --out leaky
expect_status 1 "$host" verify leaky --trials 8 --jobs 1
