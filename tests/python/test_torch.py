# SPDX-License-Identifier: MIT
"""A policy by torch repeats to the bit; without torch the test is skipped."""

from __future__ import annotations

from pathlib import Path

import dmrp
import pytest
from conftest import small_experiment
from dmrp.host import call_host


def test_a_torch_policy_repeats_to_the_bit(tmp_path: Path) -> None:
    pytest.importorskip("torch")
    run = small_experiment(
        plugins=[str(Path(__file__).with_name("torch_policy.py"))], local_controller=[dmrp.use("test.torch")], trials=2,
        simulation={"time_limit_s": 10.0},
    ).run(tmp_path / "run", jobs=1)  # fmt: skip
    assert run.faults.empty and (run.trial(0).trace.poses()["v_x"] != 0.0).any()
    call_host(["verify", run.path])
