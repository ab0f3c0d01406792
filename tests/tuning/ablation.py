#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""ablation.py DMRP_HOST OUT [--controllers dwa ...] [--starts 20] [--tasks 40] [--jobs 2] [--seed 661]

What each departure of a controller from its original is worth, where local routes and the collision monitor are on: the
tuned set; the same bare, without any departure but prediction; and bare with the departures that serve one need. All
drive the levels of the quick course and drawn tasks of eight robots in library, office and hospital. A departure stays
where the difference to bare excludes 0 in its favour, by more than .02 of the mean safe_success or .1 of a level's:
simultaneously over all rows of a controller. OUT keeps the runs; a call with more starts or tasks goes on.
"""

from __future__ import annotations

import argparse
import math
import re
import subprocess
import sys
from pathlib import Path

import dmrp
import pandas as pd
from scipy.stats import binomtest, t as student

COURSE = Path(__file__).resolve().parents[2] / "examples" / "driving_course_quick.toml"
WORLDS = ("library", "office", "hospital")
LEAST_OF_MEAN, LEAST_OF_LEVEL = 0.02, 0.1

# Of each controller: what a need's departures are called. All others are off in the variant; prediction, which no route
# replaces, is never off. tuned: on. All that a controller has is the tuned set, and no variant of its own.
NEEDS = {
    "dwa": {
        "turns": {"turn_to_better_heading": "true"},
        "cannot start": {"leave_padding": "true"},
        "turns and cannot start": {"turn_to_better_heading": "true", "leave_padding": "true"},
        "heavy path": {"leave_path_if_stalled": "true", "extend_path": "true"},
    },
    "teb": {
        "gaps": {"ease_from_start": "true", "ease_to_goal": "true"},
    },
    "mpc": {
        "gaps": {"ease_in_gaps": "true"},
        "makes room": {"make_room": "true"},
    },
    "e3mop": {
        "head-on": {"keep_right": "true"},
        "cannot start": {"leave_padding": "true"},
    },
    "mppi": {
        "cannot start": {"sample_forward": "true"},
    },
}


def variants(controller: str) -> dict[str, dict[str, str]]:
    """What each variant sets over the tuned set."""
    bare = {key: "false" for need in NEEDS[controller].values() for key in need}
    alone = {name: bare | need for name, need in NEEDS[controller].items() if need.keys() != bare.keys()}
    return {"tuned": {}, "bare": bare, **alone}


def uses(controllers: list[str]) -> str:
    text = ""
    for controller in controllers:
        for name, values in variants(controller).items():
            text += f'[[local_controller]]\nuse = "dmrp.controller.{controller}"\nlabel = "{controller}: {name}"\n'
            text += f'params_file = "controllers/tuned/{controller}.toml"\n'
            if values:
                text += "params = { " + ", ".join(f"{key} = {value}" for key, value in values.items()) + " }\n"
    return text + "[navigation]\nroute = \"around\"\nmonitor = true\n"


def course(controllers: list[str], starts: int, seed: int) -> str:
    """The quick course with other controllers, seed and number of starts."""
    text = re.sub(r"\[\[local_controller\]\]\n(.+\n)*\n", "", COURSE.read_text())
    text = re.sub(r"(?m)^seed .*", f"seed = {seed}", text)
    text = re.sub(r"(?m)^trials .*", f"trials = {starts}", text)
    return text + uses(controllers)


def drawn(controllers: list[str], tasks: int, seed: int) -> str:
    worlds = "".join(f'[[scenario]]\nuse = "{world}"\nrobots = 8\ntasks = {{ drawn = {tasks} }}\n' for world in WORLDS)
    return f"""[experiment]
name    = "ablation"
seed    = {seed}
trials  = {tasks}
plugins = ["libdmrp_planners.so", "libdmrp_controllers.so", "libdmrp_pedestrians.so", "libdmrp_metrics.so"]
{worlds}[[global_planner]]
use = "dmrp.planner.cbs"
[[pedestrian_model]]
use = "dmrp.pedestrian.social_force"
[[metric]]
use = "dmrp.metric.success"
[record]
traces = "none"
{uses(controllers)}"""


def drive(host: Path, out: Path, name: str, text: str, jobs: int) -> dmrp.Run:
    file = out / f"{name}.toml"
    file.write_text(text)
    run = out / name
    again = ["--resume"] if (run / "results.sqlite").exists() else []
    done = subprocess.run([host, file, "--out", run, "--jobs", str(jobs), "--quiet", *again], check=False)
    if done.returncode > 1:  # 1: a fault, which is a result
        sys.exit(done.returncode)
    return dmrp.load(run)


def safe_success(run: dmrp.Run) -> pd.DataFrame:
    """By level (or world) and repetition, a column for each variant."""
    values = run.sql(
        "SELECT t.scenario level, t.repetition, t.local_controller variant, v.value FROM trial t JOIN value v"
        " ON v.trial_id = t.id WHERE v.metric = 'safe_success' AND v.subject_kind = 'system'"
    )
    return values.pivot(index=["level", "repetition"], columns="variant", values="value").dropna()


def of_mean(difference: pd.Series, error: float) -> tuple[float, float]:
    """The mean over levels of their means, and half its interval."""
    levels = difference.groupby(level=0)
    of_levels = math.sqrt((levels.var(ddof=1) / levels.count()).sum()) / len(levels)
    return levels.mean().mean(), student.ppf(1 - error / 2, len(difference) - len(levels)) * of_levels


def levels_that(difference: pd.Series, sign: int, error: float) -> list[str]:
    """Levels whose mean differs to one side by more than LEAST_OF_LEVEL, by a test of signs."""
    found = []
    for level, values in difference.groupby(level=0):
        wins, losses = int((sign * values > 0).sum()), int((sign * values < 0).sum())
        differs = wins > losses and binomtest(wins, wins + losses).pvalue < error
        if differs and abs(values.mean()) > LEAST_OF_LEVEL:
            found.append(f"{level} {values.mean():+.2f}")
    return found


def table(controller: str, of_course: pd.DataFrame, of_tasks: pd.DataFrame) -> None:
    rows = len(NEEDS[controller]) + 1
    levels = of_course.index.get_level_values(0).nunique()
    print(f"\n| {controller} | course | against bare | levels | drawn tasks | against bare | |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    for name in variants(controller):
        cells, stays = [], False
        for values, with_levels in ((of_course, True), (of_tasks, False)):
            mine, bare = values[f"{controller}: {name}"], values[f"{controller}: bare"]
            cells.append(f"{mine.groupby(level=0).mean().mean():.3f}")
            if name == "bare":
                cells += [""] * (2 if with_levels else 1)
                continue
            mean, half = of_mean(mine - bare, 0.05 / (2 * rows))
            cells.append(f"{mean:+.3f} ± {half:.3f}")
            stays = stays or (mean - half > 0 and mean > LEAST_OF_MEAN)
            if with_levels:
                gained = levels_that(mine - bare, 1, 0.05 / (rows * levels))
                lost = levels_that(mine - bare, -1, 0.05 / (rows * levels))
                cells.append(", ".join(gained + lost))
                stays = stays or bool(gained)
        decided = name in NEEDS[controller] or len(NEEDS[controller]) == 1
        print(f"| {name} | {' | '.join(cells)} | {('stays' if stays else 'goes') if decided else ''} |")


def main() -> None:
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("host", type=Path)
    arguments.add_argument("out", type=Path)
    arguments.add_argument("--controllers", nargs="+", choices=list(NEEDS), default=list(NEEDS))
    arguments.add_argument("--starts", type=int, default=20)
    arguments.add_argument("--tasks", type=int, default=40, help="a world")
    arguments.add_argument("--jobs", type=int, default=2)
    arguments.add_argument("--seed", type=int, default=661)
    chosen = arguments.parse_args()
    chosen.out.mkdir(parents=True, exist_ok=True)
    courses = drive(chosen.host, chosen.out, "course", course(chosen.controllers, chosen.starts, chosen.seed), chosen.jobs)
    tasks = drive(chosen.host, chosen.out, "drawn", drawn(chosen.controllers, chosen.tasks, chosen.seed), chosen.jobs)
    of_course, of_tasks = safe_success(courses), safe_success(tasks)
    print(f"{chosen.starts} starts a level, {chosen.tasks} tasks a world, seed {chosen.seed}")
    for controller in chosen.controllers:
        table(controller, of_course, of_tasks)


if __name__ == "__main__":
    main()
