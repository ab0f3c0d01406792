#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Every controller drives one robot through the maps of MRPB 1.0, if the data is there. Called as
# mrpb.sh DMRP_HOST SOURCE_DIR TEST_DATA [SANITIZERS]. With sanitizers, one task of each map.
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
source_dir=$2
data=${DMRP_TEST_DATA:-${3:-}}
sanitizers=${4:-}

if [[ ! -d $data/mrpb ]]; then
  echo "skipped: DMRP_TEST_DATA is not set"
  exit 77
fi
cp -r "$data/mrpb" "$scratch/data" && chmod -R u+w "$scratch/data"
[[ -z $sanitizers ]] || sed -i '3,$d' "$scratch"/data/*/starts_goals.csv
expect_status 0 "$source_dir/examples/ros_map/tasks_from_csv.sh" "$scratch/data" "$scratch/tasks"
tasks=$(find "$scratch/tasks" -name scenario.toml | wc -l)
((tasks == $([[ -n $sanitizers ]] && echo 4 || echo 12))) || fail "$tasks tasks, not one a line of the CSVs"

expect_status 0 "$host" "$scratch/tasks/experiment.toml" --out "$scratch/run" --quiet
query "$scratch/run" "SELECT local_controller, scenario, outcome, sim_time_s FROM trial ORDER BY local_controller, scenario"
[[ $(query "$scratch/run" "SELECT count(*) FROM trial") == $((tasks * $(grep -c '^\[\[local_controller' "$scratch/tasks/experiment.toml"))) ]] ||
  fail "trials are missing"
[[ $(query "$scratch/run" "SELECT count(*) FROM trial WHERE outcome <> 'succeeded'") == 0 ]] || fail "a robot did not arrive"
[[ $(query "$scratch/run" "SELECT sum(value) FROM value WHERE metric = 'collisions' AND subject_kind = 'system'") == 0.0 ]] ||
  fail "a robot touched a wall"
