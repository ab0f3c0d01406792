# SPDX-License-Identifier: MIT
"""The samples of docs/python.md run, nightly with a run of their own, and the package installs without a network."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import dmrp
import pytest

import notebook

TREE = Path(__file__).resolve().parents[2]


@pytest.mark.parametrize("is_run_given", [True, pytest.param(False, marks=pytest.mark.nightly)])
def test_the_samples_of_the_page_run(
    is_run_given: bool, run: dmrp.Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    plt = pytest.importorskip("matplotlib.pyplot")
    monkeypatch.chdir(tmp_path)
    samples = re.findall(r"^```python\n(.*?)^```", (TREE / "docs/python.md").read_text(), re.M | re.S)
    assert len(samples) == 6
    names: dict[str, object] = {}
    if is_run_given:
        given = lambda experiment, out, **options: dmrp.load(shutil.copytree(run.path, out))  # noqa: E731
        monkeypatch.setattr(dmrp.Experiment, "run", given)
    for sample in samples:
        exec(sample, names)
    plt.close("all")
    assert {"completion_time.pdf", "trial.sqlite", "obsmat.txt"} <= {file.name for file in tmp_path.iterdir()}


@pytest.mark.nightly
def test_the_package_installs_and_measures_without_the_host(tmp_path: Path, trace_file: Path) -> None:
    pytest.importorskip("setuptools")
    pytest.importorskip("wheel")
    pytest.importorskip("pip")  # the system's: one of its own takes an environment four seconds
    hidden = ("PYTHONPATH", "DMRP_ROOT")
    environment = {name: value for name, value in os.environ.items() if name not in hidden} | {"PATH": "/usr/bin:/bin"}
    source = tmp_path / "checkout/sdk/python"
    copied = ["cp", "-r", "--parents", "sdk/python", "sdk/include", "tests/abi", tmp_path / "checkout"]
    (tmp_path / "checkout").mkdir()
    subprocess.run(copied, check=True, cwd=TREE)  # setuptools writes beside its sources
    subprocess.run([sys.executable, "-m", "venv", "--system-site-packages", "--without-pip", tmp_path / "venv"], check=True)
    python = tmp_path / "venv/bin/python"
    install = [python, "-m", "pip", "install", "-q", "--no-build-isolation", "--no-index", "--no-deps", source]
    subprocess.run(install, check=True, env=environment)
    shutil.rmtree(tmp_path / "checkout")
    shutil.copy(TREE / "tests/python/metrics.py", tmp_path)
    program = f"import dmrp.trace, metrics; print(dmrp.__file__, dmrp.trace.read({str(trace_file)!r}).measure(metrics.Sto()))"
    found = subprocess.run(
        [python, "-c", program], check=True, capture_output=True, text=True, env=environment, cwd=tmp_path
    )
    assert str(tmp_path / "venv") in found.stdout and "own_sto" in found.stdout


@pytest.mark.nightly
@pytest.mark.parametrize("file", sorted((TREE / "docs/notebooks").glob("*.ipynb")), ids=lambda file: file.stem)
def test_a_notebook_has_the_outputs_that_it_gives(file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("matplotlib")
    monkeypatch.chdir(tmp_path)
    content = json.loads(file.read_text())
    stored = [cell["outputs"] for cell in content["cells"] if cell["cell_type"] == "code"]
    assert [notebook.texts_of(cell) for cell in notebook.outputs_of(content)] == [notebook.texts_of(cell) for cell in stored]
