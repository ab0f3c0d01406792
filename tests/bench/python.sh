#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The wall time of a controller's call, in Python and in C++: the mean over a trial in the mall with four robots and twelve
# people. Called as: python_call.sh DMRP_HOST. Prints microseconds, and the ratio to pure pursuit in C++.
set -euo pipefail
host=$(realpath "$1")
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

{
  printf '[experiment]\nname = "call"\nseed = 1\ntrials = 3\nplugins = ["%s/python/still.py", "libdmrp_planners.so",
    "libdmrp_pedestrians.so", "libdmrp_metrics.so", "libdmrp_controllers.so"]\n' "$here"
  printf '[simulation]\ntime_limit_s = 60.0\n[[scenario]]\nuse = "mall"\n[[global_planner]]\nuse = "dmrp.planner.cbs"\n'
  printf '[[pedestrian_model]]\nuse = "dmrp.pedestrian.social_force"\n'
  printf '[[local_controller]]\nuse = "%s"\n' dmrp.controller.pure_pursuit dmrp.controller.dwa bench.still bench.reader bench.fleet
} >"$scratch/call.toml"
"$host" "$scratch/call.toml" --quiet --jobs 1 --out "$scratch/run" || true # robots that stand still fail
sqlite3 -batch "$scratch/run/results.sqlite" "
  WITH mean AS (SELECT local_controller, avg(value) * 1000.0 AS us FROM value JOIN trial ON trial.id = trial_id
    WHERE metric = 'control_call_mean' AND subject_kind = 'system' GROUP BY 1 ORDER BY min(trial.id))
  SELECT printf('%-30s %8.1f us %8.1f', local_controller, us, us / first_value(us) OVER ()) FROM mean"
