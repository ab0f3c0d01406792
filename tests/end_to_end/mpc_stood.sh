#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Tasks on which MPC once stood for ever. Called as: mpc_stood.sh DMRP_HOST
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"

# A slow robot, called at 20 Hz, past corners that a trajectory jumps in one step: two tasks of
# examples/nav2/nav2_controllers.toml.
cat >"$scratch/slow.toml" <<EOT
[experiment]
name = "slow"
seed = 220022
trials = 1
plugins = ["libdmrp_planners.so", "libdmrp_controllers.so", "libdmrp_pedestrians.so", "libdmrp_metrics.so"]
[[scenario]]
use = "library"
robots = 1
tasks = "drawn"
[[scenario]]
use = "office"
robots = 1
tasks = "drawn"
[[global_planner]]
use = "dmrp.planner.ecbs8"
[[local_controller]]
use = "dmrp.controller.mpc"
params_file = "controllers/tuned/mpc.toml"
[[pedestrian_model]]
use = "dmrp.pedestrian.social_force"
[simulation]
step_s = 0.025
control_period_s = 0.05
replan_period_s = 1.0
goal_tolerance_m = 0.25
[robot]
footprint = { radius_m = 0.22 }
v_max = 0.5
v_min = -0.35
omega_max = 1.9
a_max = 3.0
alpha_max = 3.5
[[metric]]
use = "dmrp.metric.success"
EOT
expect_status 0 "$host" "$scratch/slow.toml" --quiet --out "$scratch/slow"
[[ $(query "$scratch/slow" "SELECT outcome FROM trial") == $'succeeded\nsucceeded' ]] ||
  fail "$(query "$scratch/slow" "SELECT scenario, outcome FROM trial")"

# Two robots that meet in a corridor where the costmap shows a way past the other, and no trajectory along it is free.
cat >"$scratch/corridor.toml" <<EOT
[experiment]
name = "corridor"
seed = 4711
trials = 6
plugins = ["libdmrp_planners.so", "libdmrp_controllers.so", "libdmrp_metrics.so"]
[[scenario]]
use = "course/corridor"
levels = [1.6]
start_jitter = { position_m = 0.1, heading_rad = 0.2 }
[[global_planner]]
use = "dmrp.planner.individual"
[[local_controller]]
use = "dmrp.controller.mpc"
params_file = "controllers/tuned/mpc.toml"
[[metric]]
use = "dmrp.metric.success"
[simulation]
grid_resolution_m = 0.5
planning_margin_m = 0.0
step_duration_s = 0.9
EOT
expect_status 0 "$host" "$scratch/corridor.toml" --quiet --out "$scratch/corridor"
[[ $(query "$scratch/corridor" "SELECT count(*) FROM trial WHERE outcome = 'succeeded'") == 6 ]] ||
  fail "$(query "$scratch/corridor" "SELECT repetition, outcome FROM trial")"
