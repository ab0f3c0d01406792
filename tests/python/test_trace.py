# SPDX-License-Identifier: MIT
"""The trace reader against the C++ reader's dump, to the bit."""

from __future__ import annotations

import os
import struct
import subprocess
from pathlib import Path
from typing import Any

import dmrp
import numpy as np
import pytest
from conftest import BRIEF, small_experiment
from dmrp import mcap, trace
from dmrp.fields import Elements, FieldList, array_of


def flat(value: Any) -> list[Any]:
    return [number for part in value for number in flat(part)] if isinstance(value, tuple) else [value]


def check_against_dump(file: Path) -> trace.Trace:
    read = trace.read(file)
    dump = subprocess.run([os.environ["TRACE_DUMP"], file], check=True, capture_output=True, text=True)
    lines: dict[str, list[list[str]]] = {"sample": [], "robot": [], "person": [], "contact": []}
    for line in dump.stdout.splitlines():
        kind, *words = line.split()
        lines[kind].append(words)
    samples = zip(read.t_ns.tolist(), read.dt_ns.tolist(), read.control_tick.tolist())
    assert [[str(number) for number in row] for row in samples] == lines["sample"]
    for kind, name, last in (("robot", "robots", -1), ("person", "people", -1), ("contact", "contacts", None)):
        elements = read.elements(name)[1].tolist()
        assert len(elements) == len(lines[kind])
        for element, words in zip(elements, lines[kind]):
            assert all(same(value, word) for value, word in zip(flat(element)[:last], words, strict=True))
    return read


def same(value: int | float, word: str) -> bool:
    if isinstance(value, int):
        return str(value) == word
    expected = float.fromhex(word)
    return (value != value and expected != expected) or struct.pack("<d", value) == struct.pack("<d", expected)


def check_trace(file: Path) -> trace.Trace:
    read = check_against_dump(file)
    assert read.is_whole and len(read.plans) >= 1
    assert len(read.poses()) == read.robots.size
    return read


def test_every_number_equals_the_dump(trace_file: Path, crowd_file: Path) -> None:
    check_trace(trace_file)
    read = check_trace(crowd_file)
    assert len(read.elements("people")[1]) == 1000 * len(read.t_ns) > 0


@pytest.mark.nightly
def test_every_number_of_shipped_worlds_equals_the_dump(tmp_path: Path) -> None:
    scenarios = [dmrp.use("mall", robots=2), dmrp.use("warehouse"), dmrp.use("office"), dmrp.use("hospital", people=1000)]
    run = small_experiment(scenario=scenarios, trials=1, simulation=BRIEF).run(tmp_path / "run", jobs=1)
    for trial in range(len(scenarios)):
        check_trace(run.trial(trial).trace.path)


def test_a_cut_file_gives_what_is_whole(crowd_file: Path, tmp_path: Path) -> None:
    whole = trace.read(crowd_file)
    data = crowd_file.read_bytes()
    cut = tmp_path / "cut.mcap"
    cut.write_bytes(data[: len(data) * 2 // 3])
    read = trace.read(cut)
    assert not read.is_whole and read.end is None
    assert 0 < len(read.t_ns) <= len(whole.t_ns)
    assert read.robots.tobytes() == whole.robots[: len(read.t_ns)].tobytes()


def test_libzstd_gives_what_zstandard_gives(trace_file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("zstandard")
    expected = trace.read(trace_file)
    monkeypatch.setattr(mcap, "decompressed", mcap._decompressed_by_library)
    assert trace.read(trace_file).robots.tobytes() == expected.robots.tobytes()


def test_appended_fields_are_skipped() -> None:
    fields = FieldList("pair: u32 a, u32 b\ninner: u32 c\nworld = 1: u32 x, elements pair pairs, block inner inner\n")
    pairs = struct.pack("<II", 2, 12) + struct.pack("<6I", 1, 2, 99, 3, 4, 99)
    body = struct.pack("<I", 7) + pairs + struct.pack("<3I", 8, 5, 99) + b"appended"
    name, record = fields.read(memoryview(struct.pack("<IB", len(body), 1) + body))
    assert name == "world" and record["x"] == 7 and record["inner"] == {"c": 5}
    part: Elements = record["pairs"]
    assert array_of([part], part.dtype).tolist() == [(1, 2), (3, 4)]


def test_a_file_that_is_no_trace_raises(tmp_path: Path) -> None:
    (tmp_path / "none.mcap").write_bytes(b"text")
    with pytest.raises(dmrp.TraceError, match="no MCAP file"):
        trace.read(tmp_path / "none.mcap")


def test_world_and_contacts_have_their_shapes(trace_file: Path) -> None:
    read = trace.read(trace_file)
    grid = read.world["planning_grid"]
    assert len(grid["free"]) == grid["width"] * grid["height"]
    assert {"kind", "depth_m", "impact_speed"} <= set(read.contacts().columns)
    assert np.all(np.diff(read.t_ns) > 0)
