#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The mall, drawn and planned: called as draw.sh DMRP_HOST.
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"

expect_status 0 "$host" draw mall --planner dmrp.planner.cbs --svg "$scratch/mall.svg"
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
