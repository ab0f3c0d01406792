# SPDX-License-Identifier: MIT
"""The collision-free speed model of Tordeux, Chraibi, Seyfried (Traffic and Granular Flow '15, Springer 2016), walls
pushing as neighbours do; and people who block each other take turns, as in the built-in model of this name: without this
(right_of_way = false, as published) doors clog."""

import numpy as np

import dmrp.plugin as dp

CELL_M = 0.2  # of the grids that people find their way by
NEGLIGIBLE = 1e-4  # a push, relative to the desired direction
BLOCKED, MEMORY_S, SHUFFLING = 0.03, 5.0, 0.3  # right of way: of the desired speed, s, m/s


class CollisionFreeSpeed(dp.PedestrianModel):
    """People turn away from their neighbours and walk as fast as the gap ahead permits"""

    id, version = "org.example.collision_free_speed", "0.1.0"
    source = "Tordeux, Chraibi, Seyfried: Collision-free speed model for pedestrian dynamics, TGF '15"

    time_gap: float = dp.number(0.5, low=0.1, high=10.0, unit="s", help="to cover the gap ahead")
    strength: float = dp.number(8.0, low=0.0, help="push of a neighbour in contact, relative to the desired direction")
    range_m: float = dp.number(0.1, low=0.001, high=0.5, unit="m", help="gap at which it has fallen to 1/e")
    wall_strength: float = dp.number(5.0, low=0.0, help="push of a wall in contact")
    wall_range_m: float = dp.number(0.02, low=0.001, high=0.5, unit="m", help="gap at which it has fallen to 1/e")
    right_of_way: bool = dp.boolean(True, help="who is blocked ignores people ahead with farther to go; false: as published")

    def start(self, world, seed):
        self.progress = {}  # the mean speed along the desired direction, by id
        self.walls = np.array(world.segments)
        self.ways = Ways(world)

    def step(self, people, robots, dt_s):
        place, radius = people["position"], people["radius_m"]
        bodies = np.vstack((place, robots["pose"][:, :2]))
        radii = np.concatenate((radius, robots["radius_m"]))
        count = len(people)

        # pairs of a person i and a body j that pushes, or may be in the way within the time gap
        reach_m = self.range_m * np.log(max(self.strength / NEGLIGIBLE, 1.0))
        reach_m = max(reach_m, self.time_gap * people["desired_speed"].max(initial=0.0)) + 2.0 * radii.max(initial=0.0)
        near = np.ones((count, len(bodies)), bool)
        for axis in (0, 1):
            near &= np.abs(place[:, None, axis] - bodies[None, :, axis]) < reach_m
        i, j = np.nonzero(near)
        i, j = i[i != j], j[i != j]
        apart = bodies[j] - place[i]
        distance = np.maximum(np.hypot(apart[:, 0], apart[:, 1]), 1e-9)
        reach = radii[i] + radii[j]
        gap = np.maximum(distance - reach, 0.0)

        # the direction: equations 1 and 4
        way = self.ways.directions(people)
        is_ignored = self.ignored(people, i, j, apart, way, dt_s)
        influence = np.where(is_ignored, 0.0, self.strength * np.exp(-gap / self.range_m))
        pushes = -apart * (influence / distance)[:, None]
        wish = way.copy()
        for axis in (0, 1):
            wish[:, axis] += np.bincount(i, pushes[:, axis], count)
        away, wall_m = from_walls(place, self.walls)
        push = self.wall_strength * np.exp(-np.maximum(wall_m - radius[:, None], 0.0) / self.wall_range_m)
        wish += (away * push[:, :, None]).sum(axis=1)
        wish /= np.maximum(np.hypot(wish[:, 0], wish[:, 1]), 1e-9)[:, None]

        # the speed: equations 2 and 3, and nobody passes the target
        ahead = (apart * wish[i]).sum(axis=1)
        aside = np.abs(apart[:, 0] * wish[i, 1] - apart[:, 1] * wish[i, 0])
        in_the_way = (ahead >= 0.0) & (aside <= reach)
        to_target = people["target"] - place
        speed = np.minimum(people["desired_speed"], np.hypot(to_target[:, 0], to_target[:, 1]) / dt_s)
        permitted = gap / max(self.time_gap, dt_s)
        is_forward = (wish * way).sum(axis=1) > 0.0
        permitted[is_ignored & is_forward[i]] = np.maximum(permitted, SHUFFLING)[is_ignored & is_forward[i]]
        np.minimum.at(speed, i[in_the_way], permitted[in_the_way])
        return wish * speed[:, None]

    def ignored(self, people, i, j, apart, way, dt_s):
        """Of each pair, whether the person is blocked and the body is somebody ahead who has farther to go."""
        ids, ahead_speed = people["id"].tolist(), (people["velocity"] * way).sum(axis=1)
        mean = np.array([self.progress.get(id, speed) for id, speed in zip(ids, people["desired_speed"].tolist())])
        mean += (ahead_speed - mean) * min(dt_s / MEMORY_S, 1.0)
        self.progress = dict(zip(ids, mean.tolist()))
        is_blocked = self.right_of_way & (mean < BLOCKED * people["desired_speed"])
        to_target = people["target"] - people["position"]
        rank = np.empty(len(people), int)
        rank[np.lexsort((people["id"], np.hypot(to_target[:, 0], to_target[:, 1])))] = np.arange(len(people))
        is_person = j < len(people)
        comes_first = rank[i] < rank[np.where(is_person, j, i)]
        return is_blocked[i] & is_person & comes_first & ((apart * way[i]).sum(axis=1) > 0.0)


def from_walls(points, walls):
    """Unit vectors (points, walls, 2) from the nearest point of each wall, and distances (points, walls)."""
    begin, along = walls[:, :2], walls[:, 2:] - walls[:, :2]
    from_begin = points[:, None] - begin
    share = (from_begin * along).sum(axis=2) / np.maximum((along**2).sum(axis=1), 1e-12)
    apart = from_begin - np.clip(share, 0.0, 1.0)[:, :, None] * along
    distance = np.hypot(apart[:, :, 0], apart[:, :, 1])
    return apart / np.maximum(distance, 1e-9)[:, :, None], distance


class Ways:
    """The shortest ways round walls: for each place that people walk to, the directions down the distance to it."""

    def __init__(self, world):
        self.lower = np.array(world.lower)
        self.shape = np.ceil((world.upper - world.lower) / CELL_M).astype(int)  # columns, rows
        self.centers = np.moveaxis(np.indices(self.shape), 0, 2) * CELL_M + self.lower + CELL_M / 2
        self.is_walkable = np.ones(self.shape, bool)
        for wall in np.array(world.segments).reshape(-1, 2, 2):
            reach = np.array((wall.min(axis=0) - world.person_radius_m, wall.max(axis=0) + world.person_radius_m))
            first, last = np.clip(((reach - self.lower) / CELL_M).astype(int), 0, self.shape)
            about = slice(first[0], last[0] + 1), slice(first[1], last[1] + 1)
            _, far_m = from_walls(self.centers[about].reshape(-1, 2), wall.reshape(1, 4))
            self.is_walkable[about] &= (far_m >= world.person_radius_m).reshape(self.is_walkable[about].shape)
        self.fields = {}

    def directions(self, people):
        """The desired direction of each person: a unit vector, or zero on the target."""
        ways = people["target"] - people["position"]
        ways /= np.maximum(np.hypot(ways[:, 0], ways[:, 1]), 1e-9)[:, None]
        cells = ((people["position"] - self.lower) / CELL_M).astype(int)
        cells = np.clip(cells, 0, self.shape - 1)
        for target in np.unique(people["target_id"]):
            mine = np.flatnonzero(people["target_id"] == target)
            if target not in self.fields:
                first = people[mine[0]]
                self.fields[target] = self.field(first["area_lower"], first["area_upper"])
            way = self.fields[target][cells[mine, 0], cells[mine, 1]]
            is_outside = (way != 0.0).any(axis=1)  # of the place
            ways[mine[is_outside]] = way[is_outside]
        return ways

    @np.errstate(invalid="ignore")  # of infinite distances
    def field(self, lower, upper):
        """(columns, rows, 2): unit vectors to the place; zero in it, and where no way leads there."""
        nearest = np.clip(self.centers, lower, upper)
        is_there = (np.abs(self.centers - nearest) <= CELL_M / 2).all(axis=2)
        far = np.full(self.shape + 2, np.inf)  # with a border
        inner = far[1:-1, 1:-1]
        is_source = is_there & self.is_walkable
        inner[is_source if is_source.any() else is_there] = 0.0
        # then the cells at walls, where people may be pushed: the way back is short, and none leads through a wall
        for is_allowed, cost_m in ((self.is_walkable, CELL_M), (~self.is_walkable, 10.0 * CELL_M)):
            is_done = False
            while not is_done:
                x_m, y_m = nearer_neighbors(far)
                low, high = np.minimum(x_m, y_m), np.maximum(x_m, y_m)
                high = np.minimum(high, low + cost_m)
                step = np.where(np.isfinite(low), high - low, 0.0)
                made = (low + high + np.sqrt(2.0 * cost_m**2 - step**2)) / 2.0  # the eikonal equation, |gradient| = cost
                shorter = is_allowed & (made < inner - 1e-9)
                inner[shorter] = made[shorter]
                is_done = not shorter.any()
        x_m, y_m = nearer_neighbors(far)
        x_sign, y_sign = np.where(far[:-2, 1:-1] < far[2:, 1:-1], -1, 1), np.where(far[1:-1, :-2] < far[1:-1, 2:], -1, 1)
        down = np.stack((x_sign * np.maximum(inner - x_m, 0.0), y_sign * np.maximum(inner - y_m, 0.0)), axis=2)
        down[~np.isfinite(down) | is_there[:, :, None]] = 0.0
        return down / np.maximum(np.hypot(down[:, :, 0], down[:, :, 1]), 1e-9)[:, :, None]


def nearer_neighbors(far):
    """How far the place is from the nearer neighbour of each cell in x, and in y."""
    return np.minimum(far[:-2, 1:-1], far[2:, 1:-1]), np.minimum(far[1:-1, :-2], far[1:-1, 2:])
