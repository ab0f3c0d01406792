# SPDX-License-Identifier: MIT
"""Plugins in Python: a file with classes of these is a plugin library.

    import dmrp.plugin as dp

    class Policy(dp.LocalController):
        id = "org.me.policy"
        gain: float = dp.number(1.0, low=0.1, high=10.0, help="of the heading")

        def step(self, now):
            return 0.5, 0.0, self.gain
"""

from __future__ import annotations

import math
from typing import Any, Sequence

from dmrp import _abi
from dmrp.views import AGENT_FEATURES, FEATURES, Array, Costmap, Fleet, Grid, Observation, Problem, Robot, Scan, Trace, World

__all__ = [
    "AGENT_FEATURES", "COSTMAP", "FEATURES", "LIDAR", "CentralController", "Costmap", "Fleet", "GlobalPlanner", "Grid",
    "LocalController", "Metric", "Observation", "PedestrianModel", "Problem", "Robot", "Scan", "TimeOut", "Trace",
    "Unsupported", "World", "boolean", "choice", "integer", "number", "numbers", "path", "text", "texts", "value",
]  # fmt: skip

LIDAR: str = _abi.constants["DMRP_EXT_LIDAR"]
COSTMAP: str = _abi.constants["DMRP_EXT_LOCAL_COSTMAP"]


class Unsupported(Exception):
    """Raised by start() or plan(): this trial is not for the plugin."""


class TimeOut(Exception):
    """Raised by plan(): the search has ended by its time limit, without a plan."""


class Parameter:
    """A declared parameter: in an instance the attribute of its name has the experiment's value."""

    def __init__(self, kind: str, default: Any, unit: str = "", help: str = "", low: float = -math.inf,
                 high: float = math.inf, choices: Sequence[str] = ()) -> None:  # fmt: skip
        self.kind, self.default, self.unit, self.help = kind, default, unit, help
        self.low, self.high, self.choices = float(low), float(high), list(choices)

    def __get__(self, instance: object, owner: type) -> Any:
        """The default, in an object to which no experiment has given a value."""
        return self if instance is None else self.default


def _checked(default: Any, kinds: Any, function: str, what: str) -> Any:
    if not isinstance(default, kinds) or (isinstance(default, bool) and kinds is not bool):
        raise TypeError(f"{function}(): the default {default!r} is no {what}")
    return default


def number(default: float, low: float = -math.inf, high: float = math.inf, unit: str = "", help: str = "") -> Any:
    """A float from `low` to `high`."""
    return Parameter("DOUBLE", float(_checked(default, (int, float), "number", "number")), unit, help, low, high)


def integer(default: int, low: float = -math.inf, high: float = math.inf, unit: str = "", help: str = "") -> Any:
    """A whole number from `low` to `high`."""
    return Parameter("INT", _checked(default, int, "integer", "whole number"), unit, help, low, high)


def boolean(default: bool, help: str = "") -> Any:
    """True or False."""
    return Parameter("BOOL", _checked(default, bool, "boolean", "bool"), "", help)


def text(default: str = "", help: str = "") -> Any:
    """A text."""
    return Parameter("STRING", _checked(default, str, "text", "text"), "", help)


def choice(default: str, choices: Sequence[str], help: str = "") -> Any:
    """One of `choices`."""
    return Parameter("CHOICE", _checked(default, str, "choice", "text"), "", help, choices=choices)


def path(default: str = "", help: str = "") -> Any:
    """A file, relative to the experiment's folder; its hash is in the manifest. The value is absolute, but for the default:
    a file beside the plugin is found by `__file__`."""
    return Parameter("PATH", _checked(default, str, "path", "text"), "", help)


def numbers(default: Sequence[float] = (), low: float = -math.inf, high: float = math.inf, unit: str = "",
            help: str = "") -> Any:  # fmt: skip
    """A list of floats from `low` to `high`."""
    listed = [float(_checked(one, (int, float), "numbers", "number")) for one in default]
    return Parameter("DOUBLE_ARRAY", listed, unit, help, low, high)


def texts(default: Sequence[str] = (), help: str = "") -> Any:
    """A list of texts."""
    return Parameter("STRING_ARRAY", [_checked(one, str, "texts", "text") for one in default], "", help)


class Value:
    """A value that a metric declares."""

    def __init__(
        self, name: str, unit: str, better: str, help: str, subjects: Sequence[str], low: float, high: float
    ) -> None:
        self.name, self.unit, self.help, self.low, self.high = name, unit, help, low, high
        if better not in ("none", "lower", "higher"):
            raise ValueError(f"value(): better is 'none', 'lower' or 'higher', not {better!r}")
        self.direction = _abi.constants[f"DMRP_DIRECTION_{better.upper()}"]
        self.subjects = 0
        for subject in subjects:
            kinds = {"system": "SYSTEM", "robot": "ROBOT", "pedestrian": "PEDESTRIAN"}
            if subject not in kinds:
                raise ValueError(f"value(): a subject is 'system', 'robot' or 'pedestrian', not {subject!r}")
            self.subjects |= 1 << _abi.constants[f"DMRP_SUBJECT_{kinds[subject]}"]


def value(name: str, unit: str = "1", better: str = "none", help: str = "",
          subjects: Sequence[str] = ("system",), low: float = -math.inf, high: float = math.inf) -> Value:  # fmt: skip
    """A value of a metric, in the column `name` of the results; the system is always among its subjects. It lies
    between `low` and `high`: a value beyond is a fault, and no interval goes beyond."""
    return Value(name, unit, better, help, subjects, low, high)


class Plugin:
    """What plugins of all kinds have. A class whose name begins with '_' is no plugin."""

    id: str = ""  # reverse DNS: "org.me.policy"
    name: str = ""  # for display; the class's name otherwise
    version: str = "0.0.0"
    vendor: str = ""
    summary: str = ""  # one line; the first of the docstring otherwise
    source: str = ""  # paper, section
    uses: Sequence[str] = ()  # LIDAR, COSTMAP
    starts_processes: bool = False

    def load(self) -> None:
        """Called once for an object, when its parameters are set: the place to read weights."""

    def start(self, world: World, seed: int) -> None:
        """A trial begins. All random numbers come from the seed, nothing from earlier trials."""

    def log(self, message: str) -> None:
        """Writes a line to the log; without dmrp-host, to the terminal."""
        getattr(self, "_log", print)(message)


class LocalController(Plugin):
    """Drives one robot; each robot has its object, whose `robot` is its index."""

    kinematics: Sequence[str] = ("differential",)  # those it drives: also "holonomic", "ackermann"
    drives_backwards: bool = False
    robot: int = -1

    def set_path(self, path: Array) -> None:
        """The path to follow, which ends where the robot must stop: fields x, y, theta (NaN: any), t_ns, goal_index."""

    def step(self, now: Observation) -> Any:
        """The command (v_x, v_y, omega), or None if there is none: then the host brakes."""
        raise NotImplementedError("step()")


class CentralController(Plugin):
    """Drives all robots by one object."""

    kinematics: Sequence[str] = ("differential",)
    drives_backwards: bool = False

    def set_path(self, robot: int, path: Array) -> None:
        """The path of a robot, as LocalController.set_path()."""

    def step(self, fleet: Fleet) -> Any:
        """Commands (n, 3), a row v_x, v_y, omega a robot of the fleet; a row of NaN is no command."""
        raise NotImplementedError("step()")


class GlobalPlanner(Plugin):
    """Plans the ways of all robots."""

    connectivity: int = 4  # or 8
    uncoordinated: bool = False  # paths may conflict

    def plan(self, problem: Problem) -> Any:
        """A path a robot: rows of cells (row, column), one a time step from its start to its last goal; None: no plan."""
        raise NotImplementedError("plan()")


class PedestrianModel(Plugin):
    """Moves all people."""

    def step(self, people: Array, robots: Array, dt_s: float) -> Any:
        """Velocities (n, 2) in m/s, of `people`: fields id, position (2), velocity (2), radius_m, desired_speed, target (2).
        `robots` are agents."""
        raise NotImplementedError("step()")


class Metric(Plugin):
    """Measures a finished trial."""

    values: Sequence[Value] = ()
    people: bool = False  # whether it needs them in the trace

    def measure(self, trace: Trace) -> Any:
        """A dict of values by name: a number for the system, or {"system": number, "robot": numbers}."""
        raise NotImplementedError("measure()")
