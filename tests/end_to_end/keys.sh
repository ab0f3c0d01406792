#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# `dmrp-host keys`: every key that the readers take, with the defaults that a run has and the ranges that are refused beyond. Called as: keys.sh DMRP_HOST
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
cd "$scratch" || exit 1

# normal FILE: "[table] key = value", a line each
normal() {
  awk '/^ *\[/ { table = $1; next } / = / { sub(/ +# .*/, ""); gsub(/ +/, " "); sub(/^ /, ""); print table, $0 }' "$1" | sort
}
expect_status 0 "$host" keys experiment
normal "$scratch/stdout" >listed
expect_status 0 "$host" "$here/crossing.toml" --quiet --trials 1 --out run
for table in simulation record limits robot; do
  comm -13 listed <(normal run/effective.toml | grep -F "[$table]") >missing
  [[ ! -s missing ]] || fail "keys experiment should have the defaults of a run: $(cat missing)"
  grep -qF "[$table]" listed || fail "keys experiment lacks [$table]"
done

expect_status 0 "$host" keys experiment
while IFS='|' read -r key range; do
  grep -qF "  $key  # $range" "$scratch/stdout" || fail "keys experiment should say of $key: $range"
done <<'RANGES'
step_s = 0.02|0.001 to 1000000
tracking = "visible"|"none", "visible", "all"
goal_tolerance_m = 0.2|above 0, to 10000
scans = false|true, false
memory_mb = 4096|0 to 1073741824
beams = 360|1 to 100000
RANGES

expect_status 0 "$host" keys scenario
for key in start via group_size vertices_m scen; do
  grep -qx "  $key" "$scratch/stdout" || fail "keys scenario lacks $key"
done
expect_status 2 "$host" keys experimant
