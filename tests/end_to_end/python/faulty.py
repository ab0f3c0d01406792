# SPDX-License-Identifier: MIT
"""Controllers that break down at 1 s, in robot 1, each in its own way; and one for whole fleets."""

import ctypes
import os
import subprocess

import numpy as np

import dmrp.plugin as dp
import helper


class Faulty(dp.LocalController):
    id = "test.faulty"
    fault: str = dp.choice("none", ["none", "exception", "null", "loop", "exit", "subprocess", "nan", "shape", "dtype",
                                    "write", "memory"])  # fmt: skip

    def step(self, now):
        if self.robot != 1 or now.t_s < 1.0 or self.fault == "none":
            return helper.STILL
        if self.fault == "exception":
            raise ValueError("no idea")
        if self.fault == "null":
            ctypes.string_at(0)
        while self.fault == "loop":
            pass
        if self.fault == "exit":
            os._exit(0)
        if self.fault == "subprocess":
            subprocess.run(["true"])
        if self.fault == "shape":
            return 0.0, 0.0
        if self.fault == "dtype":
            return "fast", "slow", "left"
        if self.fault == "write":
            now.pose[0] = 1.0
        if self.fault == "memory":
            self.kept = np.ones(1 << 40)
        return 0.0, 0.0, float("nan")


class Central(dp.CentralController):
    id = "test.central"
    wrong: bool = dp.boolean(False, help="rows of another length")

    def start(self, world, seed):
        self.speed = world.robots[0].limits["v_max"]
        self.paths = {}

    def set_path(self, robot, path):
        self.paths[robot] = np.array(path)

    def step(self, fleet):
        x = fleet.features(agents=4)
        assert x.shape == (len(fleet), 18 + 6 * 4) and x.dtype == np.float32
        assert len(fleet.goal) == len(fleet) and fleet.pose.shape == (len(fleet), 3)
        if self.wrong:
            return np.zeros((len(fleet), 2))
        turn = np.arctan2(x[:, 7], x[:, 6])
        out = np.zeros((len(fleet), 3))
        out[:, 0], out[:, 2] = 0.5 * self.speed * (np.abs(turn) < 0.5), turn
        return out
