# SPDX-License-Identifier: MIT
"""Runs of dmrp-host as DataFrames. All numbers are the host's; nothing is computed again."""

from __future__ import annotations

import contextlib
import io
import json
import os
import sqlite3
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import pandas as pd

from .host import InputError, call_host
from .trace import Trace

WITH_FAULTS = 1  # the status of dmrp-host where a trial ended in a fault
CSV: dict[str, Any] = {"float_precision": "round_trip", "keep_default_na": False, "na_values": [""]}  # of the host
_NUMBERS = ("before", "after", "difference", "low", "high", "p", "p_holm")  # of a metric in `compare --json`


class Trial:
    """One trial of a run."""

    def __init__(self, run: Run, number: int) -> None:
        self.run = run
        self.number = number

    @property
    def trace(self) -> Trace:
        """Its trace, read anew at each use."""
        return Trace(self.run.path / "traces" / f"trial_{self.number:06d}.mcap")

    def _repr_html_(self) -> str:
        row = self.run.sql("SELECT * FROM trial WHERE id = ?", self.number)
        return str(row.T.to_html(header=False))

    def __repr__(self) -> str:
        return f"<Trial {self.number} of {self.run.path}>"


class Run:
    """A run directory."""

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self.path = Path(path)
        if not (self.path / "results.sqlite").is_file():
            raise InputError(f"{self.path}: is no run directory: it has no results.sqlite")

    @property
    def trials(self) -> pd.DataFrame:
        """A row a trial: labels, outcome, and the system's value of each metric, "completion_time [s]", ..."""
        return self.sql("SELECT * FROM trial_values ORDER BY id")

    @property
    def robots(self) -> pd.DataFrame:
        """A row a trial and robot: its value of each metric."""
        return self.sql("SELECT * FROM robot_values ORDER BY trial_id, robot")

    @property
    def events(self) -> pd.DataFrame:
        """A row an event of a metric: trial_id, metric, from_s, to_s, subjects, text, ..."""
        return self.sql("SELECT * FROM event ORDER BY trial_id, from_s")

    @property
    def faults(self) -> pd.DataFrame:
        """A row a fault of a plugin: trial_id, kind, plugin, function, step, robot, detail, ..."""
        return self.sql("SELECT * FROM fault ORDER BY trial_id")

    @property
    def metrics(self) -> pd.DataFrame:
        """A row a metric: name, unit, direction, description."""
        return self.sql("SELECT * FROM metric")

    def summary(self, metrics: Sequence[str] = ()) -> pd.DataFrame:
        """The rows of summary.csv: a combination and metric each, with mean, ci_low, ci_high and n, the number of tasks.
        `metrics`: these alone."""
        table = pd.read_csv(self.path / "summary.csv", **CSV)
        missing = [name for name in metrics if name not in set(table["metric"])]
        if missing:
            raise InputError(f"{self.path}: has no metric {missing[0]}")
        return table[table["metric"].isin(metrics)].reset_index(drop=True) if metrics else table

    def thresholds(self) -> pd.DataFrame:
        """A row a test with levels and combination: the level that is passed half of the time as threshold, ci_low, ci_high,
        infinite where it lies beyond the levels, and in words as `shown`; `levels` from the hardest to the easiest."""
        return pd.read_csv(io.StringIO(call_host(["export", self.path, "--thresholds"])), **CSV)

    def sql(self, query: str, *values: Any) -> pd.DataFrame:
        """The rows of a query of results.sqlite; ? stands for `values`."""
        with contextlib.closing(sqlite3.connect(f"{self._database().as_uri()}?mode=ro", uri=True)) as database:
            return pd.read_sql_query(query, database, params=list(values))

    def _database(self) -> Path:
        return (self.path / "results.sqlite").resolve()

    def compare(self, other: Run, metrics: Sequence[str] = (), *, by_combination: bool = False) -> pd.DataFrame:
        """This run, before, and the other, after, over the trials that both have, by `dmrp-host compare`.

        A row a metric (with `by_combination` a combination and metric): unit, pairs of trials, n, means `before` and `after`,
        `difference` (after - before) with ci_low and ci_high, `equal`, p and p_holm; NaN where there is none."""
        data = json.loads(self._compared(other, metrics, "--json"))
        after = data["runs"][0]
        parts = zip(after["combinations"], after["of_combinations"]) if by_combination else [({}, after["differences"])]
        units = {metric["name"]: metric["unit"] for metric in data["metrics"]}
        rows = [labels | {"unit": units[row["metric"]]} | row for labels, part in parts for row in part]
        columns = [*(after["combinations"][0] if by_combination else []), "metric", "unit", "pairs", "n", *_NUMBERS, "equal"]
        table = pd.DataFrame(rows).reindex(columns=columns).astype(dict.fromkeys(_NUMBERS, float))
        return table.rename(columns={"low": "ci_low", "high": "ci_high"})

    def compare_text(self, other: Run, metrics: Sequence[str] = ()) -> str:
        """What `dmrp-host compare` prints: compare() as a table, and what else differs between the runs."""
        return self._compared(other, metrics)

    def _compared(self, other: Run, metrics: Sequence[str], *options: str) -> str:
        chosen = [word for name in metrics for word in ("--metric", name)]
        return call_host(["compare", self.path, other.path, *chosen, *options])

    def trial(self, number: int) -> Trial:
        """Trial `number`, as the column id has it."""
        if self.sql("SELECT id FROM trial WHERE id = ?", number).empty:
            raise InputError(f"{self.path}: has no trial {number}")
        return Trial(self, number)

    def resume(self, **options: Any) -> Run:
        """Runs the trials that it lacks; the options are those of dmrp.run(). Relative paths of its experiment are
        looked up in `folder`, by default the working directory, as Experiment does."""
        folder = options.pop("folder", None) or Path.cwd()
        options.setdefault("trials", self._repetitions())
        text = (self.path / "experiment.toml").read_text()
        with tempfile.NamedTemporaryFile("w", suffix=".toml", prefix=".resumed-", dir=folder) as file:
            file.write(text)
            file.flush()
            return run(file.name, self.path, resume=True, **options)

    def _repetitions(self) -> int:
        manifest = json.loads((self.path / "manifest.json").read_text())
        return int(manifest["experiment"]["repetitions"])

    def _repr_html_(self) -> str:
        return str(self.summary()[["scenario", "metric", "unit", "mean", "ci_low", "ci_high", "n"]].to_html(index=False))

    def __repr__(self) -> str:
        return f"<Run {self.path}>"


def run(
    experiment: str | os.PathLike[str],
    out: str | os.PathLike[str] | None = None,
    *,
    jobs: int | None = None,
    trials: int | None = None,
    resume: bool = False,
    on_progress: Callable[[dict[str, Any]], None] | None = None,
) -> Run:
    """Runs an experiment file by dmrp-host, as `dmrp-host run` does.

    out: the run directory; without it runs/NAME, or runs/NAME-2, ...
    jobs: worker processes; trials: repetitions of each combination, instead of the file's
    on_progress: called after each trial with {"done", "total", "trial", "outcome"}

    An interrupt raises KeyboardInterrupt; finished trials are kept, and load(out).resume() continues."""
    arguments: list[str | os.PathLike[str]] = ["run", experiment, "--progress", "json"]
    for option, value in (("--out", out), ("--jobs", jobs), ("--trials", trials)):
        if value is not None:
            arguments += [option, os.fspath(value) if isinstance(value, os.PathLike) else str(value)]
    if resume:
        arguments.append("--resume")
    directory = ""

    def read_line(line: str) -> None:
        nonlocal directory
        content = json.loads(line)
        if "run_directory" in content:
            directory = content["run_directory"]
        elif on_progress:
            on_progress(content)

    call_host(arguments, statuses=(0, WITH_FAULTS), on_line=read_line)
    return Run(directory)


def load(path: str | os.PathLike[str]) -> Run:
    """The run in a directory."""
    return Run(path)
