#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# What Python costs beside C++, with ratios: the wall time of a controller's call, the median over a trial of at most 40 s in
# the mall with four robots and twelve people, and the processor time of reading 2,000 samples of such a trial's trace.
# Called as: python.sh DMRP_HOST TRACE_DUMP
set -euo pipefail
host=$(realpath "$1") trace_dump=$(realpath "$2")
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
for module in numpy pandas; do
  /usr/bin/python3 -c "import $module" 2>/dev/null || { echo "SKIPPED: python3-$module is not installed" && exit 77; }
done
unset VIRTUAL_ENV CONDA_PREFIX
export PATH=/usr/bin:/bin
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

{
  printf '[experiment]\nname = "call"\nseed = 1\ntrials = 1\nplugins = ["%s/python/still.py", "libdmrp_planners.so",
    "libdmrp_pedestrians.so", "libdmrp_metrics.so", "libdmrp_controllers.so"]\n' "$here"
  printf '[simulation]\ntime_limit_s = 40.0\n[[scenario]]\nuse = "mall"\n[[global_planner]]\nuse = "dmrp.planner.cbs"\n'
  printf '[[pedestrian_model]]\nuse = "dmrp.pedestrian.social_force"\n'
  printf '[[local_controller]]\nuse = "%s"\n' dmrp.controller.pure_pursuit dmrp.controller.dwa bench.still bench.reader bench.fleet
} >"$scratch/call.toml"
"$host" "$scratch/call.toml" --quiet --jobs 1 --out "$scratch/run" || (($? == 1)) # robots that stand still fail
faults=$(sqlite3 -batch "$scratch/run/results.sqlite" "SELECT count(*) FROM fault")
((faults == 0)) || { echo "$faults faults" >&2 && exit 1; }
# medians, and the least of several readings: what else the machine does changes both little
PYTHONPATH=$here/../../sdk/python PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 - "$scratch/run" "$trace_dump" <<'END'
import subprocess
import sys
import time

import dmrp
import numpy as np
from dmrp import trace

CONTROL = 2  # DMRP_CALL_CONTROL


def row(name, taken, unit, reference):
    print(f"{name:30} {taken:10.2f} {unit} {taken / reference:8.1f}")


def reading_s(file):
    begin = time.process_time()
    read = trace.read(file)
    return time.process_time() - begin, len(read.t_ns)


run = dmrp.load(sys.argv[1])
medians = {}
for number, name in zip(run.trials["id"], run.trials["local_controller"]):
    calls = run.trial(number).trace.elements("calls")[1]
    medians[name] = np.median(calls["duration_ns"][calls["kind"] == CONTROL]) / 1e3
for name, median_us in medians.items():
    row(name, median_us, "us", next(iter(medians.values())))

file = max((run.path / "traces").glob("*.mcap"), key=lambda file: file.stat().st_size)
samples, native_s = subprocess.run([sys.argv[2], "--time", file], check=True, capture_output=True, text=True).stdout.split()
python_s, read = min(reading_s(file) for _ in range(5))
assert read == int(samples), (read, samples)
print(f"a trace of {read} samples, of 2,000:")
row("the reader in C++", float(native_s) / read * 2e6, "ms", float(native_s) / read * 2e6)
row("dmrp.trace.read()", python_s / read * 2e6, "ms", float(native_s) / read * 2e6)
END
