# SPDX-License-Identifier: MIT
"""Runs that several tests read."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import dmrp
import pytest


BRIEF: dict[str, object] = {"time_limit_s": 10.0}  # where a part of a trial will do
SUCCESS = [dmrp.use("dmrp.metric.success")]  # where values do not matter
CROSSING = Path(__file__).resolve().parents[1] / "end_to_end/worlds/crossing"


def small_experiment(**keys: object) -> dmrp.Experiment:
    """One and two robots in the smallest world, where they arrive after some ten seconds of simulated time."""
    content: dict[str, object] = {
        "seed": 1,
        "trials": 2,
        "scenario": [dmrp.use(str(CROSSING), robots=[1, 2], people=4)],
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
    """Of a trial of two robots."""
    return run.path / "traces" / "trial_000003.mcap"


@pytest.fixture(scope="session")
def crowd_file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A trace of several chunks: a thousand people for half a second."""
    office = dmrp.use("office", people=1000)
    crowd = small_experiment(scenario=[office], trials=1, simulation={"time_limit_s": 0.5}, metric=SUCCESS)
    return crowd.run(tmp_path_factory.mktemp("runs") / "crowd", jobs=1).path / "traces" / "trial_000000.mcap"
