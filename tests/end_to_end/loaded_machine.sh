#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# A trial that waits for a processor longer than it may take is no fault: other programs load the machine.
# Called as: loaded_machine.sh DMRP_HOST [SANITIZERS]
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
[[ -z ${2:-} ]] || exit 0 # too slow under sanitizers to wait longer than to compute
[[ -r /proc/self/schedstat ]] || { echo "SKIPPED: the kernel does not count waiting" && exit 77; }

limit_s=2 # a trial computes for a tenth of it
cat >"$scratch/experiment.toml" <<END
[experiment]
name = "crossing"
seed = 7
trials = 1
plugins = ["libdmrp_planners.so", "libdmrp_controllers.so", "libdmrp_pedestrians.so", "libdmrp_metrics.so"]

[[scenario]]
use = "crossing"

[[global_planner]]
use = "dmrp.planner.cbs"

[[local_controller]]
use = "dmrp.controller.mpc"

[[pedestrian_model]]
use = "dmrp.pedestrian.social_force"

[limits]
trial_wall_time_s = $limit_s
END

# all on one processor, with 32 others that never wait
processor=$(taskset -cp $$ | grep -oE '[0-9]+' | tail -1)
others=()
for ((i = 0; i < 32; ++i)); do
  taskset -c "$processor" timeout 300 sh -c 'while :; do :; done' &
  others+=($!)
done
trap 'kill "${others[@]}" 2>/dev/null; rm -rf "$scratch"' EXIT
expect_status 0 taskset -c "$processor" "$host" "$scratch/experiment.toml" --quiet --jobs 1 --out "$scratch/run"
wall_s=$(query "$scratch/run" "SELECT wall_time_s FROM trial")
[[ $(query "$scratch/run" "SELECT wall_time_s > $limit_s FROM trial") == 1 ]] || fail "the trial took $wall_s s: no load"
