# SPDX-License-Identifier: MIT
"""Policies that do next to nothing: what a call costs."""

import numpy as np

import dmrp.plugin as dp


class Still(dp.LocalController):
    id = "bench.still"

    def step(self, now):
        return 0.0, 0.0, 0.0


class Reader(dp.LocalController):
    id = "bench.reader"

    def step(self, now):
        now.features(agents=16)
        return 0.0, 0.0, 0.0


class Fleet(dp.CentralController):
    id = "bench.fleet"

    def step(self, fleet):
        return np.zeros((len(fleet), 3))
