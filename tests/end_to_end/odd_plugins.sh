#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Plugins that break the contract in ways that only the C headers allow: every breach has its name, and every text of a
# plugin is one line. Called as: odd_plugins.sh DMRP_HOST LIBRARY_OF_ODD_PLUGINS [SANITIZERS]
source "$(dirname "${BASH_SOURCE[0]}")/faults.sh"

nasty='one\\ntwo \\x1b\[2J \\xc2\\x9b1m \\xff\\xfe café$' # as the host shows it
note="its plugin 'test.odd.stranger' is left out: it is of kind 77, which this host does not know"
# expect_plain FILE: UTF-8 without control characters, but for line ends and the colours of the host
expect_plain() {
  iconv -f UTF-8 -t UTF-8 "$1" >"$scratch/plain" || fail "not UTF-8: $(cat "$1")"
  ! LC_ALL=C sed 's/\x1b\[[0-9;]*[mK]//g' "$1" | LC_ALL=C tr -d '\n\r\t' | LC_ALL=C grep -q '[[:cntrl:]]' ||
    fail "control characters in: $(cat -v "$1")"
}

# a plugin of unknown kind is left out with a note
expect_status 0 "$host" plugins "$library"
[[ $(grep -c "$note" "$scratch/stderr") == 1 && $(messages) == 1 ]] ||
  fail "there should be one note: $(cat "$scratch/stderr")"
grep -q test.odd.controller "$scratch/stdout" || fail "the other plugins should be listed"
! grep -q stranger "$scratch/stdout" || fail "the unknown plugin should not be listed"
expect_status 0 "$host" plugins --json "$library"
[[ $(sqlite3 :memory: "SELECT json_array_length(readfile('$scratch/stdout'), '\$[0].plugins')") == 5 ]] ||
  fail "five plugins should be listed: $(cat "$scratch/stdout")"

# odd NAME ID [DOES]: a local controller, labelled with what it does
odd() {
  printf '\n[[local_controller]]\nuse = "%s"\nlabel = "%s"\nparams = { does = "%s" }\n' "$1" "$2" "$2" \
    >>"$scratch/faults.toml"
}
begin_experiment faults local_controller
use faults metric dmrp.metric.success
each=("create 2" "create 3" "start 2" "set_path 2" "step 3" "trial_end 2" "overrun create 1" "overrun create 200"
  "overrun step" "fail" "say much" "drive")
for does in "${each[@]}"; do odd test.odd.controller "$does"; done
for does in "step_all 2" "overrun step_all" "nan 1" "drive all"; do odd test.odd.central "$does"; done
expect_status 1 "$host" "$scratch/faults.toml" --jobs 2 --out "$scratch/faults"
grep -q "$note" "$scratch/stderr" || fail "the run should begin with the note: $(cat "$scratch/stderr")"
expect_plain "$scratch/stdout"
expect_plain "$scratch/stderr"

expect() {
  expect_fault faults "local_controller = '$1' AND global_planner = 'together'" "abi_breach|$2|" "$3"
}
c=test.odd.controller
expect "create 2" "$c|create|0|0" 'returned DMRP_NO_SOLUTION'
expect "create 3" "$c|create|0|0" 'returned DMRP_TIMEOUT'
expect "start 2" "$c|start|0|0" 'returned DMRP_NO_SOLUTION'
expect "set_path 2" "$c|set_path|0|0" 'returned DMRP_NO_SOLUTION'
expect "step 3" "$c|step|0|0" 'returned DMRP_TIMEOUT'
expect "overrun create 1" "$c|create|0|0" 'wrote beyond the end of dmrp_plugin'
expect "overrun create 200" "$c|create|0|0" 'wrote beyond the end of dmrp_plugin'
expect "overrun step" "$c|step|0|0" 'wrote beyond the end of dmrp_command'
expect "step_all 2" "test.odd.central|step_all|0|" 'returned DMRP_NO_SOLUTION'
expect "overrun step_all" "test.odd.central|step_all|0|" 'wrote beyond the end of the commands'
expect_fault faults "local_controller = 'nan 1' AND global_planner = 'together'" \
  "bad_output|test.odd.central|step_all|0|1|" nan
expect_fault faults "local_controller = 'fail' AND global_planner = 'together'" "error_status|$c|start|0|0|" "^$nasty"
expect_fault faults "local_controller = 'say much' AND global_planner = 'together'" "error_status|$c|start|0|0|" '^x{4000}$'
[[ $(query "$scratch/faults" "SELECT function, count(*) FROM fault JOIN trial ON trial.id = trial_id
       WHERE local_controller = 'trial_end 2'") == "trial_end|2" ]] || fail "trial_end may not return DMRP_NO_SOLUTION"
[[ $(query "$scratch/faults" "SELECT count(*) FROM trial WHERE local_controller IN ('drive', 'drive all')
       AND outcome = 'failed'") == 4 ]] || fail "robots that drive ahead are results"

# the same for evaluate and plan, which print the text
expect_status 0 "$host" "$here/crossing.toml" --trials 1 --quiet --out "$scratch/run"
expect_status 1 "$host" evaluate "$scratch/run" --metric test.odd.metric --plugin "$library" --set "does=fail" --trial 0
grep -Eq "^trial 0: test.odd.metric: start\(\): $nasty" "$scratch/stderr" || fail "$(cat -v "$scratch/stderr")"
expect_plain "$scratch/stderr"
expect_status 1 "$host" plan --scenario crossing --planner test.odd.planner --plugin "$library" --set does=fail
grep -Eq "start\(\): $nasty" "$scratch/stderr" || fail "$(cat -v "$scratch/stderr")"
expect_plain "$scratch/stderr"
