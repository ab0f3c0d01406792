#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Metrics over stored traces have the values of the run, bit by bit; other metrics can be measured later; traces that
# cannot be measured are reported. Called as: evaluate.sh DMRP_HOST CHECK_VALUES LIBRARY_OF_FAULTS
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
check_values=$2 faults=$3
run=$scratch/run all=$scratch/all.csv some=$scratch/some.csv

# expect_line PATTERN: on standard error, which has LINES lines (1 unless said)
expect_line() {
  [[ $(messages) == "${2:-1}" ]] || fail "not ${2:-one} line(s): $(cat "$scratch/stderr")"
  grep -Eq -- "$1" "$scratch/stderr" || fail "'$(cat "$scratch/stderr")' does not match '$1'"
}
evaluate() {
  expect_status "$1" "$host" evaluate "$run" "${@:2}"
}
expect_same() {
  "$check_values" "$1" "$2" || fail "values of $2 differ from those of $1"
}

# every metric of every loaded library, four combinations
expect_status 0 "$host" "$here/crossing.toml" --trials 2 --quiet --out "$run"
evaluate 0 --csv "$all"
[[ ! -s $scratch/stdout && ! -s $scratch/stderr ]] || fail "nothing else is to say: $(cat "$scratch/stdout" "$scratch/stderr")"
[[ $(wc -l <"$all") == $(($(query "$run" "SELECT count(*) FROM value") + 1)) ]] || fail "not all values are there"
expect_same "$run" "$all"

# one metric, some trials, on standard output
evaluate 0 --metric dmrp.metric.sto --trial 3 --trial 5
expect_same "$run" "$scratch/stdout"
[[ $(cut -d, -f1 "$scratch/stdout" | sort -u | tr '\n' ' ') == "3 5 trial " ]] || fail "not trials 3 and 5"
cp "$scratch/stdout" "$some"

# other parameters give other values; evaluate takes the parameters of the run
evaluate 0 --metric dmrp.metric.sto --set distance_m=1.5 --csv "$scratch/wider.csv"
grep -q , "$scratch/wider.csv" && ! cmp -s <(grep -E '^(3|5),' "$scratch/wider.csv") <(grep -E '^(3|5),' "$some") ||
  fail "a wider distance should show"
sed '$a [[metric]]\nuse = "dmrp.metric.sto"\nparams = { distance_m = 1.5 }' "$here/crossing.toml" >"$scratch/wide.toml"
expect_status 0 "$host" "$scratch/wide.toml" --trials 2 --quiet --out "$scratch/wide"
expect_same "$scratch/wide" "$scratch/wider.csv"
expect_status 0 "$host" evaluate "$scratch/wide" --csv "$scratch/again.csv"
cmp -s "$scratch/again.csv" "$scratch/wider.csv" || fail "the run's own parameters should be used"
metrics=$(dirname "$host")/../lib/dmrp/plugins/libdmrp_metrics.so
expect_status 0 "$host" evaluate "$scratch/wide" --plugin "$metrics"
# recoveries and interventions are measured by a run only where robots have some
other=$(query "$run" "SELECT group_concat(name, '|') || '|recoveries|interventions|intervention_time' FROM metric WHERE wall_clock OR name LIKE 'sto%'")
cmp -s <(grep -Ev ",($other)," "$scratch/stdout" | sort) <(grep -Ev ",($other)," "$all" | sort) &&
  cmp -s <(grep ,sto, "$scratch/stdout") <(grep ,sto, "$scratch/wider.csv") ||
  fail "a library should add its metrics to the run's"
printf 'distance_m = 1.5\n' >"$scratch/wide_sto.toml"
evaluate 0 --metric dmrp.metric.sto --params-file "$scratch/wide_sto.toml"
cmp -s "$scratch/stdout" "$scratch/wider.csv" || fail "a parameter file should do as --set does"

# a metric of another library: it counts samples, one each 20 ms and one at the beginning
evaluate 0 --metric test.metric.none --plugin "$faults"
[[ $(wc -l <"$scratch/stdout") == 9 ]] || fail "eight trials should have a value"
[[ $(sed -n 2p "$scratch/stdout") == "0,test_none,system,,,$(query "$run" \
  "SELECT CAST(round(sim_time_s / 0.02) AS INTEGER) + 1 FROM trial WHERE id = 0")" ]] || fail "$(sed -n 2p "$scratch/stdout")"

# a metric that ends its process loses only its own value of that trial
evaluate 1 --metric test.metric.crash --plugin "$faults" --trial 2
expect_line '^trial 2: test.metric.crash: observe\(\): crashed \(signal 11, Segmentation fault\)$'
for fault in "exit: observe\(\): ended the process with status 0" "throw_in_begin: begin\(\): thrown on purpose" \
  "silent: finish\(\): gave no system value of test_silent"; do
  evaluate 1 --metric "test.metric.${fault%%:*}" --plugin "$faults" --trial 1 --trial 2
  expect_line "^trial 1: test.metric.$fault" 2
  expect_line "^trial 2: test.metric.$fault" 2
  [[ $(wc -l <"$scratch/stdout") == 1 ]] || fail "${fault%%:*} should give no value"
done
evaluate 1 --metric test.metric.recovers --plugin "$faults" --trial 1 --trial 2
expect_line "^trial 1: test.metric.recovers: begin\(\): thrown on purpose"
[[ $(cut -d, -f1,2 "$scratch/stdout" | tail -1) == 2,test_recovers ]] || fail "the next trial should be measured"

# traces that are truncated, damaged or missing are reported, and the others evaluated, also where no digest tells
cp -r "$run" "$scratch/damaged"
cp "$(printf '%s/traces/trial_%06d.mcap' "$run" 3)" "$scratch/damaged/traces/trial_000001.mcap"
expect_status 1 "$host" evaluate "$scratch/damaged" --csv "$some"
expect_line '^trial 1: .*trial_000001.mcap was changed after the run'
cp "$run/traces/trial_000001.mcap" "$scratch/damaged/traces"
forge "$scratch/damaged" ""
trace() { printf '%s/damaged/traces/trial_%06d.mcap' "$scratch" "$1"; }
head -c 4000 "$(trace 1)" >"$scratch/short" && mv "$scratch/short" "$(trace 1)"
printf 'no trace' >"$(trace 2)"
rm "$(trace 4)"
printf 'XXXX' | dd of="$(trace 6)" bs=1 seek=3000 conv=notrunc status=none
expect_status 1 "$host" evaluate "$scratch/damaged" --csv "$some"
expect_line '^trial 1: .*trial_000001.mcap: ' 4
expect_line '^trial 2: .*trial_000002.mcap: .*not an MCAP file' 4
expect_line '^trial 4: .*trial_000004.mcap is missing' 4
expect_line '^trial 6: .*trial_000006.mcap: trace, byte ' 4
grep -Ev '^[1246],' "$all" | cmp -s - "$some" || fail "the other trials should be evaluated as before"

# a run that keeps traces of failed trials, or none
for kept in failed none; do
  sed "\$a [record]\ntraces = \"$kept\"" "$here/crossing.toml" >"$scratch/$kept.toml"
  expect_status 0 "$host" "$scratch/$kept.toml" --trials 1 --quiet --out "$scratch/$kept"
  status=0
  "$host" evaluate "$scratch/$kept" >"$scratch/stdout" 2>"$scratch/stderr" || status=$?
  grep -q "[0-9] trials\? without a trace: the run has \[record\] traces = \"$kept\"" "$scratch/stderr" ||
    fail "it should be said why there is no trace: $(cat "$scratch/stderr")"
  if ls "$scratch/$kept"/traces/*.mcap >/dev/null 2>&1; then expected=0; else expected=2; fi
  ((status == expected)) || fail "traces = $kept: status $status"
done

# a library that has changed since the run
cp "$faults" "$scratch/libmine.so"
sed 's|"libdmrp_metrics.so"|&, "./libmine.so"|; $a [[metric]]\nuse = "test.metric.none"' "$here/crossing.toml" \
  >"$scratch/mine.toml"
expect_status 0 "$host" "$scratch/mine.toml" --trials 1 --quiet --out "$scratch/mine"
printf 'x' >>"$scratch/libmine.so"  # not loaded: the same library
expect_status 0 "$host" evaluate "$scratch/mine" --csv "$some"
[[ ! -s $scratch/stderr ]] || fail "the library is the same: $(cat "$scratch/stderr")"
sed -i 's/number of samples/Number of samples/' "$scratch/libmine.so"
expect_status 0 "$host" evaluate "$scratch/mine" --csv "$some"
expect_line '^warning: .*/libmine.so has changed since the run: values may differ'
expect_same "$scratch/mine" "$some"
# a library that is gone, and one that replaces it
mv "$scratch/libmine.so" "$scratch/libyours.so"
expect_status 2 "$host" evaluate "$scratch/mine"
expect_line "the run's library .*/libmine.so is gone"
expect_status 0 "$host" evaluate "$scratch/mine" --metric test.metric.none --plugin "$scratch/libyours.so" --csv "$some"
expect_same "$scratch/mine" "$some"
