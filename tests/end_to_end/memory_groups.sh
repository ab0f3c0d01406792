#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Where dmrp-host has a control group of its own (cgroup v2), the kernel limits the memory of workers, planners and
# measuring processes by groups: what exceeds its group is out of memory, other trials keep their values, and no group is
# left. SKIPPED where the test can get no such group.
# Called as: memory_groups.sh DMRP_HOST LIBRARY_OF_ATTACKS LIBRARY_OF_FAULTS [SANITIZERS]
attacks=$2
set -- "$1" "$3" "${4:-}"
source "$(dirname "${BASH_SOURCE[0]}")/faults.sh"
$limited || exit 0

# in_group COMMAND...: in a new group, which is the command's own. `made`: its folder, if not systemd's
in_group=$scratch/in_group
made=
if systemd-run --user --scope --quiet -p Delegate=yes true 2>/dev/null; then
  printf '#!/bin/sh\nexec systemd-run --user --scope --quiet -p Delegate=yes "$@"\n' >"$in_group"
elif [[ ! -d /run/systemd/system ]] && around=$(awk '$4 == "/" && / - cgroup2 / {print $5}' /proc/self/mountinfo) &&
  grep -qw memory "$around/cgroup.subtree_control" 2>/dev/null && made=$(mktemp -d "$around/test-dmrp-XXXXXX" 2>/dev/null); then
  trap 'rm -rf "$scratch"; rmdir "$made"' EXIT
  printf '#!/bin/sh\necho 0 >%s/cgroup.procs && exec "$@"\n' "$made" >"$in_group"
else
  echo "SKIPPED: no delegated cgroup v2 with the memory controller"
  exit 77
fi
chmod +x "$in_group"

# expect_none_left: groups below the one that was made
expect_none_left() {
  [[ -z $made ]] || ! compgen -G "$made/*/" >/dev/null || fail "groups are left: $(ls -d "$made"/*/)"
}

# one controller fills shared memory, which no limit on data counts; the other has no faults
begin_experiment shared local_controller global_planner
sed -i 's/^trials .*/trials = 2/; s/^memory_mb .*/memory_mb = 150\nstep_time_s = 60/' "$scratch/shared.toml"
sed -i "s|^plugins = \[|&\"$attacks\", |" "$scratch/shared.toml"
use shared global_planner dmrp.planner.cbs
use shared metric dmrp.metric.path_length
use shared local_controller dmrp.controller.pure_pursuit
echo 'label = "pursuit"' >>"$scratch/shared.toml"
cp "$scratch/shared.toml" "$scratch/alone.toml"
printf '\n[[local_controller]]\nuse = "test.controller.hostile"\nlabel = "fills"\nparams = { attack = "fills" }\n' \
  >>"$scratch/shared.toml"
values() {
  query "$1" "SELECT trial.repetition, metric, subject, printf('%!.17g', value.value) FROM value
    JOIN trial ON trial.id = trial_id WHERE local_controller = 'pursuit' ORDER BY 1, 2, 3"
}
expect_status 0 "$host" "$scratch/alone.toml" --quiet --jobs 2 --out "$scratch/alone"
expect_status 1 "$in_group" "$host" "$scratch/shared.toml" --quiet --jobs 2 --out "$scratch/shared"
grep -q '"memory": "memory.max"' "$scratch/shared/manifest.json" || fail "$(grep memory "$scratch/shared/manifest.json")"
expect_fault shared "local_controller = 'fills' AND repetition = 0" \
  "out_of_memory|test.controller.hostile|step|50|1|9" "more than memory_mb = 150 in use; when this is noticed"
[[ $(query "$scratch/shared" "SELECT count(*) FROM fault") == 2 ]] || fail "each trial that fills memory should be a fault"
[[ -n $(values "$scratch/alone") && $(values "$scratch/shared") == "$(values "$scratch/alone")" ]] || fail "values differ"
expect_none_left

# a planner has a group, too
expect_status 1 "$in_group" "$host" plan --scenario crossing --planner test.planner.faulty --plugin "$library" \
  --set fault=memory --memory-limit 300 --json
grep -q '"out_of_memory"' "$scratch/stdout" || fail "$(cat "$scratch/stdout" "$scratch/stderr")"
expect_none_left

# a host that is killed leaves nobody in its groups
if [[ -n $made ]]; then
  "$in_group" "$host" "$scratch/alone.toml" --quiet --jobs 2 --trials 500 --out "$scratch/killed" 2>"$scratch/stderr" &
  host_process=$!
  for ((i = 0; i < 600; ++i)); do
    compgen -G "$scratch/killed/traces/*3.mcap" >/dev/null && break
    sleep 0.05
  done
  [[ $(cat "$made"/dmrp-child-*/memory.max) == *$((150 << 20))* ]] || fail "workers should have a limit"
  kill -KILL "$host_process"
  wait "$host_process" 2>/dev/null
  for group in "$made"/*/; do
    for ((i = 0; i < 100; ++i)); do
      rmdir "$group" 2>/dev/null && break
      sleep 0.05
    done
  done
  expect_none_left
fi
