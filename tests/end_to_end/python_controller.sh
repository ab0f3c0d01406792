#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The controller in Python, built against the installed SDK: it drives, its results repeat to the bit, and an exception
# of the policy is a fault with its text. Called as: python_controller.sh DMRP_HOST SOURCE_DIR CMAKE
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
build_dir=$(dirname "$(dirname "$host")") source_dir=$2 cmake=$3
/usr/bin/python3 -c 'import numpy, os, sysconfig; assert os.path.exists(sysconfig.get_path("include") + "/Python.h")' \
  2>/dev/null || { echo "skipped: no python3-dev or no python3-numpy" && exit 77; }
cp -r "$source_dir/examples/python_controller" "$scratch/python"
cd "$scratch/python" || exit 1

expect_status 0 "$cmake" --install "$build_dir" --prefix "$scratch/dmrp"
expect_status 0 "$cmake" -S . -B build -DCMAKE_PREFIX_PATH="$scratch/dmrp" -DPython3_EXECUTABLE=/usr/bin/python3
expect_status 0 "$cmake" --build build

expect_status 0 "$host" check build/libpython_controller.so

# without DWA
awk '/^\[\[local_controller/ && ++count == 2 { skip = 1 } /^$/ { skip = 0 } !skip' python_controller.toml |
  sed 's/^trials .*/trials = 2/' >one.toml
expect_status 0 "$host" one.toml --quiet --jobs 1 --out first
expect_status 0 "$host" one.toml --quiet --jobs 2 --out second
[[ $(query first "SELECT count(*), min(repeatable) FROM trial") == "2|1" ]] || fail "two repeatable trials are expected"
[[ $(query first "SELECT min(value) >= 0.75 FROM value WHERE metric = 'success' AND subject_kind = 'system'") == 1 ]] ||
  fail "the policy should bring its robots to their goals"
[[ $(values_of first) == "$(values_of second)" ]] || fail "two runs should have the same bits"

printf '\n\nclass Policy(Policy):\n    def step(self, state, agents):\n        raise ValueError("no idea")\n' >>build/policy.py
expect_status 1 "$host" one.toml --quiet --trials 1 --out broken
[[ $(query broken "SELECT * FROM fault") == *"policy.py: ValueError: no idea"* ]] ||
  fail "the fault should have the exception's text: $(query broken "SELECT * FROM fault")"
printf 'syntax error\n' >build/policy.py
expect_status 2 "$host" validate one.toml
grep -q "policy.py: SyntaxError" "$scratch/stderr" || fail "a broken policy.py should be told: $(cat "$scratch/stderr")"
