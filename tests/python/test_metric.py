# SPDX-License-Identifier: MIT
"""Metrics in Python, in a run and of its stored traces."""

from __future__ import annotations

from pathlib import Path

import dmrp
import metrics
import numpy as np
import pytest
from conftest import BRIEF, small_experiment


@pytest.fixture(scope="module")
def measured(tmp_path_factory: pytest.TempPathFactory) -> dmrp.Run:
    names = ["test.sto", "test.shown", "test.unpopulated", "dmrp.metric.sto"]
    experiment = small_experiment(
        plugins=[str(Path(metrics.__file__))], scenario=[dmrp.use("mall", robots=4)], trials=2,
        metric=[dmrp.use(name) for name in names],
        simulation=BRIEF,
    )  # fmt: skip
    return experiment.run(tmp_path_factory.mktemp("runs") / "measured", jobs=1)


def of_robots(run: dmrp.Run, metric: str) -> np.ndarray:
    rows = run.sql(
        "SELECT value FROM value WHERE metric = ? AND subject_kind IN ('robot', 'system') "
        "ORDER BY trial_id, subject_kind, subject", metric,
    )  # fmt: skip
    return rows["value"].to_numpy(float)


def test_sto_equals_the_built_in_one(measured: dmrp.Run) -> None:
    assert measured.faults.empty
    expected = of_robots(measured, "sto")
    assert len(expected) == 10 and 0.0 < expected.max() <= 1.0
    assert np.abs(of_robots(measured, "own_sto") - expected).max() <= 1e-12


def test_a_stored_trace_gives_what_the_run_gave(measured: dmrp.Run) -> None:
    given = [measured.trial(trial).trace.measure(metrics.Sto())["own_sto"] for trial in range(2)]
    values = [value for one in given for value in (*one["robot"], one["system"])]
    assert values == list(of_robots(measured, "own_sto"))


def test_a_stored_trace_shows_what_the_run_shows(measured: dmrp.Run, capsys: pytest.CaptureFixture[str]) -> None:
    live = [line for line in (measured.path / "log.txt").read_text().splitlines() if "shown: " in line]
    for trial in range(2):
        assert measured.trial(trial).trace.measure(metrics.Unpopulated()) == {"people_shown": 0}
        measured.trial(trial).trace.measure(metrics.Shown())
    stored = capsys.readouterr().out.splitlines()
    assert len(stored) > 1000
    assert stored == [line[line.index("shown: ") :] for line in live]


def test_parameters_offline_are_attributes(measured: dmrp.Run) -> None:
    metric = metrics.Sto()
    assert (metric.distance_m, metric.window) == (0.5, 2)
    metric.distance_m = 100.0
    assert measured.trial(0).trace.measure(metric)["own_sto"]["system"] == 1.0


def test_a_cut_trace_is_not_measured(crowd_file: Path, tmp_path: Path) -> None:
    data = crowd_file.read_bytes()
    (tmp_path / "cut.mcap").write_bytes(data[: len(data) * 2 // 3])
    with pytest.raises(dmrp.TraceError, match="no end"):
        dmrp.trace.read(tmp_path / "cut.mcap").measure(metrics.Sto())
