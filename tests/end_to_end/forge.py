# SPDX-License-Identifier: MIT
# forge.py DATABASE SQL: changes results by SQL and gives each row the digest that the host would give it
# (row_sha256() in host/results/trial_record.cpp), without digests of plans and traces.
import hashlib
import sqlite3
import struct
import sys

LARGEST = 2**64


def number(value):
    return struct.pack("<Q", value % LARGEST)


def text(value):
    return number(len(value.encode())) + value.encode()


def real(value):
    return struct.pack("<Qd", value is not None, float("inf") if value is None else value + 0.0)


def optional(value):
    return number(value is not None) + number(value or 0)


def digest(database, trial):
    (identity, scenario, robots, planner, controller, model, repetition, seed, outcome, repeatable, sim_s, wall_s,
     task, drawn) = trial
    parts = [number(identity), text(scenario), number(robots), text(planner), text(controller), text(model),
             number(repetition), number(seed), text(outcome), number(repeatable), real(sim_s), real(wall_s), text(task),
             number(drawn), text(""), text("")]
    for swept in database.execute('SELECT "table", "key", value FROM swept WHERE trial_id = ? ORDER BY rowid', (identity,)):
        parts += [text(part) for part in swept]
    kinds = ("system", "robot", "pedestrian")
    for metric, kind, subject, coordinate, value in database.execute(
            "SELECT metric, subject_kind, subject, coordinate, value FROM value WHERE trial_id = ? ORDER BY rowid",
            (identity,)):
        parts += [text(metric), number(kinds.index(kind)), optional(subject), real(coordinate), real(value)]
    return hashlib.sha256(b"".join(parts)).hexdigest()


database = sqlite3.connect(sys.argv[1])
database.execute("PRAGMA foreign_keys = ON")
database.executescript(sys.argv[2])
trials = database.execute(
    "SELECT id, scenario, robots, global_planner, local_controller, pedestrian_model, repetition, seed, outcome, "
    "repeatable, sim_time_s, wall_time_s, task, task_is_drawn FROM trial").fetchall()
for trial in trials:
    database.execute("UPDATE trial SET plan_sha256 = '', trace_sha256 = '', row_sha256 = ? WHERE id = ?",
                     (digest(database, trial), trial[0]))
database.commit()
