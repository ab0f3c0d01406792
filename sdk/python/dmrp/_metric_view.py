# SPDX-License-Identifier: MIT
"""A stored trace as a metric sees it in a run: the same names, shapes and types."""

from __future__ import annotations

from typing import Any

import numpy as np

from dmrp import _abi, trace, views
from dmrp.fields import Record
from dmrp.mcap import TraceError


def of(stored: trace.Trace, people: bool) -> views.Trace:
    """What a metric is given of this trace; without `people` there are none, as in a run."""
    if stored.end is None:
        raise TraceError(f"{stored.path}: was cut short: it has no end")
    seen = views.Trace(_world(stored.world))
    for plan in stored.plans:
        if plan["paths"]:
            seen.plan = [path["waypoints"] for path in plan["paths"]]
            seen.step_duration_ns = plan["step_duration_ns"]
            break
    seen.ending, seen.end_ns = stored.end["ending"], stored.end["t_ns"]
    # without a plan nothing moved, and the host shows no sample
    shown = 0 if seen.ending == _abi.constants["DMRP_ENDING_NO_PLAN"] else len(stored.t_ns)
    seen.t_ns, seen.robots = stored.t_ns[:shown], _flat(stored.robots[:shown])
    seen.people = _by_sample(stored, "people", shown) if people else [np.empty(0, views.PERSON)] * shown
    seen.contacts = _by_sample(stored, "contacts", shown)
    return seen


def _flat(elements: views.Array) -> views.Array:
    return elements.view(views.flat(elements.dtype))


def _by_sample(stored: trace.Trace, name: str, shown: int) -> list[views.Array]:
    sample, elements = stored.elements(name)
    ends = np.cumsum(np.bincount(sample, minlength=len(stored.t_ns)))
    return np.split(_flat(elements), ends[:-1])[:shown]


def _made(kind: Any, **values: Any) -> Any:
    made = object.__new__(kind)
    vars(made).update(values)
    return made


def _world(world: Record) -> views.World:
    made: views.World = _made(
        views.World, lower=np.array(world["lower"]), upper=np.array(world["upper"]), step_s=world["step_ns"] * 1e-9,
        control_period_s=world["control_period_ns"] * 1e-9, time_limit_s=world["time_limit_ns"] * 1e-9,
        person_count=world["person_count"], person_radius_m=world["person_radius_m"],
        robots=[_robot(robot) for robot in world["robots"]],
        segments=world["segments"].view(np.float64).reshape(-1, 4), grid=_grid(world["planning_grid"]),
    )  # fmt: skip
    return made


def _robot(robot: Record) -> views.Robot:
    made: views.Robot = _made(
        views.Robot, name=robot["name"], type=robot["type"], kinematics=robot["kinematics"], start=np.array(robot["start"]),
        goals=_flat(robot["goals"]), radius_m=robot["footprint"]["radius_m"], limits=robot["limits"],
    )  # fmt: skip
    return made


def _grid(grid: Record) -> views.Grid:
    shape = (grid["height"], grid["width"])
    made: views.Grid = _made(
        views.Grid, shape=shape, resolution_m=grid["resolution_m"], origin=np.array(grid["origin"]),
        free=grid["free"].reshape(shape).view(np.bool_), edges=grid["edges"].reshape(shape),
        clearance=grid["clearance"].reshape(shape),
    )  # fmt: skip
    return made
