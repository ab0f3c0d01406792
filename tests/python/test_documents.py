# SPDX-License-Identifier: MIT
"""The samples of docs/python.md run as they stand, and the package installs without a network."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

import notebook

TREE = Path(__file__).resolve().parents[2]


def test_the_samples_of_the_page_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("matplotlib")
    monkeypatch.chdir(tmp_path)
    samples = re.findall(r"^```python\n(.*?)^```", (TREE / "docs/python.md").read_text(), re.M | re.S)
    assert len(samples) == 6
    names: dict[str, object] = {}
    for sample in samples:
        exec(sample, names)
    assert {"completion_time.pdf", "trial.sqlite", "obsmat.txt"} <= {file.name for file in tmp_path.iterdir()}


def test_the_package_installs_into_an_environment(tmp_path: Path) -> None:
    pytest.importorskip("setuptools")
    pytest.importorskip("wheel")
    pytest.importorskip("pip")  # the system's: one of its own takes an environment four seconds
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    source = tmp_path / "python"
    subprocess.run(["cp", "-r", TREE / "sdk/python", source], check=True)  # setuptools writes beside its sources
    subprocess.run([sys.executable, "-m", "venv", "--system-site-packages", "--without-pip", tmp_path / "venv"], check=True)
    python = tmp_path / "venv/bin/python"
    install = [python, "-m", "pip", "install", "-q", "--no-build-isolation", "--no-index", "--no-deps", source]
    subprocess.run(install, check=True, env=environment)
    found = subprocess.run(
        [python, "-c", "import dmrp; print(dmrp.__file__)"],
        check=True, capture_output=True, text=True, env=environment, cwd=tmp_path,
    )  # fmt: skip
    assert str(tmp_path / "venv") in found.stdout


@pytest.mark.notebooks
@pytest.mark.parametrize("file", sorted((TREE / "docs/notebooks").glob("*.ipynb")), ids=lambda file: file.stem)
def test_a_notebook_has_the_outputs_that_it_gives(file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("matplotlib")
    monkeypatch.chdir(tmp_path)
    content = json.loads(file.read_text())
    stored = [cell["outputs"] for cell in content["cells"] if cell["cell_type"] == "code"]
    assert [notebook.texts_of(cell) for cell in notebook.outputs_of(content)] == [notebook.texts_of(cell) for cell in stored]
