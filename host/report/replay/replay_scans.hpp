// SPDX-License-Identifier: MIT
// replay_scans.hpp: the recorded lidar scans of a trial, at reduced resolution.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "core/trace/trace_reader.hpp"

namespace dmrp::host {

// The scans of one robot; null if there are none. `times_ms`: times of the replay's samples. All scans of a robot have
// the same beams.
nlohmann::json replay_scans(const std::vector<core::TraceScan>& scans, std::uint32_t robot,
                            std::span<const std::int64_t> times_ms);

}  // namespace dmrp::host
