// SPDX-License-Identifier: MIT
// replay_data.hpp: encodes a trial for the replay in a report as one JSON text, from its trace and metric events.
//
// All numbers are integers: millimetres, milliradians, milliseconds, mm/s. `D` is a list of differences (the first
// value, then increments), `R` a list of runs [sample, value, sample, value, ...] (replay_numbers.hpp), `points` a
// flat list of x and y. Optional keys carry a question mark.
//
//   {"format": 1, "trial": 17,
//    "times": D,                                    of the samples: ten a second and the last; 0 if there are none
//    "world": {"lower": [x, y], "upper": [x, y],
//              "shapes": [{"name", "height", "vertices": points | "center": [x, y], "radius"}]},
//    "robots": [{"name", "radius", "parts"?: [points], "v_max",
//                "drive"?: "holonomic" | "ackermann", "wheelbase"?,        differential if absent
//                "goals": [{"at": [x, y], "theta"?, "tolerance"}],
//                "x": D, "y": D, "theta": D,        unwrapped heading
//                "state": R, "goal": R,             DMRP_ROBOT_*, the current goal
//                "speed": D,                        negative backwards; ends with the robot's task,
//                "deviation": D,                    as does the distance from the current path; -1 without a path
//                "scans"?: {"first", "step", "beams", "samples": D, "ranges": []},       if recorded: see below
//                "failure"?, "culprit"?, "arrival"?}],     "stuck", ..., by the robot that holds or blocks it, or
//                                                   the time of arrival
//    "people": [{"id", "group", "radius", "from", "x": D, "y": D}],     from sample `from` on
//    "plans": [{"revision", "made", "from", "paths": [{"x": D, "y": D, "t": D}]}],   no paths: the planner returned no plan
//    "plan": R,                                     index of the current plan, -1 for none
//    "contacts": [{"kind": "static" | "robot" | "person", "robot", "other", "from", "to", "at": [x, y], "depth",
//                  "fault": "none" | "robot" | "other" | "both", "speed"?}],      of the impact, if known
//                                                   other: index of a shape (their number: the border) or
//                                                   of a robot, or a person's id
//    "events": [{"metric", "from", "to", "robots": [], "text"}],
//    "end"?: {"t", "reason"}}                       absent if the trace is incomplete
//
// Scans: angles in microradians; `samples`: the sample of each scan; `ranges`: the beams of all scans in centimetres, as
// differences that restart with each scan; 0 is a beam without a hit.
#pragma once

#include <cstdint>
#include <string>

#include "core/trace/trace_reader.hpp"
#include "host/results/trial_record.hpp"

namespace dmrp::host {

inline constexpr std::int64_t replay_period_ns = 100'000'000;

// Reads the whole trace.
std::string replay_json(core::TraceReader& trace, const TrialRecord& trial);

}  // namespace dmrp::host
