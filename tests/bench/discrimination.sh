#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Do the shipped worlds tell entries apart? Runs the experiments of docs/discrimination.md and writes that page:
#
#     tests/bench/discrimination.sh DMRP_HOST OUT [WORLD...]
#
# Finished trials in OUT are kept: call it again to continue after an interruption, or to add worlds. JOBS (2) and TASKS
# (40) are environment variables; a page of fewer tasks says so. With NO_RUN=1 it only writes the page again.
#
# Everything below was declared before any of these trials was run: tasks, numbers of robots, entries, and for each world
# the effect that must show between planners. Tasks are those of the seed, as drawn; none was left out.
set -euo pipefail
host=$(realpath "$1")
out=$2
shift 2
jobs=${JOBS:-2}
tasks=${TASKS:-40}
page=$(dirname "${BASH_SOURCE[0]}")/../../docs/discrimination.md
worlds=("$@")
((${#worlds[@]} > 0)) || worlds=(mall library office hospital warehouse)
mkdir -p "$out"

seed=20271
declare -A robots=([mall]=16 [library]=16 [office]=16 [hospital]=12 [warehouse]=20)

# use KIND ID [LABEL]
use() {
  local family=${1#*_}
  [[ $1 != pedestrian_model ]] || family=pedestrian
  printf '[[%s]]\nuse = "dmrp.%s.%s"\n' "$1" "$family" "$2"
  [[ ! -e $(dirname "$host")/../share/dmrp/parameter_sets/controllers/tuned/$2.toml ]] ||
    printf 'params_file = "controllers/tuned/%s.toml"\n' "$2"
  [[ -z ${3:-} ]] || printf 'label = "%s"\n' "$3"
}

# experiment NAME WORLD ROBOTS EXECUTION V_MAX: planners and controllers follow on standard input
experiment() {
  cat <<TOML
[experiment]
name = "$1"
seed = $seed
trials = $tasks
plugins = ["libdmrp_planners.so", "libdmrp_controllers.so", "libdmrp_pedestrians.so", "libdmrp_metrics.so"]
[[scenario]]
use = "$2"
robots = $3
tasks = { drawn = $tasks, conflicts_min = 2 }
TOML
  cat
  use pedestrian_model social_force
  printf '[[metric]]\nuse = "dmrp.metric.%s"\n' success completion_time spl
  printf '[simulation]\nexecution = "%s"\n[robot]\nv_max = %s\n[record]\ntraces = "none"\n' "$4" "$5"
}

experiments() {
  local world=$1
  { for id in individual cbs pibt; do use global_planner $id; done && use local_controller stop_and_wait; } |
    experiment free "$world" "${robots[$world]}" free 0.8 >"$out/$world.free.toml"
  { for id in cbs pibt; do use global_planner $id; done && use local_controller stop_and_wait; } |
    experiment ordered "$world" "${robots[$world]}" ordered 0.8 >"$out/$world.ordered.toml"
}

run() {
  local resume=()
  [[ ! -e $out/$1/results.sqlite ]] || resume=(--resume)
  "$host" "$out/$1.toml" --out "$out/$1" --jobs "$jobs" --quiet "${resume[@]}" 2>"$out/$1.log" ||
    { (($? == 1)) && echo "$1: some trials ended in a fault"; } || { cat "$out/$1.log" && exit 2; }
}

for world in "${worlds[@]}"; do experiments "$world"; done
if [[ -z ${NO_RUN:-} ]]; then
  for world in "${worlds[@]}"; do
    for name in free ordered; do run "$world.$name"; done
  done
fi
