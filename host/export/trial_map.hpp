// SPDX-License-Identifier: MIT
// trial_map.hpp: the map of a trial as a figure: the world, the plans, and the ways that robots drove and people walked.
#pragma once

#include <string>

#include "core/trace/trace_reader.hpp"

namespace dmrp::host {

// Robots have their true shapes, where they were last. People leave thin lines.
// Reads the samples of `trace`. `title`: above the map; may be empty.
std::string trial_map(core::TraceReader& trace, const std::string& title);

}  // namespace dmrp::host
