# SPDX-License-Identifier: MIT
"""A policy for one robot: it simulates some hundred commands for a second, and takes the one that ends nearest to a
point ahead on the path without coming close to anybody. Replace step() by your own, a trained network for instance."""

import numpy as np

import dmrp.plugin as dp

SECONDS = np.arange(0.1, 1.55, 0.1)  # of the simulated motions


class Policy(dp.LocalController):
    """Takes the best of some hundred simulated commands"""

    id = "org.example.policy"
    version = "0.2.0"
    look_ahead_m: float = dp.number(0.9, low=0.1, high=5.0, unit="m", help="from the robot to the point ahead on its path")
    margin_m: float = dp.number(0.25, low=0.01, high=2.0, unit="m", help="within which nearness to others costs")

    def start(self, world, seed):
        self.random = np.random.default_rng(seed)  # the only source of random numbers; this policy needs none
        self.path = np.empty((0, 2))

    def set_path(self, path):
        """The robot must stop at the last waypoint: a longer path may follow."""
        self.path = np.column_stack((path["x"], path["y"]))  # a copy
        steps = np.hypot(*np.diff(self.path, axis=0).T)
        self.arcs = np.concatenate(([0.0], np.cumsum(steps)))

    def step(self, now):
        """The command (v_x, v_y, omega), or None if there is none: then the host brakes."""
        if len(self.path) == 0:
            return None
        x, y, theta = now.pose
        end_m = self.arcs[-1]
        ahead_m = min(now.progress_m + self.look_ahead_m, end_m)
        carrot = np.array([np.interp(ahead_m, self.arcs, self.path[:, i]) for i in (0, 1)])
        left_m = np.hypot(carrot[0] - x, carrot[1] - y)
        if end_m - ahead_m + left_m < 0.5 * now.goal_tolerance_m:
            aside = now.goal[2] - theta
            turn = np.arctan2(np.sin(aside), np.cos(aside))
            return 0.0, 0.0, 0.0 if np.isnan(turn) else 2.0 * turn

        v_x, omega = self.commands(now, left_m)
        xs, ys = motions(now.pose, v_x, omega)
        cost = np.hypot(xs[:, -1] - carrot[0], ys[:, -1] - carrot[1])
        heading = theta + omega * SECONDS[-1]
        aside = np.arctan2(carrot[1] - ys[:, -1], carrot[0] - xs[:, -1]) - heading
        cost += 0.2 * np.abs(np.arctan2(np.sin(aside), np.cos(aside)))
        cost += self.others_cost(now, xs, ys)
        best = int(np.argmin(cost))
        if not np.isfinite(cost[best]):
            return None
        return v_x[best], 0.0, omega[best]

    @staticmethod
    def commands(now, left_m):
        """All pairs of speeds and turn rates that the robot reaches within two ticks."""
        limits, (speed, _, turning) = now.limits, now.velocity
        reach_s = 2.0 * now.dt_s
        fastest = min(limits.v_max, speed + limits.a_max * reach_s, np.sqrt(limits.a_max * left_m))
        v_x = np.linspace(max(0.0, min(speed - limits.a_max * reach_s, fastest)), fastest, 9)
        span = limits.alpha_max * reach_s
        omega = np.clip(turning + np.linspace(-span, span, 21), -limits.omega_max, limits.omega_max)
        return [grid.ravel() for grid in np.meshgrid(v_x, omega, indexing="ij")]

    def others_cost(self, now, xs, ys):
        """Infinite where a motion touches somebody who goes on as now; grows within the margin."""
        cost = np.zeros(len(xs))
        for other in now.agents:
            (x, y, _), (v_x, v_y) = other["pose"], other["velocity"]
            apart_m = np.hypot(xs - x - v_x * SECONDS, ys - y - v_y * SECONDS)
            gap_m = np.min(apart_m, axis=1) - other["radius_m"] - now.radius_m
            cost += np.where(gap_m < 0.0, np.inf, np.maximum(0.0, 1.0 - gap_m / self.margin_m))
        return cost


def motions(pose, v_x, omega):
    """Where constant commands lead: a row a command, a column a time."""
    theta = pose[2] + np.outer(omega, SECONDS)
    step_s = SECONDS[1] - SECONDS[0]
    return (pose[0] + np.cumsum(v_x[:, None] * np.cos(theta), axis=1) * step_s,
            pose[1] + np.cumsum(v_x[:, None] * np.sin(theta), axis=1) * step_s)
