#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# A run is known by what it means: it grows, and goes on and is joined in other folders and with another installation.
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
build_dir=$(dirname "$(dirname "$host")")

# another installation: its libraries are stripped, as those of packages
mkdir -p "$scratch/other/bin" "$scratch/other/lib/dmrp" "$scratch/other/share"
cp "$host" "$scratch/other/bin"
cp -r "$build_dir/lib/dmrp/plugins" "$scratch/other/lib/dmrp"
cp -r "$build_dir/share/dmrp" "$scratch/other/share"
strip --strip-unneeded "$scratch"/other/lib/dmrp/plugins/*.so
other_host=$scratch/other/bin/dmrp-host
# other folders, and another name
mkdir "$scratch/here" "$scratch/there"
for folder in here there; do cp -r "$here/worlds" "$scratch/$folder"; done
sed 's|^use = "crossing"$|use = "./worlds/crossing/scenario.toml"|' "$here/crossing.toml" >"$scratch/here/crossing.toml"
sed '/^name /d' "$scratch/here/crossing.toml" >"$scratch/there/passing.toml"
unset DMRP_SCENARIO_PATH

# expect_refusal PATTERN COMMAND...: one line, and status 2
expect_refusal() {
  expect_status 2 "${@:2}"
  [[ $(messages) == 1 ]] || fail "not one line but: $(cat "$scratch/stderr")"
  grep -Eq -- "$1" "$scratch/stderr" || fail "'$(cat "$scratch/stderr")' does not match '$1'"
}
run_here() { expect_status 0 "$host" "$scratch/here/crossing.toml" --quiet "$@"; }
run_there() { expect_status 0 "$other_host" "$scratch/there/passing.toml" --quiet "$@"; }

run_here --out "$scratch/whole"
expected=$(values_of "$scratch/whole")

# grows from 1 to 3 repetitions, and moves on the way
run_here --trials 1 --out "$scratch/grown"
[[ $(query "$scratch/grown" "SELECT count(*) FROM trial") == 4 ]] || fail "one repetition should have 4 trials"
started=$(grep started_at "$scratch/grown/manifest.json")
run_there --resume --trials 2 --out "$scratch/grown"
mv "$scratch/grown" "$scratch/moved"
run_here --resume --out "$scratch/moved"
[[ $(values_of "$scratch/moved") == "$expected" ]] || fail "a run that grew differs from one of that size"
cmp -s "$scratch/moved/effective.toml" "$scratch/whole/effective.toml" || fail "effective.toml is not that of the grown run"
grep -q '"trials_planned": 12' "$scratch/moved/manifest.json" || fail "the manifest should plan 12 trials"
[[ $(grep started_at "$scratch/moved/manifest.json") == "$started" ]] || fail "the run began when it began"
digest_of() { grep '^  "digest"' "$1/manifest.json"; }
[[ $(digest_of "$scratch/moved") == $(digest_of "$scratch/whole") ]] || fail "the digest should be the same"
expect_refusal "--out $scratch/moved: has 3 trials of each combination, not 2: a run can grow, not shrink" \
  "$host" "$scratch/here/crossing.toml" --quiet --resume --trials 2 --out "$scratch/moved"

# the default of traces changes at 100 trials, but not within a run
run_here --trials 25 --out "$scratch/long"
run_here --resume --trials 26 --out "$scratch/long"
run_here --resume --trials 26 --out "$scratch/long"
traces=$(find "$scratch/long/traces" -name '*.mcap' | wc -l)
[[ $traces == 104 ]] || fail "a run that kept every trace should go on so, but 104 trials have $traces"
expect_status 0 "$host" verify "$scratch/long"

# shards from both
run_here --shard 0/2 --out "$scratch/even"
run_there --shard 1/2 --trials 2 --out "$scratch/odd"
expect_refusal "odd: has 2 trials of each combination, but .*even has 3: .* --resume --trials 3" \
  "$host" merge "$scratch/none" "$scratch/even" "$scratch/odd"
run_there --shard 1/2 --resume --out "$scratch/odd"
expect_status 0 "$host" merge "$scratch/joined" "$scratch/even" "$scratch/odd"
[[ $(values_of "$scratch/joined") == "$expected" ]] || fail "shards from two installations differ from the whole"

# a refusal names the key and both values
refuse_changed() {  # PATTERN SED_COMMAND
  sed "$2" "$scratch/here/crossing.toml" >"$scratch/here/changed.toml"
  expect_refusal "--out $scratch/whole: was run with another experiment: $1" \
    "$host" "$scratch/here/changed.toml" --quiet --resume --out "$scratch/whole"
}
refuse_changed 'experiment.seed was 7, is 8 now$' 's/^seed .*/seed = 8/'
refuse_changed 'local_controller\[1\].params.lookahead_dist was 0.6, is 1.25 now$' \
  's/^use = "dmrp.controller.pure_pursuit"/&\nparams = { lookahead_dist = 1.25 }/'
refuse_changed 'local_controller\[1\].label was "[^"]+", is missing now \(and [0-9]+ more keys\)$' \
  '/^\[\[local_controller\]\]$/{N;/pure_pursuit/d}'
sed -i 's/^title .*/title = "another"/' "$scratch/there/worlds/crossing/scenario.toml"
expect_refusal 'scenario\[0\].use was "crossing [0-9a-f]{12}", is "crossing [0-9a-f]{12}" now$' \
  "$host" "$scratch/there/passing.toml" --quiet --resume --out "$scratch/whole"

# a library of the same version with other code
sed -i 's/slow down in curves/slow down in bends /' "$scratch/other/lib/dmrp/plugins/libdmrp_controllers.so"
expect_refusal "cannot be continued: plugin library libdmrp_controllers.so has changed$" \
  "$other_host" "$scratch/here/crossing.toml" --quiet --resume --out "$scratch/whole"
