#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Where a controller stands between two bounds that the experiment names. Called as: bounds.sh DMRP_HOST
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"

# Stop and wait brings one of two robots home, the others both (worlds/parked).
cat >"$scratch/bounds.toml" <<EOT
[experiment]
name = "bounds"
seed = 5
trials = 8
plugins = ["libdmrp_planners.so", "libdmrp_controllers.so", "libdmrp_metrics.so"]
[[scenario]]
use = "$here/worlds/parked/scenario.toml"
start_jitter = { position_m = 0.01 }  # each repetition has a task of its own
[[global_planner]]
use = "dmrp.planner.cbs"
[[local_controller]]
use = "dmrp.controller.stop_and_wait"
label = "low"
bound = "lower"
[[local_controller]]
use = "dmrp.controller.dwa"
label = "between"
params_file = "controllers/tuned/dwa.toml"
[[local_controller]]
use = "dmrp.controller.mpc"
label = "high"
params_file = "controllers/tuned/mpc.toml"
bound = "upper"
EOT
expect_status 0 "$host" "$scratch/bounds.toml" --out "$scratch/run"
tr -s '\n ' ' ' <"$scratch/stdout" | grep -q 'place_safe_success: from low (0) to high (1) in safe_success' ||
  fail "the table has no place"

# place CONTROLLER: mean, ci_low, ci_high
place() { awk -F, -v of="$1" '$4 == of && $6 == "place_safe_success" { print $12, $15, $16 }' "$scratch/run/summary.csv"; }
[[ $(head -1 "$scratch/run/summary.csv" | cut -d, -f4,6,12,15,16) == "local_controller,metric,mean,ci_low,ci_high" ]] ||
  fail "summary.csv has other columns"
[[ $(place between) == "1 1 1" ]] || fail "the place should be 1, not $(place between)"
[[ $(place low) == "  " && $(place high) == "  " ]] || fail "bounds have no places"

sed '/^bound/d' "$scratch/bounds.toml" >"$scratch/free.toml"
expect_status 0 "$host" "$scratch/free.toml" --out "$scratch/free"
! grep -q place "$scratch/stdout" "$scratch/free/summary.csv" || fail "without bounds there are no places"
