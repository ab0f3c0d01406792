# SPDX-License-Identifier: MIT
"""Plots by matplotlib. Intervals are those of summary.csv."""

from __future__ import annotations

import io
from collections.abc import Iterable, Sequence
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from .host import InputError, call_host
from .run import CSV, Run
from .trace import Trace

# Widths of columns in inches, for `plt.subplots(figsize=(width, height))`.
IEEE_COLUMN, IEEE_PAGE = 3.5, 7.16
SPRINGER_TEXT = 4.8  # llncs

_MARKERS = "osD^vP*X<>"
_LINES = ("-", "--", "-.", ":")
_ABOVE = {"loc": "lower left", "frameon": False, "fontsize": "small", "borderaxespad": 0.0}

_PLUGINS = ["global_planner", "local_controller", "pedestrian_model"]
_TEXTS = ["scenario", *_PLUGINS]
_LABELS = ["scenario", "robots", *_PLUGINS]  # of a combination, the first columns of summary.csv


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


def metric(
    run: Run,
    name: str,
    over: str,
    by: str | Sequence[str] | None = None,
    color: str | None = None,
    axes: Axes | None = None,
) -> Axes:
    """The mean of a metric over `over`, with the report's intervals; numbers on a scale, texts in order of the run.

    over, by, color: columns of summary(), also swept ones ("people", "simulation.tracking"), or parameters and settings
        as `dmrp-host export --csv` names them; "people" is their number, swept or not
    by: a line for each of its values; without it, for each combination, as long as it is the same but for `over`
    color: its values have colours, and lines of one value differ in markers and dashes; without it each line has its own

    Points at the same place stand beside each other. Combinations that fall on one point are refused."""
    chart = _Chart(run, name, over, by, color)
    axes = axes or plt.gca()
    chart.draw(axes, chart.points)
    if len(chart.lines) > 1:
        axes.legend(**_ABOVE, bbox_to_anchor=(0.0, 1.02), ncol=_legend_columns(axes.get_position().width * axes.figure.get_figwidth(), chart.lines))
    return axes


def facets(
    run: Run,
    name: str,
    over: str,
    facet: str,
    by: str | Sequence[str] | None = None,
    color: str | None = None,
    width: float = IEEE_PAGE,
) -> list[Axes]:
    """metric() once for each value of the column `facet`, beside each other with one scale and one legend."""
    chart = _Chart(run, name, over, by, color, facet)
    values = list(dict.fromkeys(chart.points[facet]))
    size = (width, max(1.6, 0.8 * width / len(values)))
    figure, row = plt.subplots(1, len(values), sharey=True, squeeze=False, figsize=size, constrained_layout=True)
    for value, axes in zip(values, row[0]):
        chart.draw(axes, chart.points[chart.points[facet] == value])
        axes.set_title(_line_name(pd.Series({facet: value})), fontsize="medium")
        axes.label_outer()
    if len(chart.lines) > 1:
        marks = [plt.Line2D([], [], label=line, **style, linewidth=1, markersize=4) for line, style in chart.lines.items()]
        figure.legend(handles=marks, **_ABOVE, bbox_to_anchor=(0.05, 1.0), ncol=_legend_columns(width, chart.lines))
    return list(row[0])


def thresholds(run: Run, width: float = IEEE_PAGE) -> list[Axes]:
    """The levels of tests that combinations pass half of the time, with their intervals: a panel for each test, hard levels
    to the right. A triangle: even the hardest level is passed; a cross: not even the easiest."""
    table = run.thresholds()
    labels = [label for label in _PLUGINS if table[label].nunique() > 1] or ["local_controller"]
    table["_name"] = table[labels].astype(str).agg(" + ".join, axis=1)
    names = list(dict.fromkeys(table["_name"]))
    tests = [rows for _, rows in table.groupby("series", sort=False)]
    columns, rows_of_panels = min(2, len(tests)), (len(tests) + 1) // 2
    size = (width if columns == 2 else 0.5 * width, rows_of_panels * (0.7 + 0.17 * len(names)))
    _, panels = plt.subplots(rows_of_panels, columns, sharey=True, squeeze=False, figsize=size, constrained_layout=True)
    drawn: list[Axes] = list(panels.flat)
    for axes, test in zip(drawn, tests):
        _draw_test(axes, test, names)
    for axes in drawn[len(tests) :]:
        axes.set_axis_off()
    return drawn[: len(tests)]


def _draw_test(axes: Axes, test: pd.DataFrame, names: list[str]) -> None:
    first = test.iloc[0]
    levels = np.array(str(first["levels"]).split(), float)[::-1]  # from the easiest
    harder = 1.0 if first["harder"] == "higher" else -1.0
    last = len(levels) - 1

    def place(level: Any) -> Any:
        return np.interp(harder * level, harder * levels, np.arange(last + 1.0), left=-0.4, right=last + 0.4)

    for row in test.to_dict("records"):
        number = names.index(row["_name"])
        at = place(row["threshold"])
        marker = "x" if at < 0 else ">" if at > last else "o"
        axes.plot(place(np.array([row["ci_low"], row["ci_high"]])), [number, number], color=f"C{number % 10}", linewidth=1)
        axes.plot([at], [number], marker, color=f"C{number % 10}", markersize=4)
    axes.set_xlim(-0.6, last + 0.6)
    axes.set_xticks(range(last + 1), [f"{level:.3g}" for level in levels])
    axes.set_ylim(len(names) - 0.5, -0.5)
    axes.set_yticks(range(len(names)), names)
    axes.grid(axis="x", linewidth=0.4)
    axes.set_title(first["title"], fontsize="medium")
    axes.set_xlabel(_with_unit(first["quantity"], first["unit"]))


class _Chart:
    """A metric's points, each with its line; lines have their styles in all facets."""

    def __init__(
        self, run: Run, name: str, over: str, by: str | Sequence[str] | None, color: str | None, facet: str | None = None
    ) -> None:
        self.over = over
        named = [by] if isinstance(by, str) else list(by or ())
        points = run.summary()  # with its index, by which rows of the file are found again
        if name not in set(points["metric"]):
            raise InputError(f"{run.path}: has no metric {name}")
        points = points[(points["metric"] == name) & (points["robots"] > 0) & points["mean"].notna()]
        for column in [over, *named, *([color] if color else []), *([facet] if facet else [])]:
            points = _with_column(run, points, column)
        points = points[points[over].notna()]
        if points[over].nunique() < 2:
            raise InputError(f"{run.path}: trials do not differ in {over}")
        factors = _factors(run, points, over)
        if over not in _LABELS:
            points = points.assign(**{_owner(over): factors[_owner(over)]})
        factors = factors.loc[:, factors.nunique(dropna=False) > 1].drop(columns=[facet or ""], errors="ignore")
        shown = points[named] if named else factors
        points = points.assign(_line=[_line_name(row) for _, row in shown.iterrows()])
        if points.duplicated([over, "_line", *([facet] if facet else [])]).any():
            differ = ", ".join(column for column in factors if column not in named)
            raise InputError(f"several combinations have the same {over} and line: they differ in {differ}; name it in `by`")
        self.points = points
        self.label = _with_unit(name, points["unit"].iloc[0])
        self.numeric = pd.api.types.is_numeric_dtype(points[over])
        self.values = sorted(points[over].unique()) if self.numeric else list(dict.fromkeys(points[over]))
        self.lines = _styles(points, color)

    def draw(self, axes: Axes, points: pd.DataFrame) -> None:
        places = np.array(self.values, float) if self.numeric else np.arange(float(len(self.values)))
        span, gap = places[-1] - places[0], float(np.diff(places).min())
        dodge = min(0.03 * span if self.numeric else 0.1, 0.6 * gap / len(self.lines))
        for number, (line, style) in enumerate(self.lines.items()):
            rows = points[points["_line"] == line].sort_values(self.over, key=lambda x: x.map(self.values.index))
            if rows.empty:
                continue
            at = places[[self.values.index(value) for value in rows[self.over]]]
            below, above = rows["mean"] - rows["ci_low"], rows["ci_high"] - rows["mean"]
            bars = np.array([below, above]).clip(0.0)  # NaN, where there is no interval, stays
            axes.errorbar(
                at + dodge * (number - 0.5 * (len(self.lines) - 1)),
                rows["mean"],
                yerr=None if np.isnan(bars).all() else bars,
                label=line,
                **style,
                capsize=2,
                linewidth=1,
                markersize=4,
            )
        ticks: list[int] = []
        for number, place in enumerate(places):
            if not ticks or not self.numeric or place - places[ticks[-1]] >= 0.08 * span:
                ticks.append(number)
        axes.set_xticks(places[ticks], [f"{self.values[tick]:g}" if self.numeric else self.values[tick] for tick in ticks])
        axes.set_xlabel(self.over)
        axes.set_ylabel(self.label)


def _styles(points: pd.DataFrame, color: str | None) -> dict[str, dict[str, str]]:
    """Color, marker and dashes of each line."""
    colors: dict[Any, int] = {}  # how many lines each has
    styles: dict[str, dict[str, str]] = {}
    for line, of_line in points.groupby("_line", sort=False):
        value = of_line[color].iloc[0] if color else line
        number = colors.setdefault(value, 0) if color else len(styles)
        colors[value] = number + 1
        styles[str(line)] = {
            "color": f"C{list(colors).index(value) % 10}",
            "marker": _MARKERS[number % len(_MARKERS)],
            "linestyle": _LINES[(number if color else number // len(_MARKERS)) % len(_LINES)],
        }
    return styles


def _legend_columns(width: float, lines: Iterable[str]) -> int:
    """As many as have room in `width` inches."""
    letter, mark = 0.06, 0.45
    return max(1, int(width / (mark + letter * max(map(len, lines)))))


def _with_unit(name: str, unit: Any) -> str:
    return name if unit == "1" or pd.isna(unit) else f"{name} [{unit}]"


def _line_name(row: pd.Series[Any]) -> str:
    words = []
    for column, value in row.items():
        if value == "" or pd.isna(value):
            continue
        word = f"{value:g}" if isinstance(value, float) else str(value)
        key = column.partition(".")[2] or column
        words.append(word if column in _TEXTS else f"{word} robots" if column == "robots" else f"{key} {word}")
    return ", ".join(words)


def _with_column(run: Run, table: pd.DataFrame, column: str) -> pd.DataFrame:
    """`table` with this parameter or setting of its combinations, which the host knows."""
    if column in table.columns:
        return table
    settings = pd.read_csv(io.StringIO(call_host(["export", run.path, "--csv"])), **CSV)
    if column not in settings.columns:
        raise InputError(f"{run.path}: neither summary.csv nor `dmrp-host export --csv` has a column {column}")
    of_combination = settings[[*_LABELS, column]].drop_duplicates(_LABELS)
    return table.reset_index().merge(of_combination, "left", _LABELS).set_index("index")


def _owner(swept: str) -> str:
    """The label that has a swept value in its text."""
    table = swept.partition(".")[0]
    return table if table in _PLUGINS else "scenario"


def _factors(run: Run, points: pd.DataFrame, over: str) -> pd.DataFrame:
    """In what combinations can differ but for `over`: labels without swept values, and these."""
    texts = pd.read_csv(run.path / "summary.csv", dtype=str, keep_default_na=False).loc[points.index]  # as labels have them
    swept = list(texts.columns[len(_LABELS) : texts.columns.get_loc("metric")])
    factors = texts[_LABELS + swept].copy()
    for label in _TEXTS:
        own = [column for column in swept if _owner(column) == label]
        for index, row in texts.iterrows():
            values = [f"{column.partition('.')[2] or column} {row[column]}" for column in own if row[column]]
            factors.loc[index, label] = row[label].removesuffix(f" ({', '.join(values)})")
    if _owner(over) != "scenario" and over not in [*swept, *_LABELS]:  # labels of one plugin with other parameters
        factors[_owner(over)] = _with_column(run, points, f"{_owner(over)}.id")[f"{_owner(over)}.id"]
    if factors["pedestrian_model"].replace("", np.nan).nunique() == 1:  # an empty world is not another crowd
        factors["pedestrian_model"] = factors["pedestrian_model"].max()
    same = {over, *(column for column in swept if _owner(column) == over)}
    if over == "people":
        same.add("people_times")
    return factors.drop(columns=list(same & set(factors.columns)))
