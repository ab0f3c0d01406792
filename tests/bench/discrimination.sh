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
# the effect that must show between planners. Tasks are those of seed 20270, as drawn; none was left out.
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

declare -A robots=([mall]=16 [library]=16 [office]=16 [hospital]=16 [warehouse]=20)
declare -A declared=([mall]=success [library]=success [office]=success [hospital]=success [warehouse]=time)

# use KIND ID [LABEL]
use() {
  local family=${1#*_}
  [[ $1 != pedestrian_model ]] || family=pedestrian
  printf '[[%s]]\nuse = "dmrp.%s.%s"\n' "$1" "$family" "$2"
  [[ ! -e $(dirname "$host")/../share/dmrp/parameter_sets/controllers/tuned/$2.toml ]] ||
    printf 'params_file = "controllers/tuned/%s.toml"\n' "$2"
  [[ -z ${3:-} ]] || printf 'label = "%s"\n' "$3"
}

# experiment NAME WORLD PLANNER EXECUTION V_MAX: the controllers follow on standard input
experiment() {
  cat <<EOF
[experiment]
name = "$1"
seed = 20270
trials = $tasks
plugins = ["libdmrp_planners.so", "libdmrp_controllers.so", "libdmrp_pedestrians.so", "libdmrp_metrics.so"]
[[scenario]]
use = "$2"
robots = ${robots[$2]}
tasks = { drawn = $tasks, conflicts_min = 2 }
EOF
  use global_planner "$3"
  cat
  use pedestrian_model social_force
  printf '[[metric]]\nuse = "dmrp.metric.%s"\n' success completion_time spl
  printf '[simulation]\nexecution = "%s"\n[robot]\nv_max = %s\n[record]\ntraces = "none"\n' "$4" "$5"
}

experiments() {
  local dwa twin others
  dwa=$(use local_controller dwa)
  twin=$(use local_controller dwa "DWA again")
  others=$(for id in teb orca pure_pursuit stop_and_wait; do use local_controller $id; done)
  experiment base "$1" cbs free 0.8 <<<"$dwa" >"$out/$1.base.toml"
  experiment individual "$1" individual free 0.8 <<<"$dwa" >"$out/$1.individual.toml"
  experiment ordered "$1" cbs ordered 0.8 <<<"$dwa" >"$out/$1.ordered.toml"
  experiment controllers "$1" cbs free 0.8 <<<"$others" >"$out/$1.controllers.toml"
  experiment twin "$1" cbs free 0.8 <<<"$twin" >"$out/$1.twin.toml"
  experiment slow "$1" cbs free 0.72 <<<"$dwa" >"$out/$1.slow.toml"
}

run() {
  local resume=()
  [[ ! -e $out/$1/results.sqlite ]] || resume=(--resume)
  "$host" "$out/$1.toml" --out "$out/$1" --jobs "$jobs" --quiet "${resume[@]}" 2>"$out/$1.log" ||
    { (($? == 1)) && echo "$1: some trials ended in a fault"; } || { cat "$out/$1.log" && exit 2; }
}

# The runs of a row that exist; false if one is missing.
have() {
  local run
  for run in "$@"; do [[ -e $out/$run/results.sqlite ]] || return 1; done
}

row() { # FACTOR DECLARED RUN...
  local factor=$1 effect=$2
  shift 2
  have "$@" || return 0
  "$host" discriminate "${@/#/$out/}" --declared "$effect" --row "$factor"
}

# of a row: field 9 is D, field 11 partial eta squared of the time
field() { "$host" discriminate "${@:2}" --row x | awk -F' *[|] *' -v field="$1" '{ print $field }'; }

for world in "${worlds[@]}"; do experiments "$world"; done
if [[ -z ${NO_RUN:-} ]]; then
  for world in "${worlds[@]}"; do
    for name in base individual ordered controllers twin slow; do run "$world.$name"; done
  done
fi

# The page: its text is written by hand down to the mark.
{
  sed '/^<!-- tests\/bench\/discrimination.sh -->$/q' "$page"
  printf '\n%s tasks a world. Written by dmrp %s.\n\n' "$tasks" "$("$host" --version | awk 'NR == 1 { print $2 }')"
  echo '| world | robots | factor | declared | tasks | mean safe success | at ceiling | D | eta² of safe success | eta² of time | halves | tasks for 5 points | |'
  echo '| --- | ---: | --- | --- | ---: | ---: | ---: | ---: | --- | --- | ---: | ---: | --- |'
  for world in mall library office hospital warehouse; do
    row 'planner x execution' "${declared[$world]}" "$world".{base,individual,ordered}
    row controller success "$world".{base,controllers}
  done
  printf '\nControls: one controller under two labels, and with v_max 10 %% lower. The first must give D at most 0.05, the second must be found: an effect of the time above zero.\n\n'
  echo '| world | two labels: D | 10 % slower: D | 10 % slower: eta² of time |'
  echo '| --- | ---: | ---: | --- |'
  for world in mall library office hospital warehouse; do
    if have "$world".{base,twin,slow}; then
      base=$out/$world.base twin=$out/$world.twin slow=$out/$world.slow
      echo "| $world | $(field 9 "$base" "$twin") | $(field 9 "$base" "$slow") | $(field 11 "$base" "$slow") |"
    fi
  done
} >"$out/page.md"
cp "$out/page.md" "$page"
