# SPDX-License-Identifier: MIT
"""A policy for one robot: it simulates some hundred commands for a second, and takes the one that ends nearest to a
point ahead on the path without coming close to anybody. Replace step() by your own, a trained network for instance."""

import numpy as np

STATE = ("x y theta v_x v_y omega goal_x goal_y goal_theta goal_tolerance_m progress_m v_max omega_max a_max alpha_max "
         "radius_m dt_s").split()
SECONDS = np.arange(0.1, 1.55, 0.1)  # of the simulated motions
LOOK_AHEAD_M = 0.9
MARGIN_M = 0.25


class Policy:
    def __init__(self, robot, seed):
        self.random = np.random.default_rng(seed)  # the only source of random numbers; this policy needs none
        self.path = np.empty((0, 4))

    def set_path(self, path):
        """Rows of x, y, theta (NaN: any), t in seconds. The robot must stop at the last: a longer path may follow."""
        self.path = np.frombuffer(path).reshape(-1, 4)
        steps = np.hypot(*np.diff(self.path[:, :2], axis=0).T)
        self.arcs = np.concatenate(([0.0], np.cumsum(steps)))

    def step(self, state, agents):
        """The command (v_x, v_y, omega), or None if there is none: then the host brakes."""
        now = dict(zip(STATE, np.frombuffer(state)))
        agents = np.frombuffer(agents).reshape(-1, 6)  # kind (1 robot, 2 person), x, y, v_x, v_y, radius
        if len(self.path) == 0:
            return None
        end_m = self.arcs[-1]
        ahead_m = min(now["progress_m"] + LOOK_AHEAD_M, end_m)
        carrot = np.array([np.interp(ahead_m, self.arcs, self.path[:, i]) for i in (0, 1)])
        left_m = np.hypot(carrot[0] - now["x"], carrot[1] - now["y"])
        if end_m - ahead_m + left_m < 0.5 * now["goal_tolerance_m"]:
            turn = np.arctan2(np.sin(now["goal_theta"] - now["theta"]), np.cos(now["goal_theta"] - now["theta"]))
            return 0.0, 0.0, 0.0 if np.isnan(turn) else float(2.0 * turn)

        v_x, omega = self.commands(now, left_m)
        x, y = motions(now, v_x, omega)
        cost = np.hypot(x[:, -1] - carrot[0], y[:, -1] - carrot[1])
        heading = now["theta"] + omega * SECONDS[-1]
        aside = np.arctan2(carrot[1] - y[:, -1], carrot[0] - x[:, -1]) - heading
        cost += 0.2 * np.abs(np.arctan2(np.sin(aside), np.cos(aside)))
        cost += people_cost(now, agents, x, y)
        best = int(np.argmin(cost))
        if not np.isfinite(cost[best]):
            return None
        return float(v_x[best]), 0.0, float(omega[best])

    @staticmethod
    def commands(now, left_m):
        """All pairs of speeds and turn rates that the robot reaches within two ticks."""
        reach_s = 2.0 * now["dt_s"]
        fastest = min(now["v_max"], now["v_x"] + now["a_max"] * reach_s, np.sqrt(now["a_max"] * left_m))
        v_x = np.linspace(max(0.0, min(now["v_x"] - now["a_max"] * reach_s, fastest)), fastest, 9)
        span = now["alpha_max"] * reach_s
        omega = np.clip(now["omega"] + np.linspace(-span, span, 21), -now["omega_max"], now["omega_max"])
        return [grid.ravel() for grid in np.meshgrid(v_x, omega, indexing="ij")]


def motions(now, v_x, omega):
    """Where constant commands lead: a row a command, a column a time."""
    theta = now["theta"] + np.outer(omega, SECONDS)
    step_s = SECONDS[1] - SECONDS[0]
    return (now["x"] + np.cumsum(v_x[:, None] * np.cos(theta), axis=1) * step_s,
            now["y"] + np.cumsum(v_x[:, None] * np.sin(theta), axis=1) * step_s)


def people_cost(now, agents, x, y):
    """Infinite where a motion touches somebody who goes on as now; grows within the margin."""
    cost = np.zeros(len(x))
    for _, other_x, other_y, other_v_x, other_v_y, radius_m in agents:
        apart_m = np.hypot(x - other_x - other_v_x * SECONDS, y - other_y - other_v_y * SECONDS)
        gap_m = np.min(apart_m, axis=1) - radius_m - now["radius_m"]
        cost += np.where(gap_m < 0.0, np.inf, np.maximum(0.0, 1.0 - gap_m / MARGIN_M))
    return cost
