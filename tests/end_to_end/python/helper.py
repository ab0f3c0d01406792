# SPDX-License-Identifier: MIT
"""A module beside the plugins."""

STILL = (0.0, 0.0, 0.0)
