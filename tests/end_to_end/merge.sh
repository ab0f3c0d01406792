#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Shards that are joined equal one run of all trials.
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
source_file=$here/crossing.toml

run() {
  expect_status 0 "$host" "$source_file" --trials 2 --quiet "$@"
}
# expect_refusal PATTERN ARGUMENT...: of merge, which then leaves nothing behind
expect_refusal() {
  expect_status 2 "$host" merge "${@:2}"
  [[ $(messages) == 1 ]] || fail "not one line but: $(cat "$scratch/stderr")"
  grep -Eq -- "$1" "$scratch/stderr" || fail "'$(cat "$scratch/stderr")' does not match '$1'"
  [[ ! -e $scratch/none ]] || fail "something was written"
}

run --out "$scratch/whole"
run --shard 0/3 --out "$scratch/a"
run --shard 1/3 --out "$scratch/b"
run --shard 2/3 --out "$scratch/c"
expect_status 0 "$host" merge "$scratch/joined" "$scratch/c" "$scratch/a" "$scratch/b"
grep -q "$scratch/joined" "$scratch/stdout" || fail "the run directory is not named"
[[ ! -s $scratch/stderr ]] || fail "nothing is missing: $(cat "$scratch/stderr")"
[[ $(values_of "$scratch/joined") == "$(values_of "$scratch/whole")" ]] || fail "the shards together differ from the whole"
for file in effective.toml experiment.toml; do
  cmp -s "$scratch/joined/$file" "$scratch/whole/$file" || fail "$file differs"
done
names() { (cd "$scratch/$1" && find . -type f -not -name 'results.sqlite-*' -not -name log.txt | sort); }
[[ $(names joined) == "$(names whole)" ]] || fail "other files than in the whole: $(diff <(names joined) <(names whole))"
expect_status 0 "$host" evaluate "$scratch/joined" --metric dmrp.metric.path_length
mv "$scratch/stdout" "$scratch/of_joined"
expect_status 0 "$host" evaluate "$scratch/whole" --metric dmrp.metric.path_length
cmp -s "$scratch/stdout" "$scratch/of_joined" || fail "the traces differ"

# shards with unfinished trials are joined; --resume runs what is missing
cp -r "$scratch/b" "$scratch/unfinished"
query "$scratch/unfinished" "PRAGMA foreign_keys = ON; DELETE FROM trial WHERE id = 4"
expect_status 0 "$host" merge "$scratch/a part" "$scratch/a" "$scratch/unfinished" "$scratch/c"
again=$(sed -n 's/^7 of 8 trials are finished: continue with dmrp-host //p' "$scratch/stderr")
[[ $again ]] || fail "$(cat "$scratch/stderr")"
eval "expect_status 0 \"$host\" $again --quiet" # as it is pasted
[[ $(values_of "$scratch/a part") == "$(values_of "$scratch/whole")" ]] || fail "--resume should complete a part"

cp -r "$scratch/a" "$scratch/relabelled"
forge "$scratch/relabelled" "UPDATE trial SET local_controller = 'better' WHERE id = 0"
expect_refusal "$scratch/b: trial 4 does not fit trial 0, one of them was changed after its run: its controller is" \
  "$scratch/none" "$scratch/relabelled" "$scratch/b" "$scratch/c"
forge "$scratch/relabelled" "UPDATE trial SET local_controller = (SELECT local_controller FROM trial WHERE id = 6), seed = 1
  WHERE id = 0"
expect_refusal "trial [0-9]+ does not fit trial" "$scratch/none" "$scratch/relabelled" "$scratch/b" "$scratch/c"
expect_refusal "trial 0 is in $scratch/a already" "$scratch/none" "$scratch/a" "$scratch/whole"
expect_refusal "$scratch/joined: exists already and is not empty" "$scratch/joined" "$scratch/a" "$scratch/b" "$scratch/c"
expect_refusal "a shard is missing: 2/3" "$scratch/none" "$scratch/a" "$scratch/b"
expect_refusal "shards are missing: 0/3, 2/3" "$scratch/none" "$scratch/b"
run --shard 0/2 --out "$scratch/half"
query "$scratch/b" "PRAGMA foreign_keys = ON; DELETE FROM trial WHERE id = 4"
expect_refusal "$scratch/b: is shard 1/3, but $scratch/half is shard 0/2" "$scratch/none" "$scratch/half" "$scratch/b"
mkdir "$scratch/empty"
expect_refusal "$scratch/empty: is no run directory" "$scratch/none" "$scratch/a" "$scratch/empty"
sed 's/^seed .*/seed = 8/' "$source_file" >"$scratch/other.toml"
expect_status 0 "$host" "$scratch/other.toml" --trials 2 --shard 1/3 --quiet --out "$scratch/other"
expect_refusal "$scratch/other: is a run of another experiment than $scratch/a: experiment.seed is 8, not 7$" "$scratch/none" "$scratch/a" "$scratch/other"
sed -i 's/"libc": "[^"]*"/"libc": "another 1.0"/' "$scratch/b/manifest.json"
expect_refusal "$scratch/b: cannot be joined with $scratch/a: libc: .*another 1.0" "$scratch/none" "$scratch/a" "$scratch/b"
