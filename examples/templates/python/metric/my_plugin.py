# SPDX-License-Identifier: MIT
"""A metric: the time that robots spend near people."""

import numpy as np

import dmrp.plugin as dp


class TimeNearPeople(dp.Metric):
    """How long robots are near people"""

    id = "org.example.my_plugin"
    version = "0.1.0"
    values = [dp.value("time_near_people", "s", "lower", "time nearer to a person than `near_m`", ("system", "robot"),
                       low=0.0)]
    people = True  # the trace has them
    near_m: float = dp.number(1.2, low=0.0, high=10.0, unit="m", help="distance of centres")

    def measure(self, trace):
        """Rows of trace.robots are samples, columns robots; trace.people has an array a sample."""
        time_s = np.zeros(trace.robots.shape[1])
        for i, step_s in enumerate(np.diff(trace.t_ns) * 1e-9):
            robots, people = trace.robots["pose"][i, :, :2], trace.people[i]["position"]
            if len(people):
                apart_m = np.linalg.norm(robots[:, None] - people[None], axis=2)
                time_s += step_s * (apart_m.min(axis=1) < self.near_m)
        return {"time_near_people": {"system": time_s.sum(), "robot": time_s}}
