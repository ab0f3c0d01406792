#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The experiments of the paper and of dmrp1 are valid, and planners have the lengths and overlaps of Table II of the
# paper (Hu et al., ICRA 2026) in mall, office and library. Called as: paper.sh DMRP_HOST SOURCE_DIR
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
paper=$2/examples/paper

for file in "$paper"/*.toml; do expect_status 0 "$host" validate "$file"; done
# the reference results of dmrp1 have the protocols that its files have
for file in "$2"/examples/dmrp1/*.toml; do
  expect_status 0 "$host" validate "$file"
  protocol=$(sed -n 's/^Protocol \([0-9a-f]*\): .*/\1/p' "$scratch/stdout")
  name=$(basename "$file" .toml)
  grep -q "\"protocol\": \"$protocol" "$2/examples/dmrp1/reference/$name/manifest.json" ||
    fail "the reference results of $name.toml are of another protocol"
done

expect_status 0 "$host" "$paper/table2.toml" --quiet --trials 1 --out "$scratch/run"
# of_plan SCENARIO PLANNER METRIC
of_plan() {
  query "$scratch/run" "SELECT value FROM trial JOIN value ON trial_id = id
    WHERE scenario = '$1' AND global_planner = '$2' AND metric = '$3' AND subject_kind = 'system'"
}
# is_near VALUE EXPECTED DIFFERENCE
is_near() {
  awk -v a="$1" -v b="$2" -v most="$3" 'BEGIN { exit !(a - b <= most && b - a <= most) }'
}
# the paper's values; SIPP's lengths in the office differ: its paths there leave the grid
while read -r scenario planner length_m sto; do
  is_near "$(of_plan "$scenario" "$planner" planned_length)" "$length_m" "$(awk "BEGIN { print 0.03 * $length_m }")" ||
    fail "$planner plans $(of_plan "$scenario" "$planner" planned_length) m in $scenario, the paper's $length_m m"
  is_near "$(of_plan "$scenario" "$planner" sto)" "$sto" 0.02 ||
    fail "the STO of $planner in $scenario is $(of_plan "$scenario" "$planner" sto), the paper's $sto"
done <<'END'
mall ECBS-8 59.33 0.036
mall CBS 63.02 0
mall EECBS 63.02 0
office ECBS-8 32.95 0
office CBS 42.80 0
office EECBS 42.80 0
library ECBS-8 74.96 0
library CBS 79.72 0
library EECBS 79.72 0
END
[[ $(of_plan mall CBS sto_cell_size) == 0.05 ]] || fail "STO is not on cells of 0.05 m"
