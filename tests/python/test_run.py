# SPDX-License-Identifier: MIT
"""Runs as data: the findings' own numbers, input errors, interrupted runs."""

from __future__ import annotations

import csv
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import dmrp
import pytest
from conftest import small_experiment


def test_summary_equals_the_file_cell_by_cell(run: dmrp.Run) -> None:
    summary = run.summary()
    with (run.path / "summary.csv").open() as file:
        rows = list(csv.reader(file))
    assert list(summary.columns) == rows[0]
    assert len(summary) == len(rows) - 1
    for (_, row), cells in zip(summary.iterrows(), rows[1:]):
        for value, cell in zip(row, cells):
            if cell == "":
                assert value != value
            elif isinstance(value, str):
                assert value == cell
            else:
                assert value == float(cell)


def test_trials_and_robots_have_a_row_each(run: dmrp.Run) -> None:
    assert list(run.trials["id"]) == [0, 1, 2, 3]
    assert "completion_time [s]" in run.trials.columns
    assert len(run.robots) == 6
    assert run.faults.empty
    assert run.sql("SELECT count(*) AS n FROM trial WHERE id < ?", 1)["n"][0] == 1


def test_a_mistyped_key_raises_the_hosts_line(tmp_path: Path) -> None:
    with pytest.raises(dmrp.InputError, match="trails") as raised:
        small_experiment(simulation={"trails": 1}).run(tmp_path / "run")
    assert "\n" not in str(raised.value)


def test_a_directory_that_is_no_run_raises(tmp_path: Path) -> None:
    with pytest.raises(dmrp.InputError, match="no run directory"):
        dmrp.load(tmp_path)


def test_a_resumed_run_equals_an_uninterrupted_one(run: dmrp.Run, tmp_path: Path) -> None:
    def interrupt(progress: dict[str, Any]) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        small_experiment().run(tmp_path / "cut", jobs=1, on_progress=interrupt)
    cut = dmrp.load(tmp_path / "cut")
    assert 1 <= len(cut.trials) < 4
    resumed = cut.resume(jobs=1)
    values = (
        "SELECT value.* FROM value JOIN metric ON metric = name WHERE wall_clock = 0 "
        "ORDER BY trial_id, metric, subject_kind, subject, coordinate"
    )
    assert resumed.sql(values).equals(run.sql(values))
    for trial in range(4):
        assert resumed.trial(trial).trace.robots.tobytes() == run.trial(trial).trace.robots.tobytes()


def test_a_comparison_has_the_hosts_numbers(run: dmrp.Run, tmp_path: Path) -> None:
    shutil.copytree(run.path, tmp_path / "other")
    forge = Path(__file__).resolve().parents[1] / "end_to_end" / "forge.py"
    change = "UPDATE value SET value = value + 1 WHERE metric = 'pfd' AND subject_kind = 'system'"
    subprocess.run([sys.executable, forge, tmp_path / "other" / "results.sqlite", change], check=True)
    other = dmrp.load(tmp_path / "other")
    (row,) = run.compare(other, metrics=["pfd"]).to_dict("records")
    assert (row["metric"], row["unit"], row["pairs"], row["n"], row["equal"]) == ("pfd", "m", 4, 2, False)
    assert row["difference"] == pytest.approx(1.0) and row["before"] == pytest.approx(run.summary(metrics=["pfd"])["mean"].mean())
    table = run.compare(other, by_combination=True)
    assert len(table) == 2 * len(run.compare(other)) and set(table["scenario"]) == {"crossing"}
    assert table.set_index("metric")["equal"]["success"].all() and table["p"].dtype == float
    for name in ("success", "pfd"):
        assert name in run.compare_text(other, metrics=["success", "pfd"])
    with pytest.raises(dmrp.InputError, match="was not measured"):
        run.compare(other, metrics=["sucess"])


def test_progress_counts_trials(run: dmrp.Run, progress: list[dict[str, Any]]) -> None:
    assert [(line["done"], line["total"], line["trial"]) for line in progress] == [(n + 1, 4, n) for n in range(4)]
    assert [line["outcome"] for line in progress] == list(run.trials["outcome"])
