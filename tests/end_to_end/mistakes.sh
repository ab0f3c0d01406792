#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# A mistake in the input gives one line with its place, below it the line of the file and a caret, exit status 2, and no
# file.
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"

work=$scratch/work
plugins=$(dirname "$host")/../lib/dmrp/plugins
mkdir -p "$work/worlds"
cd "$work" || exit 1
cp -r "$here/worlds/crossing" worlds/
export DMRP_SCENARIO_PATH=$work/worlds
echo "no library" >libtext.so
head -c 20000 "$plugins/libdmrp_planners.so" >libtruncated.so
contents() { find "$work" -type f -not -name experiment.toml -exec sha256sum {} + | sort; }

# expect_mistake NAME SED_ON_EXPERIMENT SED_ON_SCENARIO PATTERN: of the answers of `calls` to the crossing, changed by sed
calls=("experiment.toml --out out" "validate experiment.toml" "experiment.toml")
expect_mistake() {
  local name=$1 pattern=$4
  sed "$2" "$here/crossing.toml" >experiment.toml
  sed "$3" "$here/worlds/crossing/scenario.toml" >worlds/crossing/scenario.toml
  [[ $pattern == "" || -n $2$3 ]] || fail "$name: nothing was changed"
  local before call
  before=$(contents)
  for call in "${calls[@]}"; do
    # shellcheck disable=SC2086
    expect_status 2 "$host" $call
    [[ $(messages) == 1 ]] || fail "$name: not one line but: $(cat "$scratch/stderr")"
    [[ ! -s $scratch/stdout ]] || fail "$name: wrote to standard output: $(cat "$scratch/stdout")"
    grep -Eq "$pattern" "$scratch/stderr" || fail "$name: '$(cat "$scratch/stderr")' does not match '$pattern'"
    [[ $(contents) == "$before" && ! -e out && ! -e runs ]] || fail "$name: something was written"
  done
  echo "$name: $(cat "$scratch/stderr")"
}

sed -n p "$here/crossing.toml" >experiment.toml
expect_status 0 "$host" validate experiment.toml

line='^experiment\.toml:[0-9]+:[0-9]+: '
robot='scenario\.toml:[0-9]+:[0-9]+: robot 0 '
expect_mistake "misspelt parameter" '/controller.dwa/aparams = { sim_tme = 1.0 }' '' "$line.*'sim_tme'.*dmrp.controller.dwa.*did you mean"
expect_mistake "goal that cannot be reached" '' 's/^center_m.*/center_m = [5.0, 3.0]/;s/^size_m = \[0.6, 0.6\]/size_m = [0.4, 6.0]/' "$robot.*cannot reach its goal"

# all commands read by one reader: the rest is asked of one
calls=("experiment.toml --out out")
expect_mistake "no TOML" 's/^trials .*/trials = = 3/' '' "$line"
expect_mistake "unknown plugin" 's/planner.cbs/planner.csb/' '' "$line.*'dmrp.planner.csb'.*did you mean 'dmrp.planner.cbs'"
expect_mistake "missing library" 's/libdmrp_planners/libdmrp_planers/' '' "$line.*libdmrp_planers.so.*did you mean 'libdmrp_planners.so'"
expect_mistake "text as library" 's|libdmrp_planners|./libtext|' '' "$line.*libtext.so: is no shared object .*"
expect_mistake "truncated library" 's|libdmrp_planners|./libtruncated|' '' "$line.*libtruncated.so: "
expect_mistake "unknown scenario" 's/"crossing"$/"crosing"/' '' "$line.*'crosing'"
expect_mistake "more robots than there is room for" 's/^use = "crossing"/&\nrobots = 60/' '' "$line.*has room for [0-9]+ robots.*not 60"
expect_mistake "a recording that is not there" '' '$a[[recording]]\nfile = "none.csv"' "scenario\.toml:[0-9]+:[0-9]+: no file 'none.csv'"

# All mistakes of the experiment and its scenario in one go, each with its line and a caret under the place.
sed 's/^trials .*/trials = "three"/;s/controller.dwa/controller.dwo/' "$here/crossing.toml" >experiment.toml
sed 's/^start = \[0.5, 2.5/start = [2.0, 4.0/' "$here/worlds/crossing/scenario.toml" >worlds/crossing/scenario.toml
expect_status 2 "$host" validate experiment.toml
[[ $(grep -cE '^[^ ]+:[0-9]+:[0-9]+: ' "$scratch/stderr") == 3 && $(tail -1 "$scratch/stderr") == "3 mistakes" ]] ||
  fail "not three mistakes: $(cat "$scratch/stderr")"
grep -A2 "'trials' must be an integer" "$scratch/stderr" | grep -Eq '^ *\|          \^$' ||
  fail "no caret under the value of trials: $(cat "$scratch/stderr")"
grep -q "robot 0 starts inside 'pillar'" "$scratch/stderr" || fail "the scenario's mistake is missing"

rm experiment.toml
expect_status 2 "$host" experiment.toml
[[ $(messages) == 1 ]] || fail "a missing experiment file gets one line"

# the same for evaluate
cp "$here/crossing.toml" experiment.toml
cp "$here/worlds/crossing/scenario.toml" worlds/crossing/scenario.toml
expect_status 0 "$host" experiment.toml --trials 1 --quiet --out "$scratch/run"
mkdir "$scratch/empty"
expect_evaluate_mistake() {
  local pattern=$1
  shift
  expect_status 2 "$host" evaluate "$@"
  [[ $(messages) == 1 && ! -s $scratch/stdout ]] ||
    fail "evaluate $*: not one line but: $(cat "$scratch/stderr" "$scratch/stdout")"
  grep -Eq -- "$pattern" "$scratch/stderr" || fail "evaluate $*: '$(cat "$scratch/stderr")' does not match '$pattern'"
  echo "evaluate: $(cat "$scratch/stderr")"
}
expect_evaluate_mistake "empty: is no run directory" "$scratch/empty"
expect_evaluate_mistake "'dmrp.metric.st'|dmrp.metric.st: no such metric.*did you mean" "$scratch/run" --metric dmrp.metric.st
expect_evaluate_mistake "dmrp.planner.cbs: is a global_planner, not a metric" "$scratch/run" --metric dmrp.planner.cbs
expect_evaluate_mistake "--set distance=1: .*'distance'.*did you mean 'distance_m'" "$scratch/run" --metric dmrp.metric.sto --set distance=1
expect_evaluate_mistake "--set distance_m=-1: .*distance_m" "$scratch/run" --metric dmrp.metric.sto --set distance_m=-1
expect_evaluate_mistake "name it by --metric" "$scratch/run" --set distance_m=1
expect_evaluate_mistake "--params-file none.toml: there is no such file" "$scratch/run" --metric dmrp.metric.sto --params-file none.toml
expect_evaluate_mistake "--trial 4: .* has 4 trials, from 0 to 3" "$scratch/run" --trial 4
expect_evaluate_mistake "--plugin libnone.so: there is no such library" "$scratch/run" --plugin libnone.so
expect_evaluate_mistake "--plugin ./libtext.so: is no shared object" "$scratch/run" --plugin ./libtext.so
expect_evaluate_mistake "--csv .*: there is no folder" "$scratch/run" --csv "$scratch/none/values.csv"
