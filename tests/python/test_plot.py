# SPDX-License-Identifier: MIT
"""Plots have the findings' own numbers, a line for each combination, and nothing lies over another thing."""

from __future__ import annotations

from typing import Any

import dmrp
import numpy as np
import pytest
from conftest import CROSSING

plt = pytest.importorskip("matplotlib.pyplot")
plt.switch_backend("Agg")

from dmrp import plot  # noqa: E402


@pytest.fixture(scope="module")
def sweep(tmp_path_factory: pytest.TempPathFactory) -> dmrp.Run:
    """No people and four, by two ways of tracking, by a controller with a swept parameter and one without."""
    experiment = dmrp.Experiment(
        name="sweep",
        seed=1,
        trials=2,
        scenario=[dmrp.use(str(CROSSING), people=[0, 4])],
        global_planner=[dmrp.use("dmrp.planner.cbs", label="CBS")],
        local_controller=[
            dmrp.use("dmrp.controller.pure_pursuit", label="PP", sweep={"lookahead_dist": [0.3, 0.6]}),
            dmrp.use("dmrp.controller.orca", label="ORCA"),
        ],
        pedestrian_model=[dmrp.use("dmrp.pedestrian.social_force")],
        simulation={"time_limit_s": 15.0, "sweep": {"tracking": ["none", "visible"]}},
        record={"traces": "none"},
    )
    return experiment.run(tmp_path_factory.mktemp("runs") / "sweep", jobs=1)


@pytest.fixture(scope="module")
def course(tmp_path_factory: pytest.TempPathFactory) -> dmrp.Run:
    """A wide corridor, which pure pursuit does not pass, and a door, whose threshold lies among its levels."""
    experiment = dmrp.Experiment(
        name="course",
        seed=1,
        trials=2,
        scenario=[dmrp.use("course/corridor", levels=[1.2, 3.0]), dmrp.use("course/door", levels=[0.5, 0.8, 1.0])],
        global_planner=[dmrp.use("dmrp.planner.individual")],
        local_controller=[dmrp.use("dmrp.controller.pure_pursuit", label="PP"), dmrp.use("dmrp.controller.orca", label="ORCA")],
        pedestrian_model=[dmrp.use("dmrp.pedestrian.social_force")],
        simulation={"grid_resolution_m": 0.5, "planning_margin_m": 0.0, "step_duration_s": 0.9},
        record={"traces": "none"},
    )
    return experiment.run(tmp_path_factory.mktemp("runs") / "course", jobs=1)


def drawn(axes: Any) -> dict[str, list[tuple[float, float, float, float]]]:
    """x, mean and interval of the points of each line."""
    lines = {}
    for container in axes.containers:
        line, _, bars = container.lines
        ends = [segment[:, 1].tolist() for of_line in bars for segment in of_line.get_segments()]
        lines[container.get_label()] = [(x, y, *end) for (x, y), end in zip(line.get_xydata().tolist(), ends)]
    return lines


def labels(axes: Any) -> list[str]:
    return [tick.get_text() for tick in axes.get_xticklabels()]


def test_a_metric_over_people_has_a_line_for_each_other_combination(sweep: dmrp.Run) -> None:
    axes = plot.metric(sweep, "success", over="people", axes=plt.figure().gca())
    lines = drawn(axes)
    assert len(lines) == 6 and "PP, tracking none, lookahead_dist 0.6" in lines
    summary = sweep.summary(metrics=["success"]).sort_values("people")
    rows = summary[(summary["local_controller"] == "ORCA") & (summary["simulation.tracking"] == "visible")]
    found = np.array(lines["ORCA, tracking visible"])
    assert np.allclose(found[:, 1:], rows[["mean", "ci_low", "ci_high"]], rtol=1e-12)
    assert (axes.get_xlabel(), axes.get_ylabel(), labels(axes)) == ("people", "success", ["0", "4"])
    assert {text.get_text() for text in axes.get_legend().get_texts()} == set(lines)


def test_points_at_one_place_stand_beside_each_other(sweep: dmrp.Run) -> None:
    lines = drawn(plot.metric(sweep, "success", over="people", axes=plt.figure().gca()))
    for place in (0, 1):
        at = sorted(points[place][0] for points in lines.values())
        assert min(np.diff(at)) > 0.01 and abs(np.mean(at) - (0, 4)[place]) < 1e-9


def test_a_swept_parameter_and_a_text_are_axes(sweep: dmrp.Run) -> None:
    axes = plot.metric(sweep, "success", "local_controller.lookahead_dist", axes=plt.figure().gca())
    assert len(drawn(axes)) == 4 and labels(axes) == ["0.3", "0.6"]
    axes = plot.metric(sweep, "pfd", "simulation.tracking", axes=plt.figure().gca())
    assert len(axes.containers) == 6 and labels(axes) == ["none", "visible"] and axes.get_ylabel() == "pfd [m]"


def test_a_color_is_one_factor_and_facets_another(sweep: dmrp.Run) -> None:
    row = plot.facets(sweep, "pfd", "people", facet="simulation.tracking", color="local_controller.id")
    assert [axes.get_title() for axes in row] == ["tracking none", "tracking visible"]
    for axes in row:
        colors = {container.get_label(): container.lines[0].get_color() for container in axes.containers}
        assert len(colors) == 3 and len(set(colors.values())) == 2
        markers = [container.lines[0].get_marker() for container in axes.containers]
        assert len(set(markers[:2])) == 2
    assert len(row[0].figure.legends[0].get_texts()) == 3


def test_what_cannot_be_drawn_is_refused(sweep: dmrp.Run) -> None:
    with pytest.raises(dmrp.InputError, match="differ in .*simulation.tracking"):
        plot.metric(sweep, "pfd", over="people", by="local_controller")
    with pytest.raises(dmrp.InputError, match="has a column persons"):
        plot.metric(sweep, "pfd", over="persons")
    with pytest.raises(dmrp.InputError, match="do not differ in simulation.step_s"):
        plot.metric(sweep, "pfd", over="simulation.step_s")
    with pytest.raises(dmrp.InputError, match="no scenario of this run has levels"):
        sweep.thresholds()


def test_thresholds_lie_among_their_levels(course: dmrp.Run) -> None:
    table = course.thresholds()
    assert list(table["series"].unique()) == ["corridor", "door"] and len(table) == 4
    panels = plot.thresholds(course)
    assert labels(panels[1]) == ["1", "0.8", "0.5"]  # hard ones on the right
    assert panels[1].get_xlabel() == "width of the door [m]"
    assert [tick.get_text() for tick in panels[0].get_yticklabels()] == ["PP", "ORCA"]
    for axes, (_, test) in zip(panels, table.groupby("series", sort=False)):
        for threshold, line in zip(test["threshold"], axes.lines[1::2]):
            (at,) = line.get_xdata()
            if np.isinf(threshold):
                assert line.get_marker() == (">" if threshold < 0 else "x")
                assert at > 1 if threshold < 0 else at < 0
            else:
                assert line.get_marker() == "o" and 0 <= at <= 2
