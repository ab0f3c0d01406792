#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# A Python file is a plugin library: it is listed and driven, its results repeat to the bit, an edited module is another
# library, its faults are those of other plugins, and its mistakes are one line each. What takes seconds more is in
# tests/python, nightly; mistakes without the host are in tests/python/test_guest.py.
# Called as: python_plugins.sh DMRP_HOST SOURCE_DIR
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
source_dir=$2
/usr/bin/python3 -c 'import numpy' 2>/dev/null || { echo "skipped: no python3-numpy" && exit 77; }
unset VIRTUAL_ENV CONDA_PREFIX PYTHONPATH
export PATH=/usr/bin:/bin
cp "$here"/python/*.py "$source_dir"/examples/python_controller/* "$scratch"
cd "$scratch" || exit 1

# the example
expect_status 0 "$host" plugins ./policy.py
grep -q "look_ahead_m *double = 0.9 m \[0.1 to 5\]" stdout || fail "parameters should be listed: $(cat stdout)"
awk '/^\[\[local_controller/ && ++count == 2 { skip = 1 } /^$/ { skip = 0 } !skip' python_controller.toml |
  sed 's/^trials .*/trials = 1/; s/"mall"/"crossing"/' >one.toml
expect_status 0 "$host" one.toml --quiet --jobs 1 --out first
[[ $(query first "SELECT count(*), min(repeatable) FROM trial") == "1|1" ]] || fail "a repeatable trial is expected"
[[ $(query first "SELECT min(value) >= 0.75 FROM value WHERE metric = 'success' AND subject_kind = 'system'") == 1 ]] ||
  fail "the policy should bring its robots to their goals"
grep -q '"python policy.py": ".*Python 3.*numpy' first/manifest.json || fail "the manifest should name the versions"
grep -q '"role": "python interpreter"' first/manifest.json || fail "the manifest should name the interpreter"

# one trial with these plugins, in the smallest world
experiment() {
  printf '[experiment]\nname = "python"\nseed = 7\ntrials = 1\nplugins = ['
  printf '"%s", ' "$@"
  printf '"libdmrp_planners.so", "libdmrp_pedestrians.so", "libdmrp_metrics.so", "libdmrp_controllers.so"]\n'
  printf '[limits]\nmemory_mb = 600\n[[scenario]]\nuse = "crossing"\n'
}
others() {
  printf '[[global_planner]]\nuse = "dmrp.planner.cbs"\n[[pedestrian_model]]\nuse = "dmrp.pedestrian.social_force"\n'
}

# packages of the active environment, which may lie beside the file
packages=environment/lib/python3.$(/usr/bin/python3 -c 'import sys; print(sys.version_info.minor)')/site-packages
mkdir -p environment/bin "$packages" && ln -s /usr/bin/python3 environment/bin/python3
printf 'home = /usr/bin\ninclude-system-site-packages = true\n' >environment/pyvenv.cfg
echo 'X = 3' >"$packages/only_there.py"
sed 's/^import numpy as np$/&\nimport only_there/' policy.py >needs_it.py
VIRTUAL_ENV=$PWD/environment expect_status 0 "$host" plugins ./needs_it.py
VIRTUAL_ENV=/nowhere expect_status 2 "$host" plugins ./needs_it.py
grep -q "VIRTUAL_ENV names has no bin/python3" stderr || fail "a missing environment should be told: $(cat stderr)"

# a planner, a pedestrian model, a controller of the fleet and a metric; the metric measures stored traces alike
{
  experiment ./kinds.py ./faulty.py
  printf '[[global_planner]]\nuse = "test.planner"\n[[pedestrian_model]]\nuse = "test.crowd"\n'
  printf '[[local_controller]]\nuse = "test.central"\n'
  printf '[[metric]]\nuse = "%s"\n' test.driven dmrp.metric.path_length dmrp.metric.success
} >kinds.toml
expect_status 0 "$host" kinds.toml --quiet --out kinds
[[ $(query kinds "SELECT count(*), max(abs(own.value - value.value)) < 1e-12 FROM value AS own JOIN value USING (subject)
       WHERE own.metric = 'driven' AND value.metric = 'path_length' AND own.subject_kind = 'robot'
       AND value.subject_kind = 'robot'") == "2|1" ]] || fail "the metric in Python should measure as the built-in one"
[[ $(query kinds "SELECT value FROM value WHERE metric = 'success' AND subject_kind = 'system'") == 1.0 ]] ||
  fail "the planner in Python should bring all robots to their goals"
expect_status 0 "$host" evaluate kinds --metric test.driven
expect_status 0 "$host" bundle kinds --out bundled
compgen -G 'bundled/plugins/*/helper.py' >/dev/null || fail "a bundle should have the modules of a Python file"
expect_status 0 "$host" verify bundled

# another library where a module beside it has changed
printf '\nSTILL = (0.0, 0.0, 0.1)\n' >>helper.py
expect_status 2 "$host" kinds.toml --quiet --trials 2 --resume --out kinds
grep -q "helper.py" stderr || fail "the changed module should be named: $(cat stderr)"

expect_status 0 "$host" check ./policy.py
grep -q '1 pass, 0 warn, 0 fail, 0 crash' stdout || fail "check should run a whole trial: $(cat stdout stderr)"

# the templates run at once, here in one trial
for kind in planner controller pedestrian-model metric; do
  expect_status 0 "$host" new "$kind" --python --id "org.example.my-own.my-$kind" "$kind"
  ! grep -rqE 'my_plugin|my_kind' "$kind" || fail "$kind: left from the template"
done
{
  experiment ./{planner/my_planner,controller/my_controller,pedestrian-model/my_pedestrian_model,metric/my_metric}.py
  printf '[simulation]\ntime_limit_s = 10.0\n'
  printf '[[%s]]\nuse = "org.example.my-own.my-%s"\n' global_planner planner local_controller controller \
    pedestrian_model pedestrian-model metric metric
} >templates.toml
expect_status 0 "$host" templates.toml --quiet --out templates
[[ $(query templates "SELECT count(*) FROM fault") == 0 ]] || fail "$(query templates "SELECT * FROM fault")"

# faults
faults=(exception null exit subprocess nan shape dtype write memory)
{
  experiment ./faulty.py
  printf '[simulation]\ntime_limit_s = 3.0\n'
  others
  printf '[[metric]]\nuse = "dmrp.metric.success"\n'
  for fault in none "${faults[@]}"; do
    printf '[[local_controller]]\nuse = "test.faulty"\nlabel = "%s"\nparams.fault = "%s"\n' "$fault" "$fault"
  done
  printf '[[local_controller]]\nuse = "test.central"\nlabel = "wrong"\nparams.wrong = true\n'
} >faults.toml
ulimit -v 16000000
expect_status 1 "$host" faults.toml --quiet --jobs 2 --out faults
expect_fault() {
  local found
  found=$(query faults "SELECT kind, plugin, function, step, robot, signal FROM fault JOIN trial ON trial.id = trial_id
    WHERE local_controller = '$1'")
  [[ $found == "$2" ]] || fail "$1: '$found', not '$2'"
  found=$(query faults "SELECT detail FROM fault JOIN trial ON trial.id = trial_id WHERE local_controller = '$1'")
  grep -Eq -- "$3" <<<"$found" || fail "$1: the detail '$found' does not match '$3'"
}
site='test.faulty|step|50|1'
expect_fault exception "error_status|$site|" '^faulty.py:[0-9]+: ValueError: no idea$'
expect_fault null "crash|$site|11" "Segmentation fault"
expect_fault exit "exit|$site|" "ended with status 0"
expect_fault subprocess "abi_breach|$site|31" "the box refuses"
expect_fault nan "bad_output|$site|" "nan"
expect_fault shape "error_status|$site|" '^faulty.py:[0-9]+: ValueError: step\(\) returned an array of shape \(2,\)'
expect_fault dtype "error_status|$site|" '^faulty.py:[0-9]+: TypeError: step\(\) returned <U4 in place of numbers'
expect_fault write "error_status|$site|" 'read-only'
expect_fault memory "out_of_memory|$site|" '^faulty.py:[0-9]+: MemoryError'
expect_fault wrong "error_status|test.central|step_all|0||" '^faulty.py:[0-9]+: ValueError: .* 2 x 3 numbers are expected'
[[ $(query faults "SELECT outcome FROM trial WHERE local_controller = 'none'") == failed ]] ||
  fail "robots that stand still are a result"

# mistakes, in one line with file and line
mistake() {
  printf 'import dmrp.plugin as dp\n%b' "$1" >wrong.py
  experiment ./wrong.py >wrong.toml
  others >>wrong.toml
  printf '[[local_controller]]\nuse = "dmrp.controller.dwa"\n' >>wrong.toml
  expect_status 2 "$host" validate wrong.toml
  grep -Eq -- "$2" stderr && [[ $(messages) == 1 ]] || fail "'$2' is expected: $(cat stderr)"
}
mistake 'class Policy(dp.LocalController):\n  pass\n' "wrong.py: wrong.py:2: class Policy has no id"
mistake 'import no_such_package\n' "wrong.py: wrong.py:2: ModuleNotFoundError: No module named 'no_such_package' \(by .*python3\)"
mistake 'class Policy(dp.LocalController):\n  id = "a.b"\n  gain = dp.number(3.0, high=1.0)\n' "parameter 'gain' has the default 3"
