# SPDX-License-Identifier: MIT
"""A policy by a small network of torch, with weights from its seed."""

import numpy as np
import torch

import dmrp.plugin as dp

torch.set_num_threads(1)


class Policy(dp.CentralController):
    """Drives all robots by one call of an untrained network"""

    id = "test.torch"

    def start(self, world, seed):
        torch.manual_seed(seed % 2**32)
        layers = (torch.nn.Linear(114, 32), torch.nn.Tanh(), torch.nn.Linear(32, 2), torch.nn.Tanh())
        self.network = torch.nn.Sequential(*layers)

    def step(self, fleet):
        with torch.no_grad():
            speeds = self.network(torch.from_numpy(fleet.features(agents=16))).numpy()
        return np.column_stack((0.15 + 0.15 * speeds[:, 0], np.zeros(len(fleet)), speeds[:, 1]))
