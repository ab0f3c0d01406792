#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# MPC drives a slow robot, called at 20 Hz, past corners that a trajectory jumps in one step: two tasks of
# examples/nav2/nav2_controllers.toml on which it once waited for ever. Called as: slow_robot.sh DMRP_HOST
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"

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
