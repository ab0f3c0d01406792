# SPDX-License-Identifier: MIT
"""A pedestrian model: everybody walks straight to the target, more slowly behind others."""

import numpy as np

import dmrp.plugin as dp


class Crowd(dp.PedestrianModel):
    """Straight to the target, more slowly behind others"""

    id = "org.example.my_plugin"
    version = "0.1.0"
    gap_m: float = dp.number(0.5, low=0.0, high=5.0, unit="m", help="at which people slow down")

    def step(self, people, robots, dt_s):
        """Velocities in m/s, a row a person. Bodies are solid: the world ends what would push them into others."""
        way = people["target"] - people["position"]
        way = way / np.maximum(np.hypot(way[:, 0], way[:, 1]), 1e-9)[:, None]
        speed = people["desired_speed"].copy()
        places = np.concatenate((people["position"], robots["pose"][:, :2]))
        radii_m = np.concatenate((people["radius_m"], robots["radius_m"]))
        for i, person in enumerate(people):
            others = places - person["position"]
            apart_m = np.hypot(others[:, 0], others[:, 1])
            is_ahead = others @ way[i] > 0.7 * np.maximum(apart_m, 1e-9)
            is_ahead[i] = False
            if is_ahead.any():
                gap_m = np.min((apart_m - radii_m - person["radius_m"])[is_ahead])
                speed[i] *= np.clip(gap_m / max(self.gap_m, 1e-9), 0.0, 1.0)
        return way * speed[:, None]
