#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Plugins of others in a run: their metric stands in the table and in the report, their log lines say where they come
# from, and --debug gives the values of the run.
# Called as: third_party.sh DMRP_HOST LIBRARY
set -uo pipefail
host=$1 library=$2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch" || exit 1

fail() {
  echo "FAILED: $*" >&2
  exit 1
}

cat >experiment.toml <<END
[experiment]
name = "third_party"
trials = 2
plugins = ["libdmrp_planners.so", "libdmrp_metrics.so", "$library"]
[[scenario]]
use = "mall"
[[global_planner]]
use = "dmrp.planner.cbs"
[[local_controller]]
use = "test.check.controller"
[[pedestrian_model]]
use = "test.check.people"
[[metric]]
use = "dmrp.metric.success"
[[metric]]
use = "test.check.metric"
[simulation]
time_limit_s = 5
END
export DMRP_TEST_FAULT=logs
"$host" experiment.toml --jobs 1 --out run >printed 2>&1 || { cat printed; fail "the run"; }
grep -q 'test_check' printed || { cat printed; fail "the table should have a column test_check"; }
grep -q 'test_check: a number' printed || fail "the legend should explain it"
grep -q '"id":"added"' run/report.html || fail "the report should have a table of added metrics"
grep -q '"metric":"test_check"' run/report.html || fail "with test_check"
grep -Eq '^\[info\] test.check.controller \(trial 1, robot 2, 0\.10 s\): hello$' run/log.txt ||
  { head -5 run/log.txt; fail "log lines should carry trial, robot and simulated time"; }
grep -Eq '^\[info\] test.check.people \(trial 0, 0\.02 s\): hello$' run/log.txt || fail "and those of no robot the time"

"$host" run experiment.toml --debug 1 >debugged 2>logged || { cat debugged logged; fail "--debug"; }
grep -Eq '^time limit after 5.00 s$' debugged || { cat debugged; fail "how the trial ended"; }
stored=$(sqlite3 run/results.sqlite "SELECT printf('%g', value) FROM value WHERE trial_id = 1 AND metric = 'test_check'")
grep -Eq "^  test_check +$stored\$" debugged || { cat debugged; fail "the value of the run is $stored"; }
grep -q 'trial 1, robot 2, 0.10 s' logged || fail "log lines go to the terminal"
status=0
"$host" run experiment.toml --debug 2 >/dev/null 2>said || status=$?
((status == 2)) && grep -q 'has the trials 0 to 1' said || fail "there is no trial 2: $(cat said)"

# a plugin says that its results depend on timing: the trials are not repeatable, and every place says why
DMRP_TEST_FAULT='says that it draws in a thread' "$host" experiment.toml --out timing >printed 2>&1 ||
  { cat printed; fail "what depends on timing is no fault"; }
grep -q '2 trials not repeatable' printed || { cat printed; fail "the terminal should say so"; }
reasons=$(sqlite3 timing/results.sqlite "SELECT count(*), min(reason), sum(repeatable) FROM timing JOIN trial ON id = trial_id
  WHERE plugin = 'test.check.controller'")
[[ $reasons == '2|draws in a thread|0' ]] || fail "the results should say why: $reasons"
tr -d ' \n' <timing/manifest.json |
  grep -q '{"plugin":"test.check.people","reason":"drawsinathread","trials":2}' || fail "the manifest should say why"
grep -q '"reason":"draws in a thread"' timing/report.html || fail "the report should say why"

DMRP_TEST_FAULT='odd status' "$host" run experiment.toml --debug 0 >debugged 2>/dev/null
(($? == 1)) && grep -q 'abi_breach: test.check.controller: step().*99' debugged || fail "a fault: $(cat debugged)"
