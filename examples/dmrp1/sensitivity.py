#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""sensitivity.py RUNS: does the order of the controllers depend on what worlds.toml leaves perfect?

Runs the first nine tasks of each world with CBS, once as in worlds.toml and once for each condition below, into folders of
RUNS, and prints a table: the mean safe_sct of each controller, and how many of the six pairs of controllers change their
order, as many as tasks allow to say so and in all.
"""

import itertools
import math
import sys
import tomllib
from pathlib import Path

import dmrp
import pandas as pd

WORLDS = Path(__file__).resolve().parent / "worlds.toml"
CONDITIONS = {
    "as in worlds.toml": {},
    "commands 0.2 s late": {"simulation": {"control_latency_s": 0.2}},
    "the same, compensated": {
        "simulation": {"control_latency_s": 0.2},
        "navigation": {"compensate_latency": True},
    },
    "ranges with 3 cm of noise": {"robot": {"lidar": {"noise_sd_m": 0.03}}},
    "one beam of ten drops out": {"robot": {"lidar": {"dropout_share": 0.1}}},
    "odometry drifts, a fix each 2 s": {"robot": {"odometry": {"noise": [0.05, 0.05, 0.05, 0.05], "fix_period_s": 2.0}}},
    "people and robots tracked": {"simulation": {"tracking": "visible"}},
    "tracked, velocities 0.3 m/s off": {"simulation": {"tracking": "visible", "tracking_velocity_noise_sd": 0.3}},
    "local routes and monitor": {"navigation": {"route": "around", "monitor": True}},
    "tracked, routes and monitor": {
        "simulation": {"tracking": "visible"},
        "navigation": {"route": "around", "monitor": True},
    },
}


def experiment(condition: dict) -> dmrp.Experiment:
    keys = tomllib.loads(WORLDS.read_text())
    settings = keys.pop("experiment") | {"trials": 9, "name": "dmrp1-sensitivity"}
    keys["global_planner"] = [planner for planner in keys["global_planner"] if planner["label"] == "CBS"]
    for table, changes in condition.items():
        keys[table] = keys.get(table, {}) | changes
    return dmrp.Experiment(**settings, **keys)


def values(run: dmrp.Run) -> pd.DataFrame:
    """safe_sct by task and controller."""
    trials = run.trials
    trials = trials.assign(world=trials["scenario"].str.split(" ").str[0])
    return trials.pivot_table(index=["world", "repetition"], columns="local_controller", values="safe_sct")


def shown(difference: pd.Series) -> bool:
    """Whether a mean difference is further from 0 than two of its errors."""
    return abs(difference.mean()) > 2.0 * difference.std() / math.sqrt(len(difference))


def main() -> None:
    runs = Path(sys.argv[1])
    found = {}
    for number, (name, condition) in enumerate(CONDITIONS.items()):
        folder = runs / str(number)
        run = dmrp.load(folder) if folder.exists() else experiment(condition).run(folder, jobs=2)
        found[name] = values(run)
    baseline = found["as in worlds.toml"]
    controllers = list(baseline.columns)
    print("| condition |", " | ".join(controllers), "| pairs that change places | of them shown in both |")
    print("| --- |" + " ---: |" * (len(controllers) + 2))
    for name, table in found.items():
        changed = flipped = 0
        for one, other in itertools.combinations(controllers, 2):
            before, now = baseline[one] - baseline[other], table[one] - table[other]
            if before.mean() * now.mean() < 0.0:
                changed += 1
                flipped += shown(before) and shown(now)
        means = " | ".join(f"{mean:.3f}" for mean in table.mean())
        print(f"| {name} | {means} | {changed} | {flipped} |")


if __name__ == "__main__":
    main()
