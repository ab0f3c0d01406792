#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# How well the controllers drive on tasks that nobody tuned for: the tables of docs/measured/controllers.md, in Markdown.
#
#     tests/bench/held_out.sh DMRP_HOST OUT
#
# Finished trials in OUT are kept: call it again to continue after an interruption. JOBS (2) and SEED (that of the page)
# are environment variables. tests/tuning/tune.py refuses the seed.
set -euo pipefail
host=$(realpath "$1")
out=$2
jobs=${JOBS:-2}
seed=${SEED:-20261124}
controllers="dwa teb mpc e3mop mppi orca stop_and_wait"
mkdir -p "$out"

# experiment TRACKING TASKS
experiment() {
  local world id
  cat <<TOML
[experiment]
name = "held out, tracking $1"
seed = $seed
trials = $2
plugins = ["libdmrp_planners.so", "libdmrp_controllers.so", "libdmrp_pedestrians.so", "libdmrp_metrics.so"]
[[global_planner]]
use = "dmrp.planner.cbs"
[[pedestrian_model]]
use = "dmrp.pedestrian.social_force"
[simulation]
tracking = "$1"
[record]
traces = "failed"
TOML
  for world in mall library office; do
    printf '[[scenario]]\nuse = "%s"\nrobots = [4, 8, 16]\ntasks = "drawn"\n' "$world"
  done
  for id in $controllers; do
    printf '[[local_controller]]\nuse = "dmrp.controller.%s"\n' "$id"
    [[ ! -e $(dirname "$host")/../share/dmrp/parameter_sets/controllers/tuned/$id.toml ]] ||
      printf 'params_file = "controllers/tuned/%s.toml"\n' "$id"
  done
}

run() { # TRACKING TASKS
  local resume=()
  [[ ! -e $out/$1/results.sqlite ]] || resume=(--resume)
  experiment "$@" >"$out/$1.toml"
  "$host" "$out/$1.toml" --out "$out/$1" --jobs "$jobs" --quiet "${resume[@]}" ||
    (($? == 1)) # a fault is a result
}

# A cell: robots home of all, safe_success, contact_free_success. Below, the sums of all cells.
tables() { # TRACKING
  awk -F, '
    function share(sum, robots, text) {
      text = sprintf("%.2f", sum / robots)
      sub(/^0/, "", text)
      sub(/\.00$/, "", text)
      return text
    }
    function head(line, c, rule) {
      rule = "| ---"
      for (c = 1; c <= n; ++c) line = line " | " controllers[c]
      for (c = split(line, columns, "|"); c > 2; --c) rule = rule " | ---"
      print line " |\n" rule " |"
    }
    function add(key, i) {
      of[key] += $col["robots"]
      for (i = 1; i <= shares; ++i) sums[key, i] += $col[name[i]] * $col["robots"]
    }
    BEGIN {
      shares = split("success safe_success contact_free_success", name, " ")
      counts = split("collisions_at_fault collisions_static open_standstills", count, " ")
    }
    NR == 1 { for (i = 1; i <= NF; ++i) col[$i] = i; next }
    {
      controller = $col["local_controller"]; place = $col["scenario"] " | " $col["robots"]
      if (!(controller in seen)) { seen[controller]; controllers[++n] = controller }
      if (!(place in seen)) { seen[place]; places[++rows] = place }
      add(controller SUBSEP place); add(controller)
      for (i = 1; i <= counts; ++i) counted[controller, i] += $col[count[i]]
    }
    END {
      head("| | robots")
      for (r = 1; r <= rows; ++r) {
        line = "| " places[r]
        for (c = 1; c <= n; ++c) {
          key = controllers[c] SUBSEP places[r]
          line = line sprintf(" | %.0f/%d, ", sums[key, 1], of[key])
          line = line share(sums[key, 2], of[key]) ", " share(sums[key, 3], of[key])
        }
        print line " |"
      }
      print ""
      head("| of " of[controllers[1]] " robots")
      line = "| home"
      for (c = 1; c <= n; ++c) line = line sprintf(" | %.0f", sums[controllers[c], 1])
      print line " |"
      for (i = 2; i <= shares; ++i) {
        line = "| `" name[i] "`"
        for (c = 1; c <= n; ++c) line = line " | " share(sums[controllers[c], i], of[controllers[c]])
        print line " |"
      }
      for (i = 1; i <= counts; ++i) {
        line = "| `" count[i] "`"
        for (c = 1; c <= n; ++c) line = line " | " counted[controllers[c], i] + 0
        print line " |"
      }
    }' "$out/$1/trials.csv"
}

run visible 3
run none 2
for tracking in visible none; do
  printf '\ntracking = "%s"\n\n' "$tracking"
  tables "$tracking"
done
