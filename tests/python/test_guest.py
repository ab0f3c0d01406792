# SPDX-License-Identifier: MIT
"""A Python file as a plugin library. Mistakes are told without the host; what takes the host seconds is nightly."""

from __future__ import annotations

import re
import sys
from pathlib import Path

import dmrp
import pytest
from conftest import CROSSING, small_experiment
from dmrp.guest import Guest
from dmrp.host import call_host

TREE = Path(__file__).resolve().parents[2]
PLUGINS = TREE / "tests/end_to_end/python"
POLICY = 'class Policy(dp.LocalController):\n  id = "a.b"\n'
MISTAKES = {
    "no_id": ("class Policy(dp.LocalController):\n  pass\n", "wrong.py:2: class Policy has no id"),
    "no_colon": ("class Policy(dp.LocalController)\n", "wrong.py:2: SyntaxError: expected ':'"),
    "import": ("import no_such_package\n", f"wrong.py:2: ModuleNotFoundError: .*'no_such_package' \\(by {sys.executable}\\)"),
    "default": (POLICY + '  gain = dp.number("x")\n', r"wrong.py:4: TypeError: number\(\): the default 'x' is no number"),
    "no_kind": (POLICY + '  gain = dp.colour("x")\n', "wrong.py:4: AttributeError: .* no attribute 'colour'"),
    "no_plugin": ("x = 1\n", "holds no plugin"),
    "zeros": ("\0\0\0", "SyntaxError|ValueError"),
}


@pytest.mark.parametrize("name", MISTAKES)
def test_a_mistake_is_one_line(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "path", sys.path[:])
    monkeypatch.setitem(sys.modules, "wrong", sys)  # which is forgotten afterwards
    text, message = MISTAKES[name]
    (tmp_path / "wrong.py").write_text("import dmrp.plugin as dp\n" + text)
    guest = Guest()
    assert guest.open(bytes(tmp_path / "wrong.py")) is None
    assert re.match(message, guest.text.decode()) and b"\n" not in guest.text


@pytest.mark.nightly
def test_an_endless_loop_is_a_hang(tmp_path: Path) -> None:
    """As end_to_end/python_plugins expects of other faults."""
    run = small_experiment(
        plugins=[str(PLUGINS / "faulty.py")],
        scenario=[dmrp.use(str(CROSSING))],
        local_controller=[dmrp.use("test.faulty", params={"fault": "loop"})],
        trials=1,
    ).run(tmp_path / "run", jobs=1)
    (fault,) = run.faults.to_dict("records")
    assert [fault[key] for key in ("kind", "plugin", "function", "step", "robot")] == ["hang", "test.faulty", "step", 50, 1]
    assert "did not return within" in fault["detail"]


@pytest.mark.nightly
def test_a_plugin_of_each_kind_in_the_mall(tmp_path: Path) -> None:
    run = small_experiment(
        plugins=[str(PLUGINS / "kinds.py")],
        scenario=[dmrp.use("mall", robots=4)],
        global_planner=[dmrp.use("test.planner")],
        pedestrian_model=[dmrp.use("test.crowd")],
        metric=[dmrp.use(name) for name in ("test.driven", "dmrp.metric.path_length", "dmrp.metric.success")],
        trials=1,
    ).run(tmp_path / "run", jobs=1)
    assert run.faults.empty and run.trials["success"][0] == 1.0
    assert run.robots["driven [m]"].to_numpy() == pytest.approx(run.robots["path_length [m]"].to_numpy(), abs=1e-12)
    call_host(["verify", run.path])
    call_host(["run", run.path / "experiment.toml", "--quiet", "--trials", "2", "--resume", "--out", run.path])
    assert len(dmrp.load(run.path).trials) == 2
    assert "3 pass, 0 warn, 0 fail, 0 crash" in call_host(["check", PLUGINS / "kinds.py"])


@pytest.mark.nightly
@pytest.mark.parametrize("kind", ["controller", "planner", "pedestrian-model", "metric"])
def test_a_template_runs_as_it_is_made(kind: str, tmp_path: Path) -> None:
    call_host(["new", kind, "--python", "--id", "org.example.my-own.my-thing", tmp_path / kind])
    made = tmp_path / kind / "my_thing.toml"
    made.write_text(made.read_text() + "[simulation]\ntime_limit_s = 10.0\n")
    call_host(["run", made, "--quiet", "--trials", "1", "--out", tmp_path / "run"])
    assert dmrp.load(tmp_path / "run").faults.empty


@pytest.mark.nightly
def test_the_example_of_a_pedestrian_model_is_valid() -> None:
    call_host(["validate", TREE / "examples/python_pedestrians/python_pedestrians.toml"])
