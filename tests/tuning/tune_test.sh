#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The search refuses test seeds, drives what was drawn, and goes on where it was interrupted. Called as
# tune_test.sh DMRP_HOST. Skipped without pandas.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
host=$1
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
fail() { echo "FAILED: $1"; exit 1; }
export PYTHONPATH=$here/../../sdk/python
/usr/bin/python3 -c 'import pandas' 2>/dev/null || exit 77
tune() { /usr/bin/python3 "$here/tune.py" "$host" "$@" --controllers dwa --candidates 2 --halls 1 --tasks 1; }

for seed in 160014 160016 160711 20261123; do
  status=0
  tune "$scratch/refused" --seed "$seed" 2>"$scratch/said" || status=$?
  [[ $status == 2 ]] && grep -q "held out" "$scratch/said" || fail "seed $seed should be refused"
done

tune "$scratch/one" >"$scratch/said"
grep -qE '^\| dwa \| shipped \| [0-9.-]+ \|' "$scratch/said" || fail "no line of the shipped set: $(<"$scratch/said")"
[[ $(wc -l <"$scratch/one/dwa.csv") == 3 ]] || fail "not two candidates: $(<"$scratch/one/dwa.csv")"
grep -q 'params = { path_distance_bias = ' "$scratch/one/dwa_course_first_bare.toml" || fail "candidate 1 has no values"
cmp -s <(sed -n '/^\[navigation\]/,$p' "$scratch/one/dwa_test_routes.toml") \
  <(printf '[navigation]\nroute = "around"\nmonitor = true\n') || fail "the test lacks its routes"

rm -r "$scratch"/one/dwa_validation_routes "$scratch"/one/dwa.csv
tune "$scratch/one" >"$scratch/again"
cmp "$scratch/said" "$scratch/again" || fail "the result differs"
