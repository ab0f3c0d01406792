#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The search refuses test seeds, repeats itself, and goes on where it was interrupted. Called as tune_test.sh DMRP_HOST.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
host=$1
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
fail() { echo "FAILED: $1"; exit 1; }

for seed in 160015 160016 160711 160712 20261123; do
  status=0
  "$here/tune.sh" "$host" dwa "$scratch/refused" 1 1 "$seed" 2>"$scratch/said" || status=$?
  [[ $status == 2 ]] && grep -q "held out" "$scratch/said" || fail "seed $seed should be refused"
done

"$here/tune.sh" "$host" dwa "$scratch/one" 2 1 41 >"$scratch/said"
[[ $(wc -l <"$scratch/one/search.csv") == 5 ]] || fail "two candidates, twice: $(<"$scratch/one/search.csv")"
grep -qE '^0,[0-9.-]+,41,1,path_distance_bias=0.6;.*occdist_scale=0.001;' "$scratch/one/search.csv" ||
  fail "candidate 0 is the shipped set: $(<"$scratch/one/search.csv")"
grep -qE '^1,[0-9.-]+,42,4,path_distance_bias=' "$scratch/one/search.csv" || fail "candidate 1 drives other tasks, too"

mkdir "$scratch/two" && head -4 "$scratch/one/search.csv" >"$scratch/two/search.csv"
"$here/tune.sh" "$host" dwa "$scratch/two" 2 1 41 >"$scratch/again"
cmp "$scratch/one/search.csv" "$scratch/two/search.csv" || fail "the search differs"
cmp "$scratch/said" "$scratch/again" || fail "the result differs"
