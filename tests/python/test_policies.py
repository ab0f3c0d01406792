# SPDX-License-Identifier: MIT
"""Policies by numpy and by torch repeat to the bit. Nightly: each guest imports torch for seconds."""

from __future__ import annotations

from pathlib import Path

import dmrp
import pytest
from conftest import BRIEF, small_experiment
from dmrp.host import call_host

HERE = Path(__file__).parent
POLICIES = [
    ("numpy", HERE.parents[1] / "examples/python_controller/policy.py", "org.example.policy"),
    ("torch", HERE / "torch_policy.py", "test.torch"),
]


@pytest.mark.nightly
@pytest.mark.parametrize(("package", "file", "policy"), POLICIES)
def test_a_policy_repeats_to_the_bit(package: str, file: Path, policy: str, tmp_path: Path) -> None:
    pytest.importorskip(package)
    mall = [dmrp.use("mall", robots=2)]
    experiment = small_experiment(
        plugins=[str(file)], scenario=mall, local_controller=[dmrp.use(policy)], trials=2, simulation=BRIEF
    )
    run = experiment.run(tmp_path / "run", jobs=1)
    assert run.faults.empty and (run.trial(0).trace.poses()["v_x"] != 0.0).any()
    call_host(["verify", run.path])
