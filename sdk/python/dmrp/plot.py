# SPDX-License-Identifier: MIT
"""Plots by matplotlib. Intervals are those of summary.csv."""

from __future__ import annotations

from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes

from .host import InputError
from .run import Run
from .trace import Trace

# Widths of columns in inches, for `plt.subplots(figsize=(width, height))`.
IEEE_COLUMN, IEEE_PAGE = 3.5, 7.16
SPRINGER_TEXT = 4.8  # llncs

_MARKERS = "osD^vP*X<>"
_LINES = ("-", "--", "-.", ":")


def trajectories(trace: Trace, axes: Axes | None = None) -> Axes:
    """Walls and shapes, people's ways in grey, robots' ways in colour with their starts (circle) and ends (square)."""
    axes = axes or plt.gca()
    for segment in trace.world["segments"]:
        axes.plot(*zip(segment["from"].tolist(), segment["to"].tolist()), color="black", linewidth=0.6)
    for _, way in trace.people().groupby("id"):
        axes.plot(way["x"], way["y"], color="0.75", linewidth=0.5, zorder=0)
    for robot in range(trace.robots.shape[1]):
        pose = trace.robots["pose"][:, robot]
        (line,) = axes.plot(pose["x"], pose["y"], linewidth=1.2, label=trace.world["robots"][robot]["name"])
        axes.plot(pose["x"][:1], pose["y"][:1], "o", color=line.get_color(), markersize=4)
        axes.plot(pose["x"][-1:], pose["y"][-1:], "s", color=line.get_color(), markersize=4)
    axes.set_aspect("equal")
    axes.set_xlabel("x [m]")
    axes.set_ylabel("y [m]")
    return axes


def speed(trace: Trace, axes: Axes | None = None) -> Axes:
    """Each robot's speed over time."""
    axes = axes or plt.gca()
    velocity = trace.robots["velocity"]
    for robot in range(trace.robots.shape[1]):
        values = np.hypot(velocity["v_x"][:, robot], velocity["v_y"][:, robot])
        axes.plot(trace.t_ns / 1e9, values, linewidth=1, label=trace.world["robots"][robot]["name"])
    axes.set_xlabel("time [s]")
    axes.set_ylabel("speed [m/s]")
    return axes


def metric(run: Run, name: str, over: str, by: str = "local_controller", axes: Axes | None = None) -> Axes:
    """The mean of a metric over a column of summary(), with the report's intervals: a line for each value of `by`.

    Combinations that differ in another column are refused: draw facets() of that column."""
    table = run.summary(metrics=[name])
    return _lines(table, name, over, by, axes or plt.gca())


def facets(run: Run, name: str, over: str, by: str, facet: str, width: float = IEEE_PAGE) -> list[Axes]:
    """metric() once for each value of the column `facet`, beside each other with one scale."""
    table = run.summary(metrics=[name])
    values = list(dict.fromkeys(_column(table, facet)))
    _, row = plt.subplots(1, len(values), sharey=True, squeeze=False, figsize=(width, width / len(values)))
    for value, axes in zip(values, row[0]):
        _lines(table[table[facet] == value], name, over, by, axes)
        axes.set_title(f"{value}")
        axes.label_outer()
    return list(row[0])


def _column(table: Any, name: str) -> Any:
    if name not in table.columns:
        raise InputError(f"summary.csv has no column {name}")
    return table[name]


def _lines(table: Any, name: str, over: str, by: str, axes: Axes) -> Axes:
    for column in (over, by):
        _column(table, column)
    if table.duplicated([over, by]).any():
        raise InputError(f"several combinations have the same {over} and {by}: draw facets of the column that differs")
    for number, (label, rows) in enumerate(table.groupby(by, sort=False)):
        below, above = rows["mean"] - rows["ci_low"], rows["ci_high"] - rows["mean"]
        axes.errorbar(
            rows[over],
            rows["mean"],
            yerr=np.nan_to_num(np.array([below, above])),
            label=label,
            marker=_MARKERS[number % len(_MARKERS)],
            linestyle=_LINES[number // len(_MARKERS) % len(_LINES)],
            capsize=2,
            linewidth=1,
            markersize=4,
        )
    unit = table["unit"].iloc[0]
    axes.set_xlabel(over)
    axes.set_ylabel(name if unit == "1" else f"{name} [{unit}]")
    return axes
