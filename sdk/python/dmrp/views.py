# SPDX-License-Identifier: MIT
"""What plugins are given, as numpy arrays. Arrays are read-only views of the shared memory, valid until the function
returns: copy what you keep."""

from __future__ import annotations

import ctypes
from collections.abc import Iterator
from typing import Any

import numpy as np

from dmrp import _abi

Array = np.ndarray[Any, Any]

FEATURES = (
    "x y theta v_x v_y omega goal_x goal_y goal_theta goal_tolerance_m progress_m v_max omega_max a_max alpha_max "
    "radius_m steering_angle dt_s"
).split()
AGENT_FEATURES = "kind x y v_x v_y radius_m".split()

_TRIPLES = {name: np.dtype((np.float64, 3)) for name in ("dmrp_pose", "dmrp_twist")}
_PAIR = np.dtype((np.float64, 2))


def flat(dtype: np.dtype[Any]) -> np.dtype[Any]:
    """The same bytes, with poses, twists and vectors as rows of numbers."""
    names, formats, offsets = [], [], []
    for name, (kind, offset) in ((name, dtype.fields[name][:2]) for name in dtype.names or ()):  # type: ignore[index]
        names.append(name)
        offsets.append(offset)
        size = kind.itemsize // 8
        formats.append(np.dtype((np.float64, size)) if kind.names else kind)
    return np.dtype({"names": names, "formats": formats, "offsets": offsets, "itemsize": dtype.itemsize})


AGENT = flat(_abi.dtypes["dmrp_agent"])  # id, kind, state, pose (3), velocity (2), radius_m
PERSON = flat(_abi.dtypes["dmrp_person"])
GOAL = flat(_abi.dtypes["dmrp_goal"])
WAYPOINT = _abi.dtypes["dmrp_waypoint"]  # x, y, theta, t_ns, goal_index
OBSERVATION = flat(_abi.dtypes["dmrp_observation"])
ROBOT_SAMPLE = flat(_abi.dtypes["dmrp_robot_sample"])
CONTACT = flat(_abi.dtypes["dmrp_contact"])
PLANNING_ROBOT = flat(_abi.dtypes["dmrp_planning_robot"])
_OBSERVATION = _abi.structs["dmrp_observation"]
AGENT_ROBOT = _abi.constants["DMRP_AGENT_ROBOT"]
AGENT_PERSON = _abi.constants["DMRP_AGENT_PERSON"]


def path_of(address: int) -> Array:
    """The waypoints of a path: x, y, theta, t_ns, goal_index."""
    path = _abi.at("dmrp_path", address)
    return _abi.array(path.waypoints, path.count, WAYPOINT, path.stride)


# rows and columns, in the order of the edge bits
_MOVES = ((0, 1), (1, 1), (1, 0), (1, -1), (0, -1), (-1, -1), (-1, 0), (-1, 1))


class Grid:
    """Square cells; row 0 and column 0 are at the lower left. `free` and `edges`: (height, width), `clearance` in m."""

    def __init__(self, address: int) -> None:
        grid = _abi.at("dmrp_grid", address)
        self.shape = (grid.height, grid.width)
        self.resolution_m = float(grid.resolution_m)
        self.origin = np.array((grid.origin.x, grid.origin.y))
        cells = grid.height * grid.width
        self.free = _abi.array(grid.free, cells, np.uint8).reshape(self.shape).view(np.bool_)
        self.edges = _abi.array(grid.edges, cells, np.uint8).reshape(self.shape)
        self.clearance = _abi.array(grid.clearance, cells, np.float32).reshape(self.shape)

    def neighbors(self, cell: tuple[int, int], connectivity: int = 4) -> list[tuple[int, int]]:
        """The cells to which a move from this one is open: of 4, or of 8 directions, counter-clockwise from +x."""
        row, column = cell
        edges = int(self.edges[row, column])
        step = 2 if connectivity == 4 else 1
        return [(row + _MOVES[i][0], column + _MOVES[i][1]) for i in range(0, 8, step) if edges >> i & 1]

    def cell_of(self, points: Any) -> Array:
        """(row, column) of points (..., 2)."""
        xy = (np.asarray(points, np.float64) - self.origin) / self.resolution_m
        cells: Array = np.floor(xy).astype(np.int64)[..., ::-1]
        return cells

    def center_of(self, cells: Any) -> Array:
        """x, y of the centres of cells (..., 2) of rows and columns."""
        centers: Array = (np.asarray(cells, np.float64)[..., ::-1] + 0.5) * self.resolution_m + self.origin
        return centers


class Robot:
    """A robot at the start of the trial."""

    def __init__(self, address: int) -> None:
        robot = _abi.at("dmrp_robot", address)
        limits = _abi.at("dmrp_limits", robot.limits)
        footprint = _abi.at("dmrp_footprint", robot.footprint)
        self.name = _abi.text(robot.name)
        self.type = _abi.text(robot.type)
        self.kinematics = int(robot.kinematics)
        self.start = np.array((robot.start.x, robot.start.y, robot.start.theta))
        self.goals = _abi.array(robot.goals, robot.goal_count, GOAL, robot.goal_stride)
        self.radius_m = float(footprint.radius_m)
        self.limits = {name: getattr(limits, name) for name, _ in limits._fields_[2:]}


class World:
    """The static world of a trial. Its arrays are valid until the next start()."""

    def __init__(self, address: int) -> None:
        world = _abi.at("dmrp_world", address)
        self.lower = np.array((world.lower.x, world.lower.y))
        self.upper = np.array((world.upper.x, world.upper.y))
        self.step_s = world.step_ns * 1e-9
        self.control_period_s = world.control_period_ns * 1e-9
        self.time_limit_s = world.time_limit_ns * 1e-9
        self.person_count = int(world.person_count)
        self.person_radius_m = float(world.person_radius_m)
        self.robots = [Robot(world.robots + i * world.robot_stride) for i in range(world.robot_count)]
        self.segments = _abi.array(world.segments, world.segment_count * 4, np.float64).reshape(-1, 4)  # x, y, x, y
        self.grid = Grid(world.planning_grid)


class Scan:
    """A laser scan: `ranges` in m, inf where nothing was hit; beam i points at angles[i] in the robot's frame."""

    def __init__(self, address: int) -> None:
        scan = _abi.at("dmrp_scan", address)
        self.t_s = scan.t_ns * 1e-9
        self.range_min = float(scan.range_min)
        self.range_max = float(scan.range_max)
        self.ranges = _abi.array(scan.ranges, scan.count, np.float32)
        self.angles = scan.angle_min + scan.angle_increment * np.arange(scan.count)


class Costmap:
    """The obstacles around the robot: `costs` (height, width) from 0 to 254, as ROS's costmap_2d has them."""

    def __init__(self, address: int) -> None:
        costmap = _abi.at("dmrp_costmap", address)
        self.t_s = costmap.t_ns * 1e-9
        self.resolution_m = float(costmap.resolution_m)
        self.origin = np.array((costmap.origin.x, costmap.origin.y))
        cells = costmap.width * costmap.height
        self.costs = _abi.array(costmap.costs, cells, np.uint8).reshape(costmap.height, costmap.width)


class Sensors:
    """Scans and costmaps of the robots that an instance drives; it asks for them in start()."""

    def __init__(self, host: int, uses: list[str]) -> None:
        get = _abi.function("dmrp_host", "get_extension", _abi.at("dmrp_host", host))
        self._tables = {}
        for use in uses:
            table = get(host, use.encode())
            if table:
                self._tables[use] = table

    def _reading(self, extension: str, struct: str, function: str, robot: int) -> int | None:
        table = self._tables.get(extension)
        if not table:
            raise LookupError(f"there is no {extension}: name it in `uses`, and see the experiment's [sensors]")
        return _abi.function(struct, function, _abi.at(struct, table))(table, robot)  # type: ignore[no-any-return]

    def scan(self, robot: int) -> Scan | None:
        address = self._reading(_abi.constants["DMRP_EXT_LIDAR"], "dmrp_lidar", "scan", robot)
        return Scan(address) if address else None

    def costmap(self, robot: int) -> Costmap | None:
        extension = _abi.constants["DMRP_EXT_LOCAL_COSTMAP"]
        address = self._reading(extension, "dmrp_local_costmap", "costmap", robot)
        return Costmap(address) if address else None


class Observation:
    """What a robot knows at a control tick. Poses are x, y, theta; velocities v_x, v_y, omega in its own frame."""

    __slots__ = ("_c", "_row", "_sensors")

    def __init__(self, address: int, sensors: Sensors) -> None:
        self._c = _OBSERVATION.from_address(address)
        self._row: Any = None
        self._sensors = sensors

    def _values(self, name: str) -> Array:
        if self._row is None:
            self._row = _abi.array(ctypes.addressof(self._c), 1, OBSERVATION)
        return self._row[name][0]  # type: ignore[no-any-return]

    @property
    def robot(self) -> int:
        return self._c.robot  # type: ignore[no-any-return]

    @property
    def t_s(self) -> float:
        return self._c.t_ns * 1e-9  # type: ignore[no-any-return]

    @property
    def dt_s(self) -> float:
        return self._c.dt_ns * 1e-9  # type: ignore[no-any-return]

    @property
    def pose(self) -> Array:
        return self._values("pose")

    @property
    def velocity(self) -> Array:
        return self._values("velocity")

    @property
    def applied(self) -> Array:
        """The last command as the host applied it."""
        return self._values("applied")

    @property
    def goal(self) -> Array:
        """x, y, theta of the current goal; theta NaN: any heading."""
        return _abi.array(self._c.goal, 3, np.float64)

    @property
    def goal_tolerance_m(self) -> float:
        return _abi.at("dmrp_goal", self._c.goal).tolerance_m  # type: ignore[no-any-return]

    @property
    def goal_index(self) -> int:
        return self._c.goal_index  # type: ignore[no-any-return]

    @property
    def progress_m(self) -> float:
        """The arc length that it has reached on the path handed in last."""
        return self._c.progress_m  # type: ignore[no-any-return]

    @property
    def progress_waypoint(self) -> int:
        return self._c.progress_waypoint  # type: ignore[no-any-return]

    @property
    def limits(self) -> Any:
        """v_min, v_max, v_y_max, omega_max, a_max, alpha_max, wheelbase_m, steering_max, steering_rate_max."""
        return _abi.at("dmrp_limits", self._c.limits)

    @property
    def radius_m(self) -> float:
        return _abi.at("dmrp_footprint", self._c.footprint).radius_m  # type: ignore[no-any-return]

    @property
    def steering_angle(self) -> float:
        return self._c.steering_angle  # type: ignore[no-any-return]

    @property
    def agents(self) -> Array:
        """The others: fields id, kind (1 robot, 2 person), state, pose (3), velocity (2, world frame), radius_m."""
        return _abi.array(self._c.agents, self._c.agent_count, AGENT, self._c.agent_stride)

    def scan(self) -> Scan | None:
        """The latest scan, of a plugin that has dmrp.plugin.LIDAR in `uses`."""
        return self._sensors.scan(self.robot)

    def costmap(self) -> Costmap | None:
        """The costmap, of a plugin that has dmrp.plugin.COSTMAP in `uses`."""
        return self._sensors.costmap(self.robot)

    def features(self, agents: int = 16, frame: str = "robot") -> Array:
        """A row of float32 for a network: FEATURES, then AGENT_FEATURES of the nearest agents, zeros where there are fewer.
        In the frame "robot" places and directions are as the robot sees them, and any heading is its own; otherwise
        "world"."""
        return _features(self, agents, frame).astype(np.float32)


def _features(now: Observation, agents: int, frame: str) -> Array:
    if frame not in ("robot", "world"):
        raise ValueError(f"features(): the frame is 'robot' or 'world', not {frame!r}")
    out = np.zeros(len(FEATURES) + agents * len(AGENT_FEATURES))
    pose, limits = now.pose, now.limits
    out[0:3], out[3:6], out[6:9] = pose, now.velocity, now.goal
    out[9:18] = (now.goal_tolerance_m, now.progress_m, limits.v_max, limits.omega_max, limits.a_max, limits.alpha_max,
                 now.radius_m, now.steering_angle, now.dt_s)  # fmt: skip
    others = now.agents
    places = others["pose"][:, :2] - pose[:2]
    nearest = np.argsort(np.hypot(places[:, 0], places[:, 1]), kind="stable")[:agents]
    rows = out[len(FEATURES) :].reshape(agents, len(AGENT_FEATURES))[: len(nearest)]
    rows[:, 0], rows[:, 5] = others["kind"][nearest], others["radius_m"][nearest]
    rows[:, 1:3], rows[:, 3:5] = others["pose"][nearest, :2], others["velocity"][nearest]
    if frame == "robot":
        cos, sin = np.cos(pose[2]), np.sin(pose[2])
        turn = np.array(((cos, -sin), (sin, cos)))
        rows[:, 1:3] = places[nearest] @ turn
        rows[:, 3:5] = rows[:, 3:5] @ turn
        out[6:8] = (out[6:8] - pose[:2]) @ turn
        aside = out[8] - pose[2]
        out[8] = 0.0 if np.isnan(aside) else np.arctan2(np.sin(aside), np.cos(aside))
        out[0:3] = 0.0
    return out


class Fleet:
    """All active robots at a control tick: arrays with a row a robot, and fleet[i] as an Observation."""

    def __init__(self, address: int, sensors: Sensors) -> None:
        fleet = _abi.at("dmrp_fleet", address)
        self._address, self._stride, self._sensors = fleet.observations, fleet.observation_stride, sensors
        self._rows = _abi.array(fleet.observations, fleet.count, OBSERVATION, fleet.observation_stride)
        self.robots = self._rows["robot"]  # their indices
        self.pose = self._rows["pose"]  # (n, 3)
        self.velocity = self._rows["velocity"]  # (n, 3)
        self.progress_m = self._rows["progress_m"]

    def __len__(self) -> int:
        return len(self._rows)

    def __getitem__(self, index: int) -> Observation:
        if not 0 <= index < len(self):
            raise IndexError(index)
        return Observation(self._address + index * self._stride, self._sensors)

    def __iter__(self) -> Iterator[Observation]:
        return (self[index] for index in range(len(self)))

    @property
    def goal(self) -> Array:
        """(n, 3): x, y, theta of each robot's current goal; theta NaN: any heading."""
        return np.stack([now.goal for now in self]) if len(self) else np.empty((0, 3))

    def features(self, agents: int = 16, frame: str = "robot") -> Array:
        """Observation.features() of every robot: (n, 18 + 6 * agents)."""
        rows = [now.features(agents, frame) for now in self]
        return np.stack(rows) if rows else np.empty((0, len(FEATURES) + agents * len(AGENT_FEATURES)), np.float32)


class Problem:
    """What a planner plans: cells are (row, column)."""

    def __init__(self, address: int, should_stop: Any) -> None:
        problem = _abi.at("dmrp_planning_problem", address)
        self.grid = Grid(problem.grid)
        self.now_ns, self.effective_from_ns = int(problem.now_ns), int(problem.effective_from_ns)
        self.step_duration_ns = int(problem.step_duration_ns)
        self.window_steps = int(problem.window_steps)
        rows = _abi.array(problem.robots, problem.robot_count, PLANNING_ROBOT, problem.robot_stride)
        self.robots = rows  # state, pose (3), velocity (3), start (2), waiting_ns ...
        self.start = self.grid.cell_of(rows["start"])  # (n, 2)
        self.grids = [Grid(int(row["grid"])) for row in rows]  # of each robot's footprint
        self.goals = [
            self.grid.cell_of(_abi.array(int(row["goals"]), int(row["goal_count"]), GOAL, int(row["goal_stride"]))["pose"][:, :2])
            for row in rows
        ]  # fmt: skip
        self.is_active = rows["state"] == _abi.constants["DMRP_ROBOT_ACTIVE"]
        stride = problem.in_force_stride
        self.in_force = [path_of(problem.in_force + i * stride) for i in range(problem.in_force_count)]
        self.should_stop = should_stop


class Trace:
    """A finished trial, for a metric. Rows of `robots` are samples, columns robots: pose (3), velocity (3), command (3),
    state, goal_index, progress_m. `people` and `contacts` have an array a sample. `plan` has the first plan's paths:
    x, y, theta, t_ns, goal_index; without a plan it is empty, and `step_duration_ns` 0."""

    def __init__(self, world: World) -> None:
        self.world = world
        self.plan: list[Array] = []
        self.step_duration_ns = 0
        self.t_ns: Any = []
        self.robots: Any = []
        self.people: list[Array] = []
        self.contacts: list[Array] = []
        self.ending = 0
        self.end_ns = 0

    def begin(self, address: int) -> None:
        plan = _abi.at("dmrp_metric_trial", address).plan
        if plan:
            made = _abi.at("dmrp_plan", plan)
            self.plan = [path_of(made.paths + i * made.path_stride).copy() for i in range(made.path_count)]
            self.step_duration_ns = int(made.step_duration_ns)

    def add(self, address: int) -> None:
        sample = _abi.at("dmrp_sample", address)
        self.t_ns.append(sample.t_ns)
        self.robots.append(_abi.array(sample.robots, sample.robot_count, ROBOT_SAMPLE, sample.robot_stride).copy())
        self.people.append(_abi.array(sample.people, sample.person_count, PERSON, sample.person_stride).copy())
        self.contacts.append(_abi.array(sample.contacts, sample.contact_count, CONTACT, sample.contact_stride).copy())

    def finish(self, address: int) -> None:
        end = _abi.at("dmrp_trial_end", address)
        self.ending, self.end_ns = end.ending, end.t_ns
        self.t_ns = np.array(self.t_ns, np.int64)
        self.robots = np.stack(self.robots) if self.robots else np.empty((0, len(self.world.robots)), ROBOT_SAMPLE)
