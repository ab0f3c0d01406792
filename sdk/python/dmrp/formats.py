# SPDX-License-Identifier: MIT
"""Traces in the formats of other programs."""

from __future__ import annotations

import json
import os
import sqlite3
from collections.abc import Iterable, Mapping
from pathlib import Path

import numpy as np
import pandas as pd

from .host import InputError
from .trace import Trace

FIRST_ROBOT_ID = 1_000_000  # robots' ids in files that number all bodies alike
OBSMAT_FRAMES_PER_S = 2.5


def write_poses(trace: Trace, file: str | os.PathLike[str]) -> None:
    """poses() as CSV, with all digits."""
    trace.poses().to_csv(file, index=False)


def write_pedpy(trace: Trace, file: str | os.PathLike[str]) -> None:
    """A JuPedSim database of version 2, as PedPy reads it: people by their ids, robots from id 1,000,000.

    A frame is a sample; positions are in metres, the geometry is the world's rectangle without its shapes."""
    path = Path(file)
    if path.exists():
        raise InputError(f"{path}: exists")
    people = trace.elements("people")
    x, y = _flat(people[1], "position")
    v_x, v_y = _flat(people[1], "velocity")
    speed = np.hypot(v_x, v_y)
    moving = np.where(speed > 0, speed, 1.0)
    rows = list(zip(people[0].tolist(), _ids(people[1]), x, y, (v_x / moving).tolist(), (v_y / moving).tolist()))
    sample, robots = trace.elements("robots")
    pose = robots["pose"]
    numbers = FIRST_ROBOT_ID + np.tile(np.arange(trace.robots.shape[1]), len(trace.t_ns))
    heading = np.cos(pose["theta"]), np.sin(pose["theta"])
    rows += zip(*(column.tolist() for column in (sample, numbers, pose["x"], pose["y"], *heading)))
    (x0, y0), (x1, y1) = trace.world["lower"], trace.world["upper"]
    wkt = f"POLYGON (({x0!r} {y0!r}, {x1!r} {y0!r}, {x1!r} {y1!r}, {x0!r} {y1!r}, {x0!r} {y0!r}))"
    metadata = {"version": "2", "fps": repr(1e9 / trace.world["step_ns"])}
    metadata |= {"xmin": repr(x0), "xmax": repr(x1), "ymin": repr(y0), "ymax": repr(y1)}
    database = sqlite3.connect(path)
    with database:
        database.execute(
            "CREATE TABLE trajectory_data (frame INTEGER NOT NULL, id INTEGER NOT NULL, pos_x REAL NOT NULL, "
            "pos_y REAL NOT NULL, ori_x REAL NOT NULL, ori_y REAL NOT NULL)"
        )
        database.execute("CREATE TABLE metadata (key TEXT NOT NULL UNIQUE, value TEXT NOT NULL)")
        database.execute("CREATE TABLE geometry (hash INTEGER NOT NULL, wkt TEXT NOT NULL)")
        database.execute("CREATE TABLE frame_data (frame INTEGER NOT NULL, geometry_hash INTEGER NOT NULL)")
        database.executemany("INSERT INTO trajectory_data VALUES (?, ?, ?, ?, ?, ?)", rows)
        database.executemany("INSERT INTO metadata VALUES (?, ?)", metadata.items())
        database.execute("INSERT INTO geometry VALUES (1, ?)", (wkt,))
        database.executemany("INSERT INTO frame_data VALUES (?, 1)", ((i,) for i in range(len(trace.t_ns))))
        database.execute("CREATE INDEX frame_id_idx ON trajectory_data (frame, id)")
    database.close()


def _flat(elements: np.ndarray, field: str) -> tuple[list[float], list[float]]:  # type: ignore[type-arg]
    names = elements.dtype[field].names or ()
    first, second = (elements[field][name].tolist() for name in names[:2])
    return first, second


def _ids(people: np.ndarray) -> list[int]:  # type: ignore[type-arg]
    return [int(identity) for identity in people["id"]]


def read_obsmat(file: str | os.PathLike[str], frames_per_s: float) -> pd.DataFrame:
    """People of an ETH file obsmat.txt: time (s), id, x, y (m), v_x, v_y (m/s).

    frames_per_s: of its frame numbers; ETH's video has 15, of which every sixth is annotated."""
    rows = np.loadtxt(file, ndmin=2)
    if rows.shape[1] != 8:
        raise InputError(f"{os.fspath(file)}: has {rows.shape[1]} columns, not frame id x z y v_x v_z v_y")
    names = {"x": 2, "y": 4, "v_x": 5, "v_y": 7}
    return pd.DataFrame(
        {"time": rows[:, 0] / frames_per_s, "id": rows[:, 1].astype(np.int64)}
        | {name: rows[:, column] for name, column in names.items()}
    )


def write_obsmat(people: pd.DataFrame, file: str | os.PathLike[str], frames_per_s: float) -> None:
    """The inverse of read_obsmat()."""
    frames = np.rint(people["time"].to_numpy() * frames_per_s).astype(np.int64)
    zero = np.zeros(len(people))
    with open(file, "w", encoding="ascii") as out:
        columns = (frames, people["id"], people["x"], zero, people["y"], people["v_x"], zero, people["v_y"])
        for row in zip(*columns):
            out.write(" ".join(repr(value.item() if hasattr(value, "item") else value) for value in row) + "\n")


def read_trajnet(file: str | os.PathLike[str], frames_per_s: float = OBSMAT_FRAMES_PER_S) -> pd.DataFrame:
    """Tracks of a trajnet++ file: time (s), id, x, y (m), as `[[recording]]` files have them."""
    rows = []
    for number, line in enumerate(Path(file).read_text().splitlines(), 1):
        try:
            track = json.loads(line).get("track")
            if track:
                rows.append((track["f"] / frames_per_s, track["p"], track["x"], track["y"]))
        except (ValueError, KeyError, AttributeError) as error:
            raise InputError(f"{os.fspath(file)}:{number}: is no line of trajnet++: {error}") from None
    return pd.DataFrame(rows, columns=["time", "id", "x", "y"])


def write_trajnet(
    people: pd.DataFrame, file: str | os.PathLike[str], frames_per_s: float = OBSMAT_FRAMES_PER_S
) -> None:
    """Tracks for trajnet++, with one scene for each person: all frames in which it is present."""
    frames = np.rint(people["time"].to_numpy() * frames_per_s).astype(np.int64)
    with open(file, "w", encoding="ascii") as out:
        for scene, (person, rows) in enumerate(people.assign(frame=frames).groupby("id", sort=True)):
            extent = {"id": scene, "p": int(person), "s": int(rows["frame"].min()), "e": int(rows["frame"].max())}
            out.write(json.dumps({"scene": extent | {"fps": frames_per_s, "tag": 0}}) + "\n")
        for frame, person, x, y in zip(frames.tolist(), people["id"], people["x"].tolist(), people["y"].tolist()):
            out.write(json.dumps({"track": {"f": frame, "p": int(person), "x": x, "y": y}}) + "\n")


def write_recording(people: pd.DataFrame, file: str | os.PathLike[str]) -> None:
    """People as the CSV of a scenario's `[[recording]]`: time,id,x,y."""
    people[["time", "id", "x", "y"]].to_csv(file, index=False)


def read_recording(file: str | os.PathLike[str]) -> pd.DataFrame:
    """The inverse of write_recording()."""
    return pd.read_csv(file, float_precision="round_trip")


Paths = Iterable[Iterable[tuple[int, int]]]


def write_plan(paths: Paths | Mapping[str, Paths], file: str | os.PathLike[str]) -> None:
    """Paths in cells, for each agent (x, y) at step 0, 1, ..., y from the top, as the CSV agent,t,x,y.

    With a mapping of tasks (the column `task` of Run.trials) to paths the CSV has a column `task`, too."""
    of_tasks = paths if isinstance(paths, Mapping) else {"": paths}
    with open(file, "w", encoding="ascii") as out:
        out.write(f"{'task,' if of_tasks is paths else ''}agent,t,x,y\n")
        for task, of_task in of_tasks.items():
            start = f"{task}," if of_tasks is paths else ""
            for agent, path in enumerate(of_task):
                out.writelines(f"{start}{agent},{step},{x},{y}\n" for step, (x, y) in enumerate(path))
