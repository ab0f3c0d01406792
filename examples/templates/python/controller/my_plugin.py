# SPDX-License-Identifier: MIT
"""A local controller that drives towards a point ahead on its path, and slows down behind people."""

import numpy as np

import dmrp.plugin as dp


class Controller(dp.LocalController):
    """Pure pursuit that slows down behind people"""

    id = "org.example.my_plugin"
    version = "0.1.0"
    look_ahead_m: float = dp.number(0.8, low=0.1, high=5.0, unit="m", help="from the robot to the point ahead")
    gain: float = dp.number(2.0, low=0.0, high=10.0, unit="1/s", help="turn rate per radian of heading error")
    headway_s: float = dp.number(1.0, low=0.1, high=5.0, unit="s", help="time kept to a person ahead")

    def start(self, world, seed):
        """A trial begins: reset all state of the previous one. Random numbers come from this seed alone."""
        self.path = np.empty((0, 2))

    def set_path(self, path):
        """It ends where the robot must stop, and is valid until the function returns: this is a copy."""
        self.path = np.column_stack((path["x"], path["y"]))
        self.arcs = np.concatenate(([0.0], np.cumsum(np.hypot(*np.diff(self.path, axis=0).T))))

    def step(self, now):
        """Called at every control tick. Use no clock: the same observations must give the same commands."""
        if len(self.path) == 0:
            return None  # the host brakes
        x, y, theta = now.pose
        end_m = self.arcs[-1]
        ahead_m = min(now.progress_m + self.look_ahead_m, end_m)
        carrot = [np.interp(ahead_m, self.arcs, self.path[:, i]) for i in (0, 1)]
        to_carrot_m = np.hypot(carrot[0] - x, carrot[1] - y)
        remaining_m = to_carrot_m + end_m - ahead_m
        if remaining_m < 0.5 * now.goal_tolerance_m:  # turn to the goal's heading, if it has one; the host sees the arrival
            turn = wrapped(now.goal[2] - theta)
            return 0.0, 0.0, 0.0 if np.isnan(turn) else self.gain * turn
        error = wrapped(np.arctan2(carrot[1] - y, carrot[0] - x) - theta)
        can_stop = np.sqrt(now.limits.a_max * remaining_m)
        v_x = min(now.limits.v_max, can_stop) * max(0.0, np.cos(error))
        return min(v_x, self.speed_behind_people(now)), 0.0, self.gain * error  # the host clips it to the robot's limits

    def speed_behind_people(self, now):
        x, y, theta = now.pose
        speed = now.limits.v_max
        for other in now.agents[now.agents["kind"] != 1]:  # the plan keeps robots apart
            way = other["pose"][:2] - (x, y)
            if abs(wrapped(np.arctan2(way[1], way[0]) - theta)) < np.pi / 3:
                gap_m = np.hypot(*way) - now.radius_m - other["radius_m"]
                speed = min(speed, max(0.0, gap_m) / self.headway_s)
        return speed


def wrapped(angle):
    return np.arctan2(np.sin(angle), np.cos(angle))
