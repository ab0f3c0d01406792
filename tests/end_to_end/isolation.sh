#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# No library meets another's code or data: neither by accident, as two copies of one header or of one shared library, nor
# on purpose. Each controller has the values that it has alone, whatever else is listed and in whatever order.
# Called as: isolation.sh DMRP_HOST LIBRARY_ONE LIBRARY_TWO SABOTEUR LIBRARY_OF_FAULTS
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
one=$2 two=$3 saboteur=$4 faults=$5

# experiment NAME LIBRARIES CONTROLLER...
experiment() {
  sed "s|^\(plugins = .*\)\]|\1, $2]|; /^\[\[local_controller\]\]/,/^\$/d; s/^trials .*/trials = 2/" "$here/crossing.toml" \
    >"$scratch/$1.toml"
  local controller
  for controller in "${@:3}"; do
    printf '\n[[local_controller]]\nuse = "%s"\nlabel = "%s"\n' "$controller" "$controller" >>"$scratch/$1.toml"
  done
  expect_status 0 "$host" "$scratch/$1.toml" --quiet --jobs 1 --out "$scratch/$1"
}
values() {
  query "$scratch/$1" "SELECT trial.repetition, global_planner, outcome, metric, subject_kind, subject,
    printf('%!.17g', value.value) FROM value JOIN trial ON trial.id = trial_id
    WHERE local_controller = '$2' AND metric NOT IN (SELECT name FROM metric WHERE wall_clock) ORDER BY 1, 2, 4, 5, 6"
}
expect_same() {
  [[ -n $(values "$1" "$3") && $(values "$1" "$3") == "$(values "$2" "$3")" ]] || fail "$3: its values in $2 differ"
}

experiment one "\"$one\"" test.one
experiment two "\"$two\"" test.two
[[ $(values one test.one) != "$(values two test.two)" ]] || fail "the two should drive differently"
experiment both "\"$one\", \"$two\"" test.one test.two
experiment swapped "\"$two\", \"$one\"" test.two test.one
for run in both swapped; do
  expect_same one $run test.one
  expect_same two $run test.two
done

# a shared library that is replaced while guests come and go: no rows of two versions in one table
mkdir "$scratch/rebuilt"
cp "$(dirname "$one")"/*.so "$scratch/rebuilt"
sed "s|^\(plugins = .*\)\]|\1, \"$scratch/rebuilt/$(basename "$one")\", \"$faults\"]|; /^\[\[local_controller\]\]/,/^\$/d
  s/^trials .*/trials = 400/" "$here/crossing.toml" >"$scratch/rebuilt.toml"
printf '\n[[local_controller]]\nuse = "test.one"\n\n[[local_controller]]\nuse = "test.controller.faulty"
params = { fault = "crash" }\n' >>"$scratch/rebuilt.toml"
"$host" "$scratch/rebuilt.toml" --quiet --jobs 1 --out "$scratch/rebuilt_run" >"$scratch/stdout" 2>"$scratch/stderr" &
host_process=$!
while kill -0 $host_process 2>/dev/null && ! compgen -G "$scratch/rebuilt_run/traces/*3.mcap" >/dev/null; do sleep 0.05; done
cp "$(dirname "$two")/libgain_core.so" "$scratch/rebuilt/new" && mv "$scratch/rebuilt/new" "$scratch/rebuilt/libgain_core.so"
status=0
wait $host_process || status=$?
((status == 2)) || fail "exit status $status, not 2"
grep -q "changed (it, or a file that it names) while it was being run" "$scratch/stderr" || fail "$(cat "$scratch/stderr")"

# a listed library that no trial uses is loaded by no trial
experiment alone "\"$one\"" dmrp.controller.pure_pursuit
experiment attacked "\"$saboteur\"" dmrp.controller.pure_pursuit
expect_same alone attacked dmrp.controller.pure_pursuit
experiment beside "\"$saboteur\"" test.saboteur dmrp.controller.pure_pursuit
expect_same alone beside dmrp.controller.pure_pursuit
