# SPDX-License-Identifier: MIT
"""Metrics in Python: one that the built-in library has too, and one that says what it is shown."""

import hashlib

import numpy as np

import dmrp.plugin as dp


class Sto(dp.Metric):
    """Share of planned waypoints near another robot's waypoint of about the same step (DMRP-Bench, ICRA 2026)"""

    id = "test.sto"
    values = [dp.value("own_sto", "1", "lower", low=0.0, high=1.0, subjects=("system", "robot"))]
    distance_m: float = dp.number(0.5, low=0.0, unit="m")
    window: int = dp.integer(2, low=0)

    def measure(self, trace):
        if not trace.plan:
            return {"own_sto": {"system": np.nan, "robot": np.full(len(trace.world.robots), np.nan)}}
        first_ns = min(path["t_ns"][0] for path in trace.plan)
        ways = [steps_of(path, first_ns, trace.step_duration_ns) for path in trace.plan]
        shares = np.array([self.share(ways, robot) for robot in range(len(ways))])
        return {"own_sto": {"system": shares.mean(), "robot": shares}}

    def share(self, ways, robot):
        own, near = ways[robot], np.zeros(len(ways[robot]), bool)
        for other in ways[:robot] + ways[robot + 1 :]:
            for shift in range(-self.window, self.window + 1):
                steps = np.arange(len(own)) + shift  # the other rests at its goal
                there = other[np.clip(steps, 0, len(other) - 1)]
                near |= (steps >= 0) & (((own - there) ** 2).sum(axis=1) <= self.distance_m**2)
        return near.mean()


def steps_of(path, first_ns, step_ns):
    """Positions a step, from the plan's begin until the robot rests at its last goal."""
    places = np.column_stack((path["x"], path["y"]))
    moves = np.flatnonzero((np.diff(places, axis=0) != 0.0).any(axis=1))
    last = moves[-1] + 1 if len(moves) else 0
    t_ns = path["t_ns"][: last + 1]
    at_ns = np.arange(first_ns, t_ns[-1] + step_ns, step_ns)
    return np.column_stack([np.interp(at_ns, t_ns, places[: last + 1, axis]) for axis in (0, 1)])


def shown(value, name="trace"):
    """A line for each number and array that is reached from `value`: its place, type, shape, and a hash of its bytes."""
    if isinstance(value, np.ndarray):
        data = [value[field].tobytes() for field in value.dtype.names] if value.dtype.names else [value.tobytes()]
        yield f"{name} {value.dtype} {value.shape} {hashlib.sha256(b''.join(data)).hexdigest()[:16]}"
    elif isinstance(value, list):
        yield f"{name} {len(value)}"
        for index, part in enumerate(value):
            yield from shown(part, f"{name}[{index}]")
    elif isinstance(value, dict) or hasattr(value, "__dict__"):
        for key, part in sorted((value if isinstance(value, dict) else vars(value)).items()):
            yield from shown(part, f"{name}.{key}")
    else:
        yield f"{name} {type(value).__name__} {value!r}"


class Shown(dp.Metric):
    """Prints what it is shown"""

    id = "test.shown"
    values = [dp.value("lines")]
    people = True

    def measure(self, trace):
        lines = list(shown(trace))
        print("\n".join(f"shown: {line}" for line in lines), flush=True)
        return {"lines": len(lines)}


class Unpopulated(dp.Metric):
    """Is shown no people, which it does not declare"""

    id = "test.unpopulated"
    values = [dp.value("people_shown")]

    def measure(self, trace):
        return {"people_shown": sum(map(len, trace.people))}
