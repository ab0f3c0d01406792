#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""reference.py RUN OUT: makes the reference results of the suite from a run of one of its files.

OUT becomes a folder that `dmrp-host compare OUT MY_RUN` reads: the run's manifest.json without paths of its machine, and
of trials.csv the columns that say which trial a row is, the endpoint, and what the page of results compares.
"""

import csv
import json
import sys
from pathlib import Path

TRIAL = ["trial", "scenario", "robots", "global_planner", "local_controller", "pedestrian_model", "repetition", "seed", "outcome"]
TRIAL += ["task", "task_is_drawn"]
VALUES = ["safe_sct", "safe_success", "success", "completion_time", "mission_time", "path_length", "planned_length", "mean_speed"]
VALUES += ["collisions_at_fault", "sto", "ibtr", "ldf", "pfd"]


def main() -> None:
    run, out = Path(sys.argv[1]), Path(sys.argv[2])
    out.mkdir(parents=True, exist_ok=True)
    manifest = json.loads((run / "manifest.json").read_text())
    for file in manifest["files"]:
        file["path"] = Path(file["path"]).name
    manifest["command_line"] = ["dmrp-host"]
    (out / "manifest.json").write_text(json.dumps(manifest, indent=1) + "\n")
    with open(run / "trials.csv", newline="") as source, open(out / "trials.csv", "w", newline="") as target:
        rows = csv.DictReader(source)
        kept = csv.DictWriter(target, TRIAL + VALUES, extrasaction="ignore", lineterminator="\n")
        kept.writeheader()
        kept.writerows(rows)


if __name__ == "__main__":
    main()
