# SPDX-License-Identifier: MIT
"""Runs that several tests read; each takes about a second."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import dmrp
import pytest


BRIEF: dict[str, object] = {"time_limit_s": 10.0}  # where a part of a trial will do


def small_experiment(**keys: object) -> dmrp.Experiment:
    """A crowd in the mall, for about a minute of simulated time."""
    content: dict[str, object] = {
        "seed": 1,
        "trials": 3,
        "scenario": [dmrp.use("mall", robots=2)],
        "global_planner": [dmrp.use("dmrp.planner.cbs", label="CBS")],
        "local_controller": [dmrp.use("dmrp.controller.dwa", params_file="controllers/tuned/dwa.toml")],
        "pedestrian_model": [dmrp.use("dmrp.pedestrian.social_force")],
    }
    return dmrp.Experiment(name="small", **(content | keys))


@pytest.fixture(scope="session")
def progress() -> list[dict[str, Any]]:
    """What on_progress was told of `run`."""
    return []


@pytest.fixture(scope="session")
def run(tmp_path_factory: pytest.TempPathFactory, progress: list[dict[str, Any]]) -> dmrp.Run:
    return small_experiment().run(tmp_path_factory.mktemp("runs") / "small", jobs=1, on_progress=progress.append)


@pytest.fixture(scope="session")
def trace_file(run: dmrp.Run) -> Path:
    return run.path / "traces" / "trial_000000.mcap"
