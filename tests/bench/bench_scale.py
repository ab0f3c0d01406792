#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""How the cost of a trial grows with its robots. Ratios of runs on this machine, so that machines compare.

    tests/bench/bench_scale.py DMRP_HOST [--quick] [--json]

scale/default_over_success    processor time with the default metrics over that with success alone, 400 robots, 10 s
scale/robot_tick              processor time a robot and control tick, 3,000 robots over 400, without set-up and planning
scale/memory                  peak memory of the largest process, 3,000 robots over 400
scale/metric/ID               processor time of a metric on a stored trace, 400 robots over 100; only those that take .05 s

Robots have 30 m2 each in a hall of racks, paths by PIBT and stop and wait; --quick takes a twentieth of them.
"""
import json
import math
import os
import re
import subprocess
import sys
import tempfile

EXPERIMENT = """[experiment]
name = "scale"
plugins = ["libdmrp_planners.so", "libdmrp_controllers.so", "libdmrp_metrics.so"]
[[scenario]]
use = "./hall.toml"
robots = {robots}
tasks = "drawn"
[[global_planner]]
use = "dmrp.planner.pibt"
[[local_controller]]
use = "dmrp.controller.stop_and_wait"
[simulation]
planning_body = "point"
time_limit_s = {seconds}
"""
NO_TRACES = '[record]\ntraces = "none"\n'
SUCCESS = NO_TRACES + '[[metric]]\nuse = "dmrp.metric.success"\n'
TICKS_PER_S = 10
NOTABLE_S = 0.05
NOISE_S = 0.01


def hall(robots):
    side_m = math.sqrt(30 * robots)
    text = f'[scenario]\nname = "hall"\nsize_m = [{side_m:.1f}, {side_m:.1f}]\n'
    rack = 0
    for column in range(int((side_m - 10) / 6)):
        for row in range(int((side_m - 8) / 16)):
            rack += 1
            text += f'[[box]]\nname = "rack {rack}"\ncenter_m = [{8 + 6 * column}, {14 + 16 * row}]\nsize_m = [2.4, 12.0]\n'
    return text


def cost(command):
    """Processor time in s and peak memory in kB."""
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    if os.waitstatus_to_exitcode(status) != 0:
        sys.exit(f"{' '.join(command)}: failed")
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss


def run(host, robots, seconds, tables, use=None):
    """Processor time and peak memory of a trial; `use` gets the run's folder before it is deleted."""
    with tempfile.TemporaryDirectory() as folder:
        with open(f"{folder}/hall.toml", "w") as file:
            file.write(hall(robots))
        with open(f"{folder}/scale.toml", "w") as file:
            file.write(EXPERIMENT.format(robots=robots, seconds=float(seconds)) + tables)
        taken = cost([host, "run", f"{folder}/scale.toml", "--out", f"{folder}/out", "--jobs", "1", "--quiet"])
        if use:
            use(f"{folder}/out")
        return taken


def metric_costs(host, robots, seconds):
    """Processor time of each metric on the trace of a trial: of `evaluate`, less that with the cheapest metric."""
    taken = {}

    def evaluate(folder):
        with open(f"{folder}/effective.toml") as file:
            metrics = re.findall(r'^use *= "(dmrp\.metric\.\w+)"', file.read(), re.MULTILINE)
        for metric in metrics:
            taken[metric], _ = cost([host, "evaluate", folder, "--metric", metric])

    run(host, robots, seconds, '[record]\ntraces = "all"\n', evaluate)
    least = min(taken.values())
    return {metric: of_metric_s - least for metric, of_metric_s in taken.items()}


def robot_tick(host, robots, seconds):
    """Processor time a robot and tick, and peak memory: of a long run less a short one, which has the same set-up."""
    short_s, _ = run(host, robots, 1, SUCCESS)
    long_s, memory = run(host, robots, 1 + seconds, SUCCESS)
    return (long_s - short_s) / (robots * seconds * TICKS_PER_S), memory


def main():
    arguments = [argument for argument in sys.argv[1:] if not argument.startswith("--")]
    options = set(sys.argv[1:]) - set(arguments)
    if len(arguments) != 1 or not options <= {"--quick", "--json"}:
        sys.exit(__doc__)
    host = arguments[0]
    some, many = (20, 150) if "--quick" in options else (400, 3000)
    default_s, _ = run(host, some, 10, NO_TRACES)
    success_s, _ = run(host, some, 10, SUCCESS)
    of_some, memory_of_some = robot_tick(host, some, 10)
    of_many, memory_of_many = robot_tick(host, many, 2)
    ratios = {
        "scale/default_over_success": default_s / success_s,
        "scale/robot_tick": of_many / of_some,
        "scale/memory": memory_of_many / memory_of_some,
    }
    of_fewer = metric_costs(host, some // 4, 10)
    for metric, seconds in metric_costs(host, some, 10).items():
        if seconds >= NOTABLE_S:
            ratios[f"scale/metric/{metric}"] = seconds / max(of_fewer[metric], NOISE_S)
    rows = [{"name": name, "value": round(value, 3), "unit": "1"} for name, value in ratios.items()]
    if "--json" in options:
        print(json.dumps(rows))
    else:
        for row in rows:
            print(f"{row['name']:44} {row['value']:8.3f}")


main()
