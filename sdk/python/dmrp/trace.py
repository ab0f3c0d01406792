# SPDX-License-Identifier: MIT
"""A trial's trace as numpy arrays, read from its lossless channel without dmrp-host."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pandas as pd

from .fields import Elements, FieldList, Record, array_of
from .mcap import Channel, TraceError

if TYPE_CHECKING:
    from .plugin import Metric

TOPIC = "dmrp/trace"
_ELEMENTS = ("robots", "people", "contacts", "calls", "events")

Array = np.ndarray[Any, Any]


class Trace:
    """What a trial's trace holds. Lengths are metres, angles radians, times nanoseconds of simulated time.

    path        the file
    world       the fields of `dmrp_world`, with robots, shapes, segments and the planning grid
    plans       the plans in order of time, fields as in `dmrp_plan`
    end         the fields of `dmrp_trial_end` and the reason, or None where the trace is cut
    is_whole    whether the file has an end
    t_ns        (samples,) int64: the time of each sample
    dt_ns       (samples,) int64: since the sample before
    control_tick   (samples,) uint32: 1 where controllers act on the sample
    plan_revision  (samples,) uint64: of the plan in force; 0: none
    robots      (samples, robots), fields as in `dmrp_robot_sample`: robots["pose"]["x"], ...
    """

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self.path = Path(path)
        self.plans: list[Record] = []
        self.end: Record | None = None
        self.world: Record = {}
        samples: list[Record] = []
        self._scans: list[Record] = []
        self._routes: list[tuple[int, Record]] = []
        self.notes: list[Record] = []
        self.trajectories: list[Record] = []
        self._fields: FieldList
        channel = Channel(self.path, TOPIC)
        try:
            self._read(channel, samples)
        except TraceError as error:
            raise TraceError(f"{self.path}: {error}") from None
        if not self.world:
            raise TraceError(f"{self.path}: has no world: it is cut before its first chunk, or no trace of dmrp")
        self.is_whole = self.end is not None
        self.t_ns = np.array([sample["t_ns"] for sample in samples], np.int64)
        self.dt_ns = np.array([sample["dt_ns"] for sample in samples], np.int64)
        self.control_tick = np.array([sample["control_tick"] for sample in samples], np.uint32)
        self.plan_revision = np.array([sample["plan_revision"] for sample in samples], np.uint64)
        self._columns = {name: self._column(samples, name) for name in _ELEMENTS}
        self.robots = self._columns["robots"][1].reshape(len(samples), len(self.world["robots"]))

    def _read(self, channel: Channel, samples: list[Record]) -> None:
        fields: FieldList | None = None
        for message in channel:
            if fields is None:
                fields = self._fields = FieldList(channel.schema)
            name, record = fields.read(message)
            if name == "sample":
                samples.append(record)
                self._routes += [(record["t_ns"], _settled(route)) for route in record["routes"]]
            elif name == "world":
                self.world = _settled(record)
            elif name == "plan":
                self.plans.append(_settled(record))
            elif name == "scan":
                self._scans.append(record)
            elif name == "note":
                self.notes.append(record)
            elif name == "trajectory":
                self.trajectories.append(record)
            elif name == "end":
                self.end = _settled(record)

    def _column(self, samples: list[Record], name: str) -> tuple[Array, Array]:
        """The sample that each element belongs to, and the elements."""
        parts: list[Elements] = [sample[name] for sample in samples]
        counts = [part.count for part in parts]
        dtype = parts[0].dtype if parts else np.dtype([])
        return np.repeat(np.arange(len(parts)), counts), array_of(parts, dtype)

    def elements(self, name: str) -> tuple[Array, Array]:
        """(n,) indices of samples and (n,) elements of "robots", "people", "contacts", "calls" or "events"."""
        return self._columns[name]

    def poses(self) -> pd.DataFrame:
        """A row a sample and robot: t_s, robot, x, y (m), theta (rad), v_x, v_y (m/s), omega (rad/s), state,
        goal_index, progress_m."""
        sample, robots = self._columns["robots"]
        return pd.DataFrame(
            {
                "t_s": self.t_ns[sample] / 1e9,
                "robot": np.tile(np.arange(self.robots.shape[1]), len(self.t_ns)),
                **{name: robots["pose"][name] for name in ("x", "y", "theta")},
                **{name: robots["velocity"][name] for name in ("v_x", "v_y", "omega")},
                **{name: robots[name] for name in ("state", "goal_index", "progress_m")},
            }
        )

    def people(self) -> pd.DataFrame:
        """A row a sample and present person: t_s, id, group, x, y (m), v_x, v_y (m/s), radius_m."""
        sample, people = self._columns["people"]
        if len(people) == 0:
            return pd.DataFrame(columns=["t_s", "id", "group", "x", "y", "v_x", "v_y", "radius_m"])
        return pd.DataFrame(
            {
                "t_s": self.t_ns[sample] / 1e9,
                "id": people["id"],
                "group": people["group"],
                "x": people["position"]["x"],
                "y": people["position"]["y"],
                "v_x": people["velocity"]["x"],
                "v_y": people["velocity"]["y"],
                "radius_m": people["radius_m"],
            }
        )

    def contacts(self) -> pd.DataFrame:
        """A row a sample and contact: t_s, kind, flags, a, b, depth_m, x, y (m), impact_speed (m/s)."""
        sample, contacts = self._columns["contacts"]
        columns = {name: contacts[name] for name in ("kind", "flags", "a", "b", "depth_m")}
        point = contacts["point"]
        return pd.DataFrame(
            {"t_s": self.t_ns[sample] / 1e9, **columns, "x": point["x"], "y": point["y"]}
            | {"impact_speed": contacts["impact_speed"]}
        )

    def scans(self) -> list[Record]:
        """The recorded scans in order of time: t_ns, robot, angle_min, angle_increment (rad), range_min, range_max
        (m) and ranges, (beams,) float32 in metres, infinite where nothing was hit."""
        return self._scans

    def routes(self) -> list[tuple[int, Record]]:
        """What controllers were handed: its time in ns, and robot, kept and waypoints as in `dmrp_route`."""
        return self._routes

    def measure(self, metric: Metric) -> Any:
        """What the metric, an object of a class in Python, gives of this trace: it is shown what it would be shown in a
        run. Its parameters have their defaults, or what its attributes were set to; the seed of start() is 0."""
        from . import _metric_view

        seen = _metric_view.of(self, metric.people)
        metric.load()
        metric.start(seen.world, 0)
        return metric.measure(seen)

    def __repr__(self) -> str:
        cut = "" if self.is_whole else ", cut"
        return f"<Trace {self.path.name}: {len(self.t_ns)} samples, {self.robots.shape[1]} robots{cut}>"


def read(path: str | os.PathLike[str]) -> Trace:
    """The trace in a file `trial_NNNNNN.mcap`."""
    return Trace(path)


def _settled(value: Any) -> Any:
    """`value` with arrays instead of elements as they stand in the file."""
    if isinstance(value, Elements):
        return array_of([value], value.dtype)
    if isinstance(value, dict):
        return {name: _settled(content) for name, content in value.items()}
    if isinstance(value, list):
        return [_settled(content) for content in value]
    return value
