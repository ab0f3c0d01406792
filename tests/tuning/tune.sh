#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Tunes one controller by a random search, with the same budget and training set as every other. Called as
#   tune.sh DMRP_HOST CONTROLLER OUT_DIR [CANDIDATES [TRIALS [SEED]]]
# Candidate 0 is the shipped set tuned/; the others are drawn from spaces.txt. OUT_DIR gets the trace of the search
# (search.csv), which continues where it was interrupted, and the best set (CONTROLLER.toml).
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
host=$1 controller=$2 out=$3 candidates=${4:-24} trials=${5:-5} seed=${6:-41}

# Tasks are drawn from the seed. Those of docs/controllers.md, of the controllers' README and of ablation.sh are for judging.
held_out="160016 160711 160712 20261123"
training_scenarios="mall library"
training_robots=8

refuse() {
  echo "tune.sh: $1" >&2
  exit 2
}
[[ " $held_out " != *" $seed "* ]] || refuse "seed $seed draws test tasks: it is held out ($held_out)"
grep -q "^$controller " "$here/spaces.txt" || refuse "no parameters of '$controller' in spaces.txt"
[[ $candidates =~ ^[1-9][0-9]*$ && $trials =~ ^[1-9][0-9]*$ ]] || refuse "CANDIDATES and TRIALS are at least 1"
mkdir -p "$out"

# candidate K: its set, as lines of key = value; candidate 0 is empty
candidate() {
  (($1 > 0)) || return 0
  awk -v controller="$controller" -v k="$1" -v seed="$seed" '
    function uniform() { state = (state * 16807) % 2147483647; return state / 2147483647 }
    BEGIN { state = seed * 1000 + k; for (i = 0; i < 20; i++) uniform() }
    $1 != controller { next }
    $3 == "switch" { print $2 " = " (uniform() < 0.5 ? "true" : "false"); next }
    { printf "%s = %.4g\n", $2, $3 + ($4 - $3) * uniform() }' "$here/spaces.txt"
}

# experiment PARAMETER_FILE: on the training set
experiment() {
  printf '[experiment]\nname = "tuning"\nseed = %s\ntrials = %s\n' "$seed" "$trials"
  printf 'plugins = ["libdmrp_planners.so", "libdmrp_controllers.so", "libdmrp_pedestrians.so", "libdmrp_metrics.so"]\n'
  printf '[[scenario]]\nuse = "%s"\nrobots = '"$training_robots"'\ntasks = "drawn"\n' $training_scenarios
  printf '[[global_planner]]\nuse = "dmrp.planner.cbs"\n[[pedestrian_model]]\nuse = "dmrp.pedestrian.social_force"\n'
  printf '[[local_controller]]\nuse = "dmrp.controller.%s"\nlabel = "tuned"\n' "$controller"
  printf 'params_file = "%s"\n' "$1"
  printf '[record]\ntraces = "none"\n'
}

# score RUN: safe_success, less a hundredth for each second that a robot takes for a metre of its shortest way
score() {
  sqlite3 "$1/results.sqlite" "SELECT printf('%.6f', avg(safe) - 0.01 * avg(time / way)) FROM (SELECT
    max(CASE WHEN metric = 'safe_success' THEN value END) safe,
    coalesce(max(CASE WHEN metric = 'makespan' THEN value END), 180) time,
    max(CASE WHEN metric = 'shortest_length' THEN value END) way
    FROM value WHERE subject_kind = 'system' GROUP BY trial_id)"
}

[[ -f $out/search.csv ]] || echo "candidate,score,seed,trials,parameters" >"$out/search.csv"
shipped=controllers/tuned/$controller.toml
for ((k = 0; k < candidates; ++k)); do
  ! grep -q "^$k," "$out/search.csv" || continue
  candidate "$k" >"$out/candidate.toml"
  if ((k == 0)); then experiment "$shipped"; else experiment "./candidate.toml"; fi >"$out/experiment.toml"
  rm -rf "$out/run"
  "$host" "$out/experiment.toml" --quiet --jobs 1 --out "$out/run" >"$out/log.txt" || refuse "$(tail -3 "$out/log.txt")"
  echo "$k,$(score "$out/run"),$seed,$trials,$(paste -sd';' "$out/candidate.toml" | tr -d ' ')" >>"$out/search.csv"
done
rm -rf "$out/run" "$out"/{candidate,experiment}.toml "$out/log.txt"

best=$(tail -n +2 "$out/search.csv" | sort -t, -k2,2gr -k1,1n | head -1)
if [[ ${best%%,*} == 0 ]]; then
  echo "the shipped set is the best of $candidates: $best"
  rm -f "$out/$controller.toml"
else
  {
    echo "# SPDX-License-Identifier: MIT"
    echo "# $controller by tests/tuning/tune.sh: candidate ${best%%,*} of $candidates, seed $seed, $trials trials a world"
    candidate "${best%%,*}"
  } >"$out/$controller.toml"
  echo "better than the shipped set: $best"
fi
