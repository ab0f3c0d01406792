#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Do the shipped worlds tell entries apart? Runs the experiments of docs/measured/discrimination.md and writes that page:
#
#     tests/bench/discrimination.sh DMRP_HOST OUT [WORLD...]
#
# Finished trials in OUT are kept: call it again to continue after an interruption, or to add worlds. JOBS (2) and TASKS
# (40) are environment variables; a page of fewer tasks says so. With NO_RUN=1 it only writes the page again.
#
# Everything below was declared before any of these trials was run: tasks, numbers of robots and people, entries. Numbers
# were chosen on one to three tasks a world of another seed. Tasks are those of the seed, as drawn; none was left out.
# The whole must take under 30 minutes on two cores: entries are left out for their computing time only.
set -euo pipefail
host=$(realpath "$1")
judge=$(dirname "$host")/bench_discrimination
out=$2
shift 2
jobs=${JOBS:-2}
tasks=${TASKS:-40}
page=$(dirname "${BASH_SOURCE[0]}")/../../docs/measured/discrimination.md
worlds=("$@")
((${#worlds[@]} > 0)) || worlds=(mall library office hospital warehouse)
mkdir -p "$out"

declare -A robots=([mall]=16 [library]=16 [office]=16 [hospital]=12 [warehouse]=20)
planner_seed=20271
controller_seed=20272  # tasks of their own: the first declaration (CBS, 8 robots among more people, 20271) missed in the office
density_seed=20271
density_robots=8
declare -A people_times=([mall]=5 [library]=5 [office]=5 [hospital]=2 [warehouse]=10)

# use KIND ID [LABEL]
use() {
  local family=${1#*_}
  [[ $1 != pedestrian_model ]] || family=pedestrian
  printf '[[%s]]\nuse = "dmrp.%s.%s"\n' "$1" "$family" "$2"
  [[ ! -e $(dirname "$host")/../share/dmrp/parameter_sets/controllers/tuned/$2.toml ]] ||
    printf 'params_file = "controllers/tuned/%s.toml"\n' "$2"
  [[ -z ${3:-} ]] || printf 'label = "%s"\n' "$3"
}

uses() { # KIND ID...
  local kind=$1 id
  shift
  for id in "$@"; do use "$kind" "$id"; done
}

# experiment NAME WORLD SEED ROBOTS PEOPLE_TIMES EXECUTION V_MAX: planners and controllers follow on standard input
experiment() {
  cat <<TOML
[experiment]
name = "$1"
seed = $3
trials = $tasks
plugins = ["libdmrp_planners.so", "libdmrp_controllers.so", "libdmrp_pedestrians.so", "libdmrp_metrics.so"]
[[scenario]]
use = "$2"
robots = $4
tasks = { drawn = $tasks, conflicts_min = 2 }
people_times = $5
TOML
  cat
  use pedestrian_model social_force
  printf '[[metric]]\nuse = "dmrp.metric.%s"\n' success completion_time spl root_conflicts
  printf '[simulation]\nexecution = "%s"\n[robot]\nv_max = %s\n[record]\ntraces = "none"\n' "$6" "$7"
}

experiments() {
  local world=$1
  local count=${robots[$world]}
  planners() { uses global_planner "$@" && use local_controller stop_and_wait; }
  controllers() { use global_planner individual && uses local_controller "$@"; }
  twin() { use global_planner individual && use local_controller dwa 'DWA again'; }
  cbs_and_dwa() { use global_planner cbs && use local_controller dwa; }
  planned() { experiment "$1" "$world" $planner_seed "$count" 1 "$1" 0.8 >"$out/$world.$1.toml"; }
  driven() { experiment "$1" "$world" $controller_seed "$count" 1 free "$2" >"$out/$world.$1.toml"; }
  among() { experiment "$1" "$world" $density_seed "$density_robots" "$2" free 0.8 >"$out/$world.$1.toml"; }
  planners individual cbs pibt | planned free
  planners cbs pibt | planned ordered
  planners individual cbs pibt | experiment plans "$world" $planner_seed "$count" 1 free 0.8 |
    sed 's/^\[simulation\]$/&\ntime_limit_s = 1.0/' >"$out/$world.plans.toml"
  controllers dwa | driven base 0.8
  controllers orca pure_pursuit stop_and_wait teb | driven controllers 0.8
  twin | driven twin 0.8
  controllers dwa | driven slow 0.72
  cbs_and_dwa | among sparse 1
  cbs_and_dwa | among dense "${people_times[$world]}"
}

# Also appends the processor time of the run, in s, to OUT/processor_seconds.
run() {
  local resume=() TIMEFORMAT='%U %S'
  [[ ! -e $out/$1/results.sqlite ]] || resume=(--resume)
  { time "$host" "$out/$1.toml" --out "$out/$1" --jobs "$jobs" --quiet "${resume[@]}" 2>"$out/$1.log"; } \
    2>>"$out/processor_seconds" ||
    { (($? == 1)) && echo "$1: some trials ended in a fault"; } || { cat "$out/$1.log" && exit 2; }
}

# The first of these runs, and the others that exist; false if the first is missing.
found() {
  local run
  [[ -e $out/$1/results.sqlite ]] || return 1
  for run in "$@"; do [[ ! -e $out/$run/results.sqlite ]] || echo "$out/$run"; done
}

row() { # FACTOR RUN...
  local factor=$1 runs
  shift
  runs=$(found "$@") || return 0
  # shellcheck disable=SC2086
  "$judge" $runs --row "$factor"
}

# field N RUN...: of a row
field() { "$judge" "${@:2}" --row x | awk -F' *[|] *' -v field="$1" '{ print $field }'; }
for world in "${worlds[@]}"; do experiments "$world"; done
if [[ -z ${NO_RUN:-} ]]; then
  for world in "${worlds[@]}"; do
    for name in ${RUNS:-free ordered plans base controllers twin slow sparse dense}; do run "$world.$name"; done
  done
fi

rows() {
  local world
  for world in mall library office hospital warehouse; do
    row 'planner x execution' "$world".{free,ordered}
    row controller "$world".{controllers,base}
    row 'crowd density' "$world".{sparse,dense}
  done
}

controls() {
  local world
  for world in mall library office hospital warehouse; do
    [[ -e $out/$world.twin/results.sqlite && -e $out/$world.slow/results.sqlite ]] || continue
    base=$out/$world.base twin=$out/$world.twin slow=$out/$world.slow
    echo "| $world | $(field 10 "$base" "$twin") | $(field 10 "$base" "$slow") | $(field 12 "$base" "$slow") |"
  done
}

# What a plan is worth: CBS whose order is kept against individual paths, in points of safe_sct, as declared for all
# worlds; p by Holm over the worlds.
contrasts() {
  local world runs
  for world in mall library office hospital warehouse; do
    runs=$(found "$world".{free,ordered}) || continue
    # shellcheck disable=SC2086
    "$judge" $runs --contrast 'Individual paths (free) + Stop and wait' 'CBS (ordered) + Stop and wait'
  done | sort -g -k 6 | awk '
    { rank[++n] = $0 }
    END {
      for (i = 1; i <= n; ++i) {
        split(rank[i], of, " ")
        least = of[6] * (n - i + 1)
        if (least > 1) least = 1
        if (least < before) least = before
        before = least
        verdict = least < 0.05 && of[3] > 5 ? "discriminates planners" : "does not discriminate planners"
        printf "| %s | %s | %s %s %s | %.2g | %s |\n", of[1], of[2], of[3], of[4], of[5], least, verdict
      }
    }'
}

# How plans resolve the conflicts of the robots' own shortest paths: means over the tasks.
resolutions() {
  local world
  for world in mall library office hospital warehouse; do
    [[ -e $out/$world.plans/summary.csv ]] || continue
    awk -F, -v world="$world" '
      $6 ~ /^root_conflicts/ { mean[$3, $6] = $12; if (!($3 in seen)) { seen[$3] = 1; order[++n] = $3 } }
      END {
        for (i = 1; i <= n; ++i)
          printf "| %s | %s | %.1f | %.1f | %.1f | %.1f |\n", world, order[i], mean[order[i], "root_conflicts"],
            mean[order[i], "root_conflicts_waited"], mean[order[i], "root_conflicts_detoured"],
            mean[order[i], "root_conflicts_left"]
      }' "$out/$world.plans/summary.csv"
  done
}

# The page: its text is written by hand down to the mark.
rows >"$out/rows.md"
{
  sed '/^<!-- tests\/bench\/discrimination.sh -->$/q' "$page"
  printf '\n%s tasks a world, %s trials, %s minutes of processor time. Run by commit %s.\n\n' "$tasks" \
    "$(tail -qn +2 "$out"/*.*/trials.csv | wc -l)" \
    "$(awk '{ seconds += $1 + $2 } END { printf "%.0f", seconds / 60 }' "$out/processor_seconds")" \
    "$(sed -n 's/^ *"commit": *"\([0-9a-f]*\)".*/\1/p' "$out"/*.*/manifest.json | sort -u | paste -s -d ' ')"
  echo '| world | robots | people | factor | declared | tasks | mean safe_sct | at ceiling | D | eta² of safe_sct | eta² of time | halves | tasks for 5 points | interaction | |'
  echo '| --- | ---: | ---: | --- | --- | ---: | ---: | ---: | ---: | --- | --- | ---: | ---: | --- | --- |'
  cat "$out/rows.md"
  printf '\nControls: one controller under two labels, and with v_max 10 %% lower. The first must give D at most 0.05, the second must be found: an effect of the time above zero.\n\n'
  echo '| world | two labels: D | 10 % slower: D | 10 % slower: eta² of time |'
  echo '| --- | ---: | ---: | --- |'
  controls
  printf '\nWhat a plan is worth: CBS with `ordered` against individual paths with `free`, both driven by stop and wait. It must be 5 points of `safe_sct`, declared for all worlds, and p (Holm over the worlds) below 0.05.\n\n'
  echo '| world | tasks | points of safe_sct | p (Holm) | |'
  echo '| --- | ---: | --- | --- | --- |'
  contrasts
  printf '\nPairs of robots whose own shortest paths conflict, and what the plan does about it: mean over the tasks.\n\n'
  echo '| world | planner | pairs | resolved by waiting | by another way | left |'
  echo '| --- | --- | ---: | ---: | ---: | ---: |'
  resolutions
} >"$out/page.md"
cp "$out/page.md" "$page"
