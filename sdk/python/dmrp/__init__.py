# SPDX-License-Identifier: MIT
"""Runs of dmrp as Python data: experiments, results as DataFrames, traces as numpy arrays, plots, formats."""

from .experiment import Experiment, use
from .host import HostError, InputError
from .mcap import TraceError
from .run import Run, Trial, load, run

__all__ = ["Experiment", "HostError", "InputError", "Run", "TraceError", "Trial", "load", "run", "use"]
