#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The experiments of the paper and of dmrp1 are valid, and planners have the lengths and overlaps of Table II of the
# paper (Hu et al., ICRA 2026) in mall, office and library. Called as: paper.sh DMRP_HOST SOURCE_DIR
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
paper=$2/examples/paper

# protocol_of FILE: validates it, and does not wait for the time that its run would take
protocol_of() {
  local verdict protocol
  exec 3< <(TMPDIR=$scratch exec "$host" validate "$1" 2>"$scratch/stderr")
  read -r verdict <&3
  [[ $verdict == "$1: good."* ]] || fail "$1 is not valid: $(cat "$scratch/stderr")"
  read -r protocol <&3
  kill $! && wait $!
  protocol=${protocol#Protocol }
  echo "${protocol%%:*}"
}
# who interrupts the wait for that time gets none
exec 3< <(TMPDIR=$scratch exec "$host" validate "$paper/drawn.toml" 2>/dev/null)
read -r _ <&3 && read -r _ <&3 && sleep 1
status=0
kill $! && wait $! || status=$?
((status == 130)) || fail "exit status $status after SIGTERM, not 130"
[[ -z $(cat <&3) ]] || fail "a validation that was interrupted tells a time"

for file in "$paper"/*.toml; do protocol_of "$file" >/dev/null; done
# the reference results of dmrp1 have the protocols that its files have
for file in "$2"/examples/dmrp1/*.toml; do
  name=$(basename "$file" .toml)
  grep -q "\"protocol\": \"$(protocol_of "$file")" "$2/examples/dmrp1/reference/$name/manifest.json" ||
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
