#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The example of windows: all robots come home, with whole plans and with windows, and both are planned again and again.
# Called as: windows.sh DMRP_HOST SOURCE_DIR TRACE_DIGEST
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
source_dir=$2 trace_digest=$3

expect_status 0 "$host" "$source_dir/examples/windows.toml" --quiet --trials 1 --out "$scratch/run"
[[ $(query "$scratch/run" "SELECT swept.value, outcome, value.value FROM trial JOIN swept ON swept.trial_id = id
  JOIN value ON value.trial_id = id WHERE metric = 'success' AND subject_kind = 'system' ORDER BY id") == \
  $'0|succeeded|1.0\n10|succeeded|1.0' ]] || fail "robots are not home: $(query "$scratch/run" "SELECT * FROM trial")"

# sizes_of_plans TRIAL: the bytes of each plan in its trace
sizes_of_plans() {
  "$trace_digest" --records "$scratch/run/traces/trial_00000$1.mcap" | awk '$2 == 2 { print $4 }'
}
for trial in 0 1; do
  (($(sizes_of_plans $trial | wc -l) > 5)) || fail "trial $trial was planned $(sizes_of_plans $trial | wc -l) times"
done
# ten steps of 64 robots are less than their whole ways
(($(sizes_of_plans 1 | sort -n | tail -1) < $(sizes_of_plans 0 | sort -n | tail -1) / 2)) ||
  fail "the largest plan of a window has $(sizes_of_plans 1 | sort -n | tail -1) bytes, that of whole ways \
$(sizes_of_plans 0 | sort -n | tail -1)"
