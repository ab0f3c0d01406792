#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""measure.py RUNS [OUT]: writes the CSV files of docs/measured/paper from runs of examples/paper.

RUNS has a run directory for each experiment, by its file's name: `dmrp-host run examples/paper/table2.toml --out
RUNS/table2`, and so on; the file of an experiment without a run stays as it is. Needs the package dmrp with pandas, and
scipy.
"""

from __future__ import annotations

import hashlib
import json
import math
import sys
import tomllib
from pathlib import Path

import dmrp
import pandas as pd
from scipy.stats import t as student

HERE = Path(__file__).resolve().parent
CLAIMS = HERE / "claims.toml"
DRIVING = ["success", "path_length", "completion_time", "mean_speed", "speed_sd", "ibtr", "ldf", "pfd"]
TABLES = {
    "table2": ["planned_length", "planning_time", "sto", "sto_physical"],
    "table3_released": DRIVING,
    "table3_drawn": ["sto", *DRIVING],
    "table3_points": DRIVING,
    "table3_appendix": DRIVING,
    "table3_tuned": DRIVING,
}


def head_of(run: dmrp.Run) -> str:
    """Where the numbers come from: the experiment, its commit and digest, and the claims that stood before it ran."""
    manifest = json.loads((run.path / "manifest.json").read_text())
    claims = hashlib.sha256(CLAIMS.read_bytes()).hexdigest()
    return f"# commit {manifest['commit']}, experiment {manifest['digest'][:16]}, claims {claims[:16]}\n"


def write(file: Path, run: dmrp.Run, rows: pd.DataFrame) -> None:
    text = rows.to_csv(index=False, float_format="%.6g", lineterminator="\n")
    file.write_text(head_of(run) + text)
    print(f"{file}: {len(rows)} rows")


def table(run: dmrp.Run, metrics: list[str]) -> pd.DataFrame:
    columns = ["scenario", "global_planner", "local_controller", "metric", "unit", "n", "mean", "median", "ci_low", "ci_high"]
    return run.summary(metrics)[columns]


def trials_of(run: dmrp.Run) -> pd.DataFrame:
    """The run's trials with their world and a column for each swept key."""
    swept = run.sql('SELECT trial_id AS id, "key", value FROM swept')
    without_units = run.trials.rename(columns=lambda column: column.split(" [")[0])
    trials = without_units.join(swept.pivot(index="id", columns="key", values="value"), on="id")
    return trials.assign(world=trials["scenario"].str.split(" ").str[0])


def differences(trials: pd.DataFrame, claim: dict) -> pd.Series:
    """By world and repetition: the mean of the trials on one side minus that on the other."""

    def means(keys: dict[str, list[str]]) -> pd.Series:
        side = trials
        for key, values in keys.items():
            side = side[side[key].isin(values)]
        return side.groupby(["world", "repetition"])[claim["metric"]].mean()

    return (means(claim["plus"]) - means(claim["minus"])).dropna()


def interval(values: pd.Series, level: float) -> tuple[float, float, float]:
    """The mean over worlds of their means, with Student's interval."""
    worlds = values.groupby(level=0)
    mean = worlds.mean().mean()
    error = math.sqrt((worlds.var(ddof=1) / worlds.count()).sum()) / len(worlds)
    reach = student.ppf(0.5 + level / 2, len(values) - len(worlds)) * error
    return mean, mean - reach, mean + reach


def verdict(claim: dict, low: float, high: float) -> str:
    smallest = claim["smallest_effect"]
    if -smallest <= low and high <= smallest:
        return "equivalent"
    if low > 0.0 or high < 0.0:
        claimed = (low > 0.0) == (claim["claimed"] == "above")
        if not claimed:
            return "the opposite observed here"
        return "observed here, robust" if claim["per"] == "task" else "observed here"
    return "not shown"


def settled(runs: Path, claims: list[dict]) -> pd.DataFrame:
    level = 1.0 - 0.05 / len(claims)
    rows = []
    for claim in claims:
        values = differences(trials_of(dmrp.load(runs / claim["experiment"])), claim)
        mean, low, high = interval(values, level)
        rows.append(
            {
                "claim": claim["id"],
                "experiment": claim["experiment"],
                "per": claim["per"],
                "n": len(values),
                "mean": mean,
                "low": low,
                "high": high,
                "sd": values.groupby(level=0).transform(lambda group: group - group.mean()).std(ddof=1),
                "verdict": verdict(claim, low, high),
            }
        )
    return pd.DataFrame(rows)


def typical(runs: Path) -> pd.DataFrame:
    """The listed mall, planned by CBS, among the mall's drawn tasks."""
    rows = []
    for metric in ("sto", "ldf"):

        def of_mall(name: str) -> pd.Series:
            trials = trials_of(dmrp.load(runs / name))
            trials = trials[(trials["world"] == "mall") & (trials["global_planner"] == "CBS")]
            return trials.groupby("repetition")[metric].mean().dropna()

        listed, drawn = of_mall("table3_appendix").mean(), of_mall("drawn")
        rows.append({"metric": metric, "listed": listed, "drawn": drawn.mean(), "tasks": len(drawn)})
        rows[-1]["tasks_above"] = int((drawn >= listed).sum())
    return pd.DataFrame(rows)


def dispatched(runs: Path) -> pd.DataFrame:
    """Means of each dispatch, with and without the planner's loop."""
    keys = ["local_controller", "dispatch", "replan_period_s"]
    values = {"n": ("success", "size"), "success": ("success", "mean"), "arrived_n": ("completion_time", "count")}
    groups = trials_of(dmrp.load(runs / "dispatch")).groupby(keys)
    return groups.agg(**values, completion_time=("completion_time", "mean")).reset_index()


def main() -> None:
    runs = Path(sys.argv[1])
    out = Path(sys.argv[2]) if len(sys.argv) > 2 else HERE.parents[1] / "docs" / "measured" / "paper"
    out.mkdir(parents=True, exist_ok=True)
    claims = tomllib.loads(CLAIMS.read_text())["claim"]
    files = {name: (lambda name=name: table(dmrp.load(runs / name), TABLES[name]), [name]) for name in TABLES}
    files |= {
        "dispatch": (lambda: dispatched(runs), ["dispatch"]),
        "typical": (lambda: typical(runs), ["drawn", "table3_appendix"]),
        "claims": (lambda: settled(runs, claims), sorted({claim["experiment"] for claim in claims})),
    }
    for name, (rows, needed) in files.items():
        if all((runs / experiment).is_dir() for experiment in needed):
            write(out / f"{name}.csv", dmrp.load(runs / needed[0]), rows())


if __name__ == "__main__":
    main()
