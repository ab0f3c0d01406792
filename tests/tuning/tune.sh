#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Tunes one controller by a random search, with the same budget and training set as every other. Called as
#   tune.sh DMRP_HOST CONTROLLER OUT_DIR [CANDIDATES [TRIALS [SEED]]]
# Candidate 0 is the shipped set tuned/; the others replace the parameters named in spaces.txt: half of them by values
# drawn from the whole ranges, the rest by values near the best of the first half. All drive TRIALS tasks in each world;
# then candidate 0 and the four best drive four times as many others, and the best mean of these wins. OUT_DIR gets the
# trace of the search (search.csv), which continues where it was interrupted, and the best set (CONTROLLER.toml).
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
host=$1 controller=$2 out=$3 candidates=${4:-24} trials=${5:-5} seed=${6:-41}
finalists=4

# Tasks are drawn from the seed. Those of docs/measured/controllers.md are for judging.
held_out="160016 160711 160712 20261123 20261124 20261125"
training_scenarios="mall library"
training_robots=8

refuse() {
  echo "tune.sh: $1" >&2
  exit 2
}
for used in "$seed" $((seed + 1)); do
  [[ " $held_out " != *" $used "* ]] || refuse "seed $seed draws test tasks: $used is held out ($held_out)"
done
grep -q "^$controller " "$here/spaces.txt" || refuse "no parameters of '$controller' in spaces.txt"
[[ $candidates =~ ^[1-9][0-9]*$ && $trials =~ ^[1-9][0-9]*$ ]] || refuse "CANDIDATES and TRIALS are at least 1"
shipped=$(dirname "$host")/../share/dmrp/parameter_sets/controllers/tuned/$controller.toml
mkdir -p "$out"

# best SEED COUNT [LAST]: the candidates up to LAST with the highest scores on the tasks of SEED
best() {
  awk -F, -v seed="$1" -v last="${3:-$candidates}" '$3 == seed && $1 <= last' "$out/search.csv" |
    sort -t, -k2,2gr -k1,1n | head -n "$2" | cut -d, -f1
}

# shipped_value KEY of candidate 0: the shipped set's value, or the default
shipped_value() {
  local value
  value=$(sed -n "s/^$1 *= *\([^ #]*\).*/\1/p" "$shipped")
  [[ -n $value ]] || value=$("$host" plugins --json | awk -F'"' -v id="dmrp.controller.$controller" -v key="$1" '
    $2 == "id" { here = $4 == id }
    here && $2 == "key" { found = $4 == key }
    here && found && $2 == "default" { gsub(/[: ,]/, "", $3); print $3; exit }')
  echo "$value"
}

# drawn K: the parameters of spaces.txt as candidate K has them, key=value;key=value...
drawn() {
  local near=""
  if (($1 == 0)); then
    grep "^$controller " "$here/spaces.txt" | while read -r _ key _; do echo "$key=$(shipped_value "$key")"; done |
      paste -sd';'
    return
  fi
  (($1 <= candidates / 2)) || near=$(grep "^$(best "$seed" 1 $((candidates / 2))),[^,]*,$seed," "$out/search.csv")
  awk -v controller="$controller" -v k="$1" -v seed="$seed" -v near="${near##*,}" '
    function uniform() { state = (state * 16807) % 2147483647; return state / 2147483647 }
    BEGIN {
      state = seed * 1000 + k; for (i = 0; i < 20; i++) uniform()
      for (n = split(near, pairs, ";"); n > 0; n--) { split(pairs[n], pair, "="); middle[pair[1]] = pair[2] }
    }
    $1 == controller {
      value = $3 + ($4 - $3) * uniform()
      if ($2 in middle) value = middle[$2] + (value - ($3 + $4) / 2) / 4
      value = value < $3 ? $3 : value > $4 ? $4 : value
      printf "%s%s=%.4g", separator, $2, value
      separator = ";"
    }' "$here/spaces.txt"
}

# candidate K: its whole set, as lines of key = value
candidate() {
  drawn "$1" | tr ';' '\n' | sed 's/=/ = /' >"$out/drawn.txt"
  awk 'FNR == NR { replaced[$1]; next } /^[a-z]/ && !($1 in replaced) { sub(/ *#.*/, ""); print }' "$out/drawn.txt" \
    "$shipped"
  cat "$out/drawn.txt"
}

# experiment SEED TRIALS: on the training worlds
experiment() {
  printf '[experiment]\nname = "tuning"\nseed = %s\ntrials = %s\n' "$1" "$2"
  printf 'plugins = ["libdmrp_planners.so", "libdmrp_controllers.so", "libdmrp_pedestrians.so", "libdmrp_metrics.so"]\n'
  printf '[[scenario]]\nuse = "%s"\nrobots = '"$training_robots"'\ntasks = "drawn"\n' $training_scenarios
  printf '[[global_planner]]\nuse = "dmrp.planner.cbs"\n[[pedestrian_model]]\nuse = "dmrp.pedestrian.social_force"\n'
  printf '[[local_controller]]\nuse = "dmrp.controller.%s"\nlabel = "candidate"\n' "$controller"
  printf 'params_file = "./candidate.toml"\n[record]\ntraces = "none"\n'
}

# score RUN: safe_success, less a tenth of the seconds that robots take for a metre of their shortest way
score() {
  sqlite3 "$1/results.sqlite" "SELECT printf('%.6f', avg(safe) - 0.1 * avg(time / way)) FROM (SELECT
    max(CASE WHEN metric = 'safe_success' THEN value END) safe,
    max(CASE WHEN metric = 'completion_time' THEN value END) time,
    max(CASE WHEN metric = 'shortest_length' THEN value END) way
    FROM value WHERE subject_kind = 'robot' GROUP BY trial_id, subject)"
}

# drive K SEED TRIALS: appends candidate K's line to search.csv, if it is not there
drive() {
  ! grep -q "^$1,[^,]*,$2," "$out/search.csv" || return 0
  candidate "$1" >"$out/candidate.toml"
  experiment "$2" "$3" >"$out/experiment.toml"
  rm -rf "$out/run"
  "$host" "$out/experiment.toml" --quiet --jobs 1 --out "$out/run" >"$out/log.txt" || refuse "$(tail -3 "$out/log.txt")"
  echo "$1,$(score "$out/run"),$2,$3,$(drawn "$1")" >>"$out/search.csv"
}

[[ -f $out/search.csv ]] || echo "candidate,score,seed,trials,parameters" >"$out/search.csv"
for ((k = 0; k < candidates; ++k)); do drive "$k" "$seed" "$trials"; done
drive 0 $((seed + 1)) $((4 * trials))
for k in $(best "$seed" $finalists); do drive "$k" $((seed + 1)) $((4 * trials)); done

winner=$(best $((seed + 1)) 1)
line=$(grep "^$winner,[^,]*,$((seed + 1))," "$out/search.csv")
rm -f "$out/$controller.toml"
if ((winner == 0)); then
  echo "the shipped set is the best of $candidates: $line"
else
  {
    echo "# SPDX-License-Identifier: MIT"
    echo "# By tests/tuning/tune.sh: candidate $winner of $candidates, seed $seed, $trials tasks a world, then $((4 * trials))"
    candidate "$winner"
  } >"$out/$controller.toml"
  echo "better than the shipped set: $line"
fi
rm -rf "$out/run" "$out"/{candidate,experiment}.toml "$out"/{drawn,log}.txt
