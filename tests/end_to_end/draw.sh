#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The mall, drawn and planned: called as draw.sh DMRP_HOST.
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"

expect_status 0 "$host" draw mall --planner dmrp.planner.cbs --svg "$scratch/mall.svg"
# the sum of the paths that the benchmark's method asks for: 63 m, 3 % either way
total=$(sed -n 's/^dmrp.planner.cbs: \([0-9.]*\) m in all.*/\1/p' "$scratch/stderr")
awk -v total="$total" 'BEGIN { exit !(total >= 61.11 && total <= 64.89) }' || fail "CBS plans $total m in all"
(($(grep -c 'class="path"' "$scratch/mall.svg") >= 4)) || fail "the picture should show four paths"

expect_status 0 "$host" draw mall
grep -q '^<svg' "$scratch/stdout" || fail "no picture on standard output"

expect_status 2 "$host" draw mal
[[ $(cat "$scratch/stderr") == *"no scenario 'mal'"*"did you mean 'mall'?"* ]] || fail "$(cat "$scratch/stderr")"
expect_status 2 "$host" draw mall --planner dmrp.planner.cbz --svg "$scratch/none.svg"
[[ $(cat "$scratch/stderr") == *"did you mean 'dmrp.planner.cbs'?"* ]] || fail "$(cat "$scratch/stderr")"
expect_status 2 "$host" draw mall --planner dmrp.planner.cbs --set node_limits=5 --svg "$scratch/none.svg"
[[ $(cat "$scratch/stderr") == *"did you mean 'node_limit'?"* ]] || fail "$(cat "$scratch/stderr")"
[[ ! -e $scratch/none.svg ]] || fail "a mistake should leave nothing behind"
