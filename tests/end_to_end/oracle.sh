#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The oracle among people whom nothing holds up: it waits for nobody who will step aside in time, and evades those who
# will turn toward it. Called as oracle.sh DMRP_HOST.
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"

cat >"$scratch/hall.toml" <<'TOML'
[scenario]
name = "hall"
title = "Hall"
description = "two people in a hall"
size_m = [16.0, 8.0]
time_limit_s = 60.0
[[robot]]
name = "eastward"
start = [1.5, 3.5]
goal = [14.5, 3.5]
[[recording]]
file = "people.csv"
TOML
# One stands on the robot's way and leaves as the robot comes near. One walks along beside the way and turns into it
# right before the robot.
cat >"$scratch/people.csv" <<'CSV'
time,id,x,y
0,1,6.5,3.5
4.4,1,6.5,3.5
6.4,1,6.5,5.9
60,1,6.5,5.9
0,2,14.5,5.2
4.5,2,14.5,5.2
7.5,2,10.9,4.5
8.9,2,9.3,3.4
10.9,2,9.3,1.0
60,2,9.3,1.0
CSV
cat >"$scratch/oracle.toml" <<'TOML'
[experiment]
name = "oracle"
plugins = ["libdmrp_planners.so", "libdmrp_controllers.so", "libdmrp_metrics.so"]
[[scenario]]
use = "./hall.toml"
[[global_planner]]
use = "dmrp.planner.cbs"
[[local_controller]]
use = "dmrp.controller.mpc"
label = "MPC"
params_file = "controllers/tuned/mpc.toml"
[[local_controller]]
use = "dmrp.controller.oracle"
label = "Oracle"
params_file = "controllers/tuned/oracle.toml"
TOML
expect_status 0 "$host" "$scratch/oracle.toml" --quiet --jobs 1 --out "$scratch/people"
run=$scratch/people

# value CONTROLLER METRIC
value() {
  query "$run" "SELECT value FROM value JOIN trial ON id = trial_id WHERE local_controller = '$1' AND metric = '$2'
    AND subject_kind = 'system'"
}
for controller in MPC Oracle; do
  [[ $(value $controller contact_free_success) == 1.0 ]] || fail "$controller should arrive without a contact"
done
awk "BEGIN { exit !($(value Oracle path_length) < $(value MPC path_length) - 0.05) }" ||
  fail "MPC drove $(value MPC path_length) m; the oracle should make a smaller detour than $(value Oracle path_length) m"

# Without people, there is nothing to be told: the same drive.
sed -i '/\[\[recording\]\]/,$d' "$scratch/hall.toml"
expect_status 0 "$host" "$scratch/oracle.toml" --quiet --jobs 1 --out "$scratch/nobody"
run=$scratch/nobody
[[ $(value Oracle completion_time) == "$(value MPC completion_time)" ]] || fail "the oracle is no MPC"
