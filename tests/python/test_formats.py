# SPDX-License-Identifier: MIT
"""Formats of other programs: what is written equals the trace to the bit, what is read comes back."""

from __future__ import annotations

import os
import sqlite3
from pathlib import Path

import dmrp
import numpy as np
import pandas as pd
import pytest
from conftest import SUCCESS, small_experiment
from dmrp import formats, plans, trace


def test_pedpys_queries_give_the_positions_to_the_bit(trace_file: Path, tmp_path: Path) -> None:
    read = trace.read(trace_file)
    formats.write_pedpy(read, tmp_path / "t.sqlite")
    with sqlite3.connect(tmp_path / "t.sqlite") as database:
        assert database.execute("SELECT value FROM metadata WHERE key = 'version'").fetchone() == ("2",)
        assert database.execute("SELECT value FROM metadata WHERE key = 'fps'").fetchone() == ("50.0",)
        rows = pd.read_sql_query("SELECT frame, id, pos_x AS x, pos_y AS y FROM trajectory_data", database)
    people = rows[rows["id"] < formats.FIRST_ROBOT_ID]
    robots = rows[rows["id"] >= formats.FIRST_ROBOT_ID]
    for found, expected in ((people, read.people()), (robots, read.poses())):
        assert found["x"].tolist() == expected["x"].tolist()
        assert found["y"].tolist() == expected["y"].tolist()
    assert people["id"].tolist() == read.people()["id"].tolist()
    with pytest.raises(dmrp.InputError, match="exists"):
        formats.write_pedpy(read, tmp_path / "t.sqlite")


def test_poses_as_csv_keep_all_digits(trace_file: Path, tmp_path: Path) -> None:
    read = trace.read(trace_file)
    formats.write_poses(read, tmp_path / "poses.csv")
    back = pd.read_csv(tmp_path / "poses.csv", float_precision="round_trip")
    assert back["x"].tolist() == read.poses()["x"].tolist()


def test_eth_to_recording_to_eth_is_the_identity(tmp_path: Path) -> None:
    people = pd.DataFrame(
        {"time": [0.0, 0.4, 0.4], "id": [1, 1, 2], "x": [0.1, 1 / 3, 5.0], "y": [2.0, 2.5, -1e-9]}
        | {"v_x": [0.0, 0.5, 0.1], "v_y": [1.0, 0.25, 0.7]}
    )
    formats.write_obsmat(people, tmp_path / "obsmat.txt", 15.0)
    first = formats.read_obsmat(tmp_path / "obsmat.txt", 15.0)
    formats.write_recording(first, tmp_path / "recording.csv")
    recording = formats.read_recording(tmp_path / "recording.csv")
    formats.write_obsmat(recording.join(first[["v_x", "v_y"]]), tmp_path / "again.txt", 15.0)
    assert (tmp_path / "again.txt").read_text() == (tmp_path / "obsmat.txt").read_text()
    assert first["x"].tolist() == people["x"].tolist() and first["v_y"].tolist() == people["v_y"].tolist()


def test_trajnet_comes_back(tmp_path: Path) -> None:
    people = pd.DataFrame({"time": [0.0, 0.4, 0.4], "id": [1, 1, 2], "x": [0.1, 1 / 3, 5.0], "y": [2.0, 2.5, -1.0]})
    formats.write_trajnet(people, tmp_path / "t.ndjson")
    assert formats.read_trajnet(tmp_path / "t.ndjson").equals(people)
    (tmp_path / "bad.ndjson").write_text('{"track": {"f": 1}}\n')
    with pytest.raises(dmrp.InputError, match="bad.ndjson:1"):
        formats.read_trajnet(tmp_path / "bad.ndjson")


def test_smart_waits_between_places(tmp_path: Path) -> None:
    (tmp_path / "paths.txt").write_text("Agent 0:(1,2,0)->(2,2,1)->(2,3,4)->\nAgent 1:(0,0,0)->\n")
    read = plans.read_smart(tmp_path / "paths.txt")
    assert read == [[(1, 2), (2, 2), (2, 2), (2, 2), (2, 3)], [(0, 0)]]
    formats.write_plan(read, tmp_path / "plan.csv")
    assert (tmp_path / "plan.csv").read_text().splitlines()[:3] == ["agent,t,x,y", "0,0,1,2", "0,1,2,2"]
    assert plans.read_smart(tmp_path / "paths.txt", flip_height=5)[1] == [(0, 4)]
    (tmp_path / "paths.txt").write_text("Agent 1:(1,2,0)->\n")
    with pytest.raises(dmrp.InputError, match="paths.txt:1"):
        plans.read_smart(tmp_path / "paths.txt")


def test_tracker_moves_from_the_starts(tmp_path: Path) -> None:
    (tmp_path / "a.scen").write_text("version 1\n0\tm.map\t9\t9\t3\t4\t5\t4\t2\n")
    (tmp_path / "solution.txt").write_text("rruwdl\n")
    starts = plans.starts_of(tmp_path / "a.scen", 1)
    assert plans.read_tracker(tmp_path / "solution.txt", starts) == [
        [(3, 4), (4, 4), (5, 4), (5, 5), (5, 5), (5, 4), (4, 4)]
    ]
    with pytest.raises(dmrp.InputError, match="none of u, d, l, r, w"):
        (tmp_path / "solution.txt").write_text("x\n")
        plans.read_tracker(tmp_path / "solution.txt", starts)


def test_plans_of_tasks_have_a_column(tmp_path: Path) -> None:
    formats.write_plan({"0123456789abcdef": [[(1, 2), (1, 3)]]}, tmp_path / "plan.csv")
    assert (tmp_path / "plan.csv").read_text() == "task,agent,t,x,y\n0123456789abcdef,0,0,1,2\n0123456789abcdef,0,1,1,3\n"


def test_plans_of_a_solver_are_driven(tmp_path: Path) -> None:
    """From a run to its tasks, to plans, to a run with the same poses: CBS stands for the solver."""
    drawn: dict[str, object] = {"scenario": [dmrp.use("mall", robots=2, tasks="drawn")], "metric": SUCCESS}
    drawn["simulation"] = {"time_limit_s": 3.0}
    run = small_experiment(**drawn).run(tmp_path / "run", jobs=1)
    solved = {}
    for _, row in run.trials.iterrows():
        trace = run.trial(int(row["id"])).trace
        task = plans.task_of(trace)
        grid = trace.world["planning_grid"]
        paths = []
        for path in trace.plans[0]["paths"]:
            x = np.rint((path["waypoints"]["x"] - grid["origin"][0]) / grid["resolution_m"] - 0.5).astype(int)
            y = np.rint((path["waypoints"]["y"] - grid["origin"][1]) / grid["resolution_m"] - 0.5).astype(int)
            paths.append(list(zip(x.tolist(), (grid["height"] - 1 - y).tolist())))
        assert [path[0] for path in paths] == task.starts
        assert [[path[-1]] for path in paths] == task.goals
        assert all(task.free[y, x] for path in paths for x, y in path)
        solved[row["task"]] = paths
    assert len(solved) == 2
    formats.write_plan(solved, tmp_path / "solver.csv")
    planner = [dmrp.use(file=tmp_path / "solver.csv")]
    again = small_experiment(global_planner=planner, **drawn).run(tmp_path / "again", jobs=1)
    assert set(again.trials["global_planner"]) == {"solver"}
    for trial in range(len(run.trials)):
        assert again.trial(trial).trace.poses().equals(run.trial(trial).trace.poses())


def test_plans_of_smart_and_of_the_tracker_are_driven(tmp_path: Path) -> None:
    (tmp_path / "open.map").write_text("type octile\nheight 6\nwidth 8\nmap\n" + "........\n" * 6)
    (tmp_path / "open.scen").write_text("version 1\n0\topen.map\t8\t6\t1\t1\t3\t1\t2\n0\topen.map\t8\t6\t1\t4\t2\t4\t1\n")
    (tmp_path / "hall").mkdir()
    (tmp_path / "hall" / "scenario.toml").write_text(
        '[scenario]\nname = "hall"\ntitle = "Hall"\ndescription = "an open map"\n'
        '[map]\nfile = "../open.map"\n[robots]\nscen = "../open.scen"\ncount = 2\n'
    )
    (tmp_path / "smart.txt").write_text("Agent 0:(1,1,0)->(2,1,1)->(3,1,2)->\nAgent 1:(1,4,0)->(2,4,1)->\n")
    (tmp_path / "tracker.txt").write_text("rr\nr\n")
    smart = plans.read_smart(tmp_path / "smart.txt")
    tracker = plans.read_tracker(tmp_path / "tracker.txt", plans.starts_of(tmp_path / "open.scen", 2))
    assert smart == tracker
    formats.write_plan(smart, tmp_path / "plan.csv")
    hall = [dmrp.use(os.fspath(tmp_path / "hall" / "scenario.toml"))]
    planner = [dmrp.use(file=tmp_path / "plan.csv")]
    made = small_experiment(scenario=hall, global_planner=planner, trials=1).run(tmp_path / "run", jobs=1)
    assert made.trials["outcome"].tolist() == ["succeeded"]
