#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The memory of a crowd's trial does not grow with its duration: run and measured under a limit below the size of its samples.
# Called as: memory.sh DMRP_HOST CHECK_VALUES [SANITIZERS]
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
check_values=$2
[[ -z ${3:-} ]] || exit 0  # there are no limits under sanitizers

# the host does not list the trials that are planned: here 4 million
(ulimit -v 1000000 && exec "$host" "$here/crossing.toml" --quiet --jobs 1 --trials 1000000 --out "$scratch/many") \
  >"$scratch/stdout" 2>"$scratch/stderr" &
host_process=$!
while kill -0 "$host_process" 2>/dev/null && ! compgen -G "$scratch/many/traces/*.mcap" >/dev/null; do sleep 0.1; done
kill -TERM "$host_process" 2>/dev/null
status=0
wait "$host_process" || status=$?
((status == 130)) || fail "exit status $status, not 130: $(cat "$scratch/stderr")"

# 1,000 people for 30 s, 112 bytes each at every step: 168 MB, and twice as much in a growing array
limit_mb=240
cat >"$scratch/crowd.toml" <<END
[scenario]
name = "crowd"
title = "Crowd"
description = "many people on their way"
size_m = [120.0, 60.0]
time_limit_s = 30.0

[[region]]
name = "west"
lower_m = [1.0, 1.0]
upper_m = [70.0, 59.0]

[[region]]
name = "east"
lower_m = [115.0, 1.0]
upper_m = [119.0, 59.0]

[[flow]]
name = "all"
from = "west"
to = "east"
people = 1000
start = "from"
END
for traces in all none; do
  cat >"$scratch/$traces.toml" <<END
[experiment]
name = "crowd"
seed = 1
trials = 1
plugins = ["libdmrp_pedestrians.so", "libdmrp_metrics.so"]

[[scenario]]
use = "crowd.toml"

[[pedestrian_model]]
use = "dmrp.pedestrian.collision_free_speed"

[[metric]]
use = "dmrp.metric.pedestrian_progress"

[[metric]]
use = "dmrp.metric.arrivals"

[record]
traces = "$traces"

[limits]
memory_mb = $limit_mb
END
  run=$scratch/$traces
  expect_status 0 "$host" "$scratch/$traces.toml" --quiet --out "$run"
  [[ $(query "$run" "SELECT group_concat(outcome) FROM trial") == succeeded ]] || fail "the trial should finish"
  ! compgen -G "$run/*scratch*" >/dev/null || fail "a scratch file was left: $(ls "$run")"
done
cmp -s <(values_of "$scratch/all") <(values_of "$scratch/none") || fail "values depend on whether a trace is recorded"
[[ $(query "$scratch/all" "SELECT count(*) FROM value WHERE metric = 'pedestrian_progress'") == 31 ]] ||
  fail "there should be one value per second"

# measured again, under the same limit
expect_status 0 "$host" evaluate "$scratch/all" --csv "$scratch/values.csv"
"$check_values" "$scratch/all" "$scratch/values.csv" || fail "values of the stored trace differ"
