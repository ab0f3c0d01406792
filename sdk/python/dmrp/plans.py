# SPDX-License-Identifier: MIT
"""Tasks for other solvers in cells, and their plans as paths in cells, which formats.write_plan() writes."""

from __future__ import annotations

import os
import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from .host import InputError
from .trace import Trace

Cells = list[tuple[int, int]]  # (x, y) at step 0, 1, ..., y from the top

class Task(NamedTuple):
    """What a solver plans for, in cells (x, y), y from the top.

    free     (rows, columns) bool: a robot may stand there; goals of all robots, in their order"""

    free: np.ndarray[Any, np.dtype[np.bool_]]
    starts: list[tuple[int, int]]
    goals: list[Cells]


def task_of(trace: Trace) -> Task:
    """The task of a trial's robots on its planning grid."""
    grid = trace.world["planning_grid"]
    free = grid["free"].reshape(grid["height"], grid["width"])[::-1] != 0

    def cell(pose: Any) -> tuple[int, int]:
        x, y = (int((pose[axis] - grid["origin"][axis]) // grid["resolution_m"]) for axis in (0, 1))
        return x, grid["height"] - 1 - y

    robots = trace.world["robots"]
    goals = [[cell(goal) for goal in robot["goals"]["pose"]] for robot in robots]
    return Task(free, [cell(robot["start"]) for robot in robots], goals)


_smart_place = re.compile(r"\(\s*(-?\d+)\s*,\s*(-?\d+)\s*,\s*(\d+)\s*\)->")
_moves = {"u": (0, 1), "d": (0, -1), "l": (-1, 0), "r": (1, 0), "w": (0, 0)}


def read_smart(file: str | os.PathLike[str], *, flip_height: int | None = None) -> list[Cells]:
    """The paths of a file of SMART: a line `Agent 0:(x,y,t)->...` for each agent; between two places it waits.

    flip_height: rows of the map where the file counts y from below"""
    paths: list[Cells] = []
    for number, line in enumerate(Path(file).read_text().splitlines(), 1):
        if not line.strip():
            continue
        head, _, rest = line.partition(":")
        places = [tuple(map(int, place)) for place in _smart_place.findall(rest)]
        if head.strip() != f"Agent {len(paths)}" or not places or _smart_place.sub("", rest).strip():
            raise InputError(f"{os.fspath(file)}:{number}: is no line `Agent {len(paths)}:(x,y,t)->...`")
        cells: Cells = []
        for x, y, step in places:
            if step < len(cells) or not cells and step > 0:
                raise InputError(f"{os.fspath(file)}:{number}: step {step} does not follow the one before")
            while len(cells) < step:
                cells.append(cells[-1])
            cells.append((x, y if flip_height is None else flip_height - 1 - y))
        paths.append(cells)
    return paths


def read_tracker(file: str | os.PathLike[str], starts: Sequence[tuple[int, int]]) -> list[Cells]:
    """The paths of a solution of the MAPF tracker: a line of u, d, l, r, w for each agent from its start; u raises y."""
    lines = Path(file).read_text().split()
    if len(lines) != len(starts):
        raise InputError(f"{os.fspath(file)}: has {len(lines)} agents, the scenario {len(starts)}")
    paths: list[Cells] = []
    for number, (line, (x, y)) in enumerate(zip(lines, starts), 1):
        cells = [(x, y)]
        for move in line:
            if move not in _moves:
                raise InputError(f"{os.fspath(file)}:{number}: {move!r} is none of u, d, l, r, w")
            x, y = x + _moves[move][0], y + _moves[move][1]
            cells.append((x, y))
        paths.append(cells)
    return paths


def starts_of(scen: str | os.PathLike[str], agents: int) -> list[tuple[int, int]]:
    """The first `agents` starts of a MovingAI .scen file."""
    rows = [line.split() for line in Path(scen).read_text().splitlines()[1:] if line.strip()]
    if len(rows) < agents:
        raise InputError(f"{os.fspath(scen)}: has {len(rows)} tasks, not {agents}")
    return [(int(row[4]), int(row[5])) for row in rows[:agents]]
