#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Controllers of nav2 and of dmrp in pairs, on the same 40 drawn tasks: each controller of nav2_controllers.toml in a run
# of its own, all with the label "compared", so that `dmrp-host compare` matches their trials. Runs that are there are
# continued. Called as: pairs.sh DMRP_HOST [option of a run...]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
host=$1
shift

# run LABEL: runs/pairs/LABEL
run() {
  local file="pair_${1// /_}.toml" out="runs/pairs/${1// /_}" resume=()
  awk -v label="\"$1\"" 'BEGIN { RS = ""; ORS = "\n\n" }
    !/^\[\[local_controller\]\]/ || index($0, label) { sub(label, "\"compared\""); print }' nav2_controllers.toml >"$file"
  [[ ! -e $out ]] || resume=(--resume)
  "$host" "$file" --out "$out" "${resume[@]}" "${@:2}"
}

while IFS='|' read -r nav2 ours; do
  run "$nav2" --quiet "$@"
  run "$ours" --quiet "$@"
  echo "$nav2 - $ours"
  "$host" compare "runs/pairs/${ours// /_}" "runs/pairs/${nav2// /_}" \
    --metric success --metric safe_success --metric completion_time --metric collisions_at_fault
done <<'PAIRS'
nav2 RPP|pure pursuit
nav2 DWB|DWA
nav2 MPPI|MPPI
PAIRS
