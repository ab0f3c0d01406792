#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The quickstart succeeds, and the README shows what it prints: called as quickstart.sh DMRP_HOST SOURCE_DIR SANITIZERS.
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
source_dir=$2 sanitizers=${3:-}

expect_status 0 "$host" "$source_dir/examples/quickstart.toml" --out "$scratch/run"
grep -q "CBS + DWA" "$scratch/stdout" || fail "the table has no row for CBS + DWA"
grep -q "$scratch/run" "$scratch/stdout" || fail "the run directory is not named"

# But for measured times, the progress, which is a bar on a terminal, and the name of the run directory.
lasting() {
  sed -E '1s/ trials .*/ trials/; /^  [0-9]+\/[0-9]+  /d; s/^(  CBS \+ DWA +[0-9.]+ \[[^]]*\]( +[0-9.]+){2} +)[0-9.]+/\1-/
    s/^  [^ ]+( +report.html)/  -\1/'
}
shown=$(sed -n '/^quickstart · /,/^```/p' "$source_dir/README.md" | grep -v '^```')
[[ -n $sanitizers || $(lasting <<<"$shown") == "$(lasting <"$scratch/stdout")" ]] ||
  fail "the README shows something else: $(diff <(lasting <<<"$shown") <(lasting <"$scratch/stdout"))"

for file in experiment.toml effective.toml manifest.json trials.csv summary.csv report.html traces/trial_000002.mcap; do
  [[ -s $scratch/run/$file ]] || fail "$file is missing or empty"
done
[[ $(query "$scratch/run" "SELECT count(*) FROM trial WHERE outcome IN ('succeeded', 'failed') AND repeatable") == 3 ]] ||
  fail "three repeatable trials should be there"
arrived=$(query "$scratch/run" "SELECT sum(value) FROM value WHERE metric = 'success' AND subject_kind = 'robot'")
(($(printf '%.0f' "$arrived") >= 10)) || fail "$arrived of 12 robots arrived, at least 10 should"
[[ $(query "$scratch/run" "SELECT sum(value) FROM value WHERE metric = 'collisions_static' AND subject_kind = 'system'") == 0.0 ]] ||
  fail "a robot touched something static"
[[ $(query "$scratch/run" "SELECT sum(value) FROM value WHERE metric = 'open_standstills' AND subject_kind = 'system'") == 0.0 ]] ||
  fail "a robot stood for 15 s with nobody in its way"

# every metric has a system value for every trial; only values of robots that did not arrive, of those that failed, of
# contacts, of standstills, and of groups of people, which the mall has not, may be undefined
[[ -z $(query "$scratch/run" "SELECT t.id, m.name FROM trial t, metric m WHERE NOT EXISTS (SELECT 1 FROM value v
   WHERE v.trial_id = t.id AND v.metric = m.name AND v.subject_kind = 'system')") ]] || fail "a metric has no value"
[[ -z $(query "$scratch/run" "SELECT metric FROM value WHERE value IS NULL AND metric NOT IN ('completion_time', 'person_standoff',
   'first_cause', 'culprit', 'held_behind', 'after_standstill', 'impact_speed')
   AND metric NOT LIKE 'group_%'") ]] ||
  fail "a value is undefined that should not be"

# planning takes fractions of a millisecond: no clock of the box that moves in ticks measures it
[[ $(query "$scratch/run" "SELECT count(*) FROM value WHERE metric = 'planning_time' AND value > 0.02 AND value < 100") == 3 ]] ||
  fail "a planning time is not that of planning"
