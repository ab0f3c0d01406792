#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# What each departure of a controller from its original is worth: the set tuned/, the same without one departure, for
# each that it has, and upstream/, on drawn tasks. Called as ablation.sh DMRP_HOST CONTROLLER OUT_DIR [TASKS [SEED]].
# Prints a table in Markdown; OUT_DIR keeps the run.
set -euo pipefail
host=$1 controller=$2 out=$3 tasks=${4:-10} seed=${5:-160712}
sets=$(dirname "$host")/../share/dmrp/parameter_sets/controllers
mkdir -p "$out"

# "KEY OFF" of each departure that the tuned set has: on by default and not turned off, or turned on
departures() {
  local key default off
  "$host" plugins --json | awk -F'"' -v id="dmrp.controller.$controller" '
    $2 == "id" { here = $4 == id }
    here && $2 == "key" { key = $4 }
    here && $2 == "default" { value = $3; gsub(/[: ,]/, "", value) }
    here && $2 == "doc" && $4 ~ /^departure: / { print key, value }' |
    while read -r key default; do
      off=$(sed -n "s/^$key *= *\([a-z0-9.]*\).*/\1/p" "$sets/upstream/$controller.toml")
      value=$(sed -n "s/^$key *= *\([a-z0-9.]*\).*/\1/p" "$sets/tuned/$controller.toml")
      [[ ${value:-$default} == "$off" ]] || echo "$key $off"
    done
}

use() { # LABEL SET [PARAMETERS]
  printf '[[local_controller]]\nuse = "dmrp.controller.%s"\nlabel = "%s"\n' "$controller" "$1"
  printf 'params_file = "controllers/%s/%s.toml"\n' "$2" "$controller"
  [[ -z ${3:-} ]] || printf 'params = { %s }\n' "$3"
}

{
  printf '[experiment]\nname = "ablation"\nseed = %s\ntrials = %s\n' "$seed" "$tasks"
  printf 'plugins = ["libdmrp_planners.so", "libdmrp_controllers.so", "libdmrp_pedestrians.so", "libdmrp_metrics.so"]\n'
  printf '[[scenario]]\nuse = "%s"\nrobots = 8\ntasks = "drawn"\n' mall library
  printf '[[global_planner]]\nuse = "dmrp.planner.cbs"\n[[pedestrian_model]]\nuse = "dmrp.pedestrian.social_force"\n'
  use tuned tuned
  departures | while read -r key off; do use "without $key" tuned "$key = $off"; done
  use upstream upstream
  printf '[record]\ntraces = "none"\n'
} >"$out/ablation.toml"
"$host" "$out/ablation.toml" --quiet --out "$out/run" >"$out/log.txt" || { tail -3 "$out/log.txt" >&2; exit 2; }

echo "| $controller | safe_success | against tuned, 95 % | makespan s |"
echo "| --- | --- | --- | --- |"
sqlite3 -separator ' ' "$out/run/results.sqlite" "SELECT replace(t.local_controller, ' ', '_'), t.scenario,
  t.repetition, max(CASE WHEN metric = 'safe_success' THEN value END), max(CASE WHEN metric = 'makespan' THEN value END)
  FROM trial t JOIN value ON trial_id = t.id WHERE subject_kind = 'system' GROUP BY t.id ORDER BY t.id" |
  awk '
    $1 == "tuned" { of_tuned[$2, $3] = $4 }
    { if (!($1 in n)) order[++count] = $1
      task[$1, ++n[$1]] = $2 SUBSEP $3; safe[$1, n[$1]] = $4; sum[$1] += $4
      if ($5 != "") { time[$1] += $5; timed[$1]++ } }
    END {
      for (c = 1; c <= count; c++) {
        name = order[c]; mean = 0; squares = 0
        for (i = 1; i <= n[name]; i++) mean += (safe[name, i] - of_tuned[task[name, i]]) / n[name]
        for (i = 1; i <= n[name]; i++) squares += (safe[name, i] - of_tuned[task[name, i]] - mean) ^ 2
        half = n[name] > 1 ? 1.96 * sqrt(squares / (n[name] - 1) / n[name]) : 0
        shown = name; gsub(/_/, " ", shown); sub(/^without .*/, "without `" substr(name, 9) "`", shown)
        against = name == "tuned" ? "" : sprintf("%+.3f ± %.3f", mean, half)
        printf "| %s | %.3f | %s | %s |\n", shown, sum[name] / n[name], against, \
          timed[name] ? sprintf("%.1f", time[name] / timed[name]) : "-"
      }
    }'
