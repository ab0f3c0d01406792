#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The parameter sets upstream/ turn off every departure from the originals that is a switch, and nothing else; results
# under upstream and tuned do not share a label. Called as upstream_sets.sh DMRP_HOST SOURCE_DIR.
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
sets=$2/plugins/controllers/parameter_sets

# "CONTROLLER KEY" of each parameter whose description calls it a departure
"$host" plugins --json | awk -F'"' '
  $2 == "id" { id = $4; sub(/.*\./, "", id) }
  $2 == "key" { key = $4 }
  $2 == "doc" && $4 ~ /^departure: / { print id, key }' | sort >"$scratch/departures"
(($(wc -l <"$scratch/departures") >= 10)) || fail "departures: $(<"$scratch/departures")"
# more need a row of docs/measured/ablation.md as reason
patched=$(cut -d' ' -f1 "$scratch/departures" | uniq -c | awk '$1 > 6 { print $2 }')
[[ -z $patched ]] || fail "more than six departures: $patched"

for file in "$sets"/upstream/*.toml; do
  sed -n "s/^\([a-z_]*\) *= \(false\|0\.0\)$/$(basename "$file" .toml) \1/p" "$file"
done | sort >"$scratch/off"
diff "$scratch/departures" "$scratch/off" || fail "upstream/ and the departures differ"

{
  cat <<'TOML'
[experiment]
name = "sets"
plugins = ["libdmrp_planners.so", "libdmrp_controllers.so", "libdmrp_pedestrians.so", "libdmrp_metrics.so"]
[[scenario]]
use = "mall"
robots = 1
[[global_planner]]
use = "dmrp.planner.cbs"
[[pedestrian_model]]
use = "dmrp.pedestrian.social_force"
TOML
  for set in upstream tuned; do
    for controller in dwa teb mpc mppi e3mop; do
      printf '[[local_controller]]\nuse = "dmrp.controller.%s"\nparams_file = "controllers/%s/%s.toml"\n' \
        "$controller" "$set" "$controller"
    done
  done
} >"$scratch/sets.toml"
expect_status 0 "$host" validate "$scratch/sets.toml"  # which refuses equal labels
expect_status 0 "$host" "$scratch/sets.toml" --quiet --jobs 1 --trials 1 --out "$scratch/run"
[[ $(query "$scratch/run" "SELECT count(DISTINCT local_controller), sum(outcome = 'fault') FROM trial") == "10|0" ]] ||
  fail "ten controllers should have run"
[[ $(query "$scratch/run" "SELECT count(*) FROM trial WHERE local_controller IN ('DWA (upstream)', 'DWA (tuned)')") == 2 ]] ||
  fail "labels should name the set"
