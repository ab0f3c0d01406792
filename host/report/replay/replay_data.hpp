// SPDX-License-Identifier: MIT
// replay_data.hpp: a trial as the report's page plays it: one JSON text, made of its trace and its metrics' events.
//
// All numbers are integers: millimetres, milliradians, milliseconds, mm/s. `D` is a list of differences (the first
// value, then what it grew by), `R` a list of runs [sample, value, sample, value, ...] (replay_numbers.hpp), `points` a
// flat list of x and y. Optional keys carry a question mark.
//
//   {"format": 1, "trial": 17,
//    "times": D,                                    of the samples: ten a second, and the trial's last; 0 without any
//    "world": {"lower": [x, y], "upper": [x, y],
//              "shapes": [{"name", "height", "vertices": points | "center": [x, y], "radius"}]},
//    "robots": [{"name", "radius", "outline"?: points, "v_max",
//                "goals": [{"at": [x, y], "theta"?, "tolerance"}],
//                "x": D, "y": D, "theta": D,        the heading goes on past pi
//                "state": R, "goal": R,             DMRP_ROBOT_*, the current goal
//                "speed": D,                        backwards is negative; ends with the robot's task,
//                "deviation": D,                    as does the distance from its path in force; -1 where it had none
//                "scans"?: {"first", "step", "beams", "samples": D, "ranges": []},       where they were recorded: see below
//                "failure"?, "arrival"?}],          "deadlock", ..., or when it arrived
//    "people": [{"id", "group", "radius", "from", "x": D, "y": D}],     from sample `from` on
//    "plans": [{"revision", "made", "from", "paths": [{"x": D, "y": D, "t": D}]}],   no paths: the planner gave none
//    "plan": R,                                     index of the plan in force, -1 for none
//    "contacts": [{"kind": "static" | "robot" | "person", "robot", "other", "from", "to", "at": [x, y], "depth",
//                  "fault": "none" | "robot" | "other" | "both", "unavoidable"}],
//                                                   other: index of the shape (their number: the border) or robot, or id
//    "events": [{"metric", "from", "to", "robots": [], "text"}],
//    "end"?: {"t", "reason"}}                       missing where the trial was cut short
//
// Scans: angles in microradians; `samples` are those they belong to, `ranges` one list of all scans' beams in centimetres,
// differences from beam to beam that begin anew with each scan, 0 where nothing was hit.
#pragma once

#include <cstdint>
#include <string>

#include "core/trace/trace_reader.hpp"
#include "host/results/trial_record.hpp"

namespace dmrp::host {

inline constexpr std::int64_t replay_period_ns = 100'000'000;

// Reads the trace from its beginning to its end.
std::string replay_json(core::TraceReader& trace, const TrialRecord& trial);

}  // namespace dmrp::host
