# SPDX-License-Identifier: MIT
"""A planner, a pedestrian model and a metric."""

import heapq

import numpy as np

import dmrp.plugin as dp


class Planner(dp.GlobalPlanner):
    """Prioritised A* in space and time, in four directions"""

    id = "test.planner"
    longest_steps: int = dp.integer(400, low=1, high=10000, help="of a path")

    def plan(self, problem):
        taken, moved, rests, paths = set(), set(), {}, []
        for robot, start in enumerate(problem.start):
            path = self.path_of(problem, robot, tuple(start.tolist()), taken, moved, rests)
            if path is None:
                return None
            paths.append(path)
            for step, cell in enumerate(path):
                taken.add((cell, step))
                moved.add((cell, path[step + 1], step)) if step + 1 < len(path) else None
            rests[path[-1]] = len(path) - 1
        return paths

    def path_of(self, problem, robot, start, taken, moved, rests):
        grid, goal = problem.grids[robot], tuple(problem.goals[robot][-1].tolist())
        last = max((step for cell, step in taken if cell == goal), default=-1)
        distance = lambda cell: abs(cell[0] - goal[0]) + abs(cell[1] - goal[1])  # noqa: E731
        queue, before = [(distance(start), 0, start)], {(start, 0): None}
        while queue and not problem.should_stop():
            _, step, cell = heapq.heappop(queue)
            if cell == goal and step > last:
                path, at = [], (cell, step)
                while at is not None:
                    path.append(at[0])
                    at = before[at]
                return path[::-1]
            if step == self.longest_steps:
                continue
            for to in [cell, *grid.neighbors(cell)]:
                if (to, step + 1) in taken or (to, cell, step) in moved:
                    continue
                if step + 1 >= rests.get(to, step + 2) or (to, step + 1) in before:
                    continue
                before[to, step + 1] = (cell, step)
                heapq.heappush(queue, (step + 1 + distance(to), step + 1, to))
        return None


class Crowd(dp.PedestrianModel):
    """Straight to the target"""

    id = "test.crowd"

    def step(self, people, robots, dt_s):
        way = people["target"] - people["position"]
        length = np.hypot(way[:, 0], way[:, 1])
        return way * (people["desired_speed"] / np.maximum(length, 1e-9))[:, None]


class Driven(dp.Metric):
    """The way that robots drive"""

    id = "test.driven"
    values = [dp.value("driven", "m", "lower", "length of the poses' polyline", subjects=("system", "robot"))]

    def measure(self, trace):
        steps = np.diff(trace.robots["pose"][:, :, :2], axis=0)
        driven = np.hypot(steps[:, :, 0], steps[:, :, 1]).sum(axis=0)
        assert len(trace.plan) == len(driven) and len(trace.t_ns) == len(trace.robots)
        return {"driven": {"system": driven.mean(), "robot": driven}}
