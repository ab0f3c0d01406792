// SPDX-License-Identifier: MIT
// replay_scans.hpp: what the lidars of a trial saw, where that was recorded, coarser than it was: a picture needs less.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "core/trace/trace_reader.hpp"

namespace dmrp::host {

// Of one robot; null where it has no scans. `times_ms`: of the replay's samples. All scans of a robot have the same
// beams.
nlohmann::json replay_scans(const std::vector<core::TraceScan>& scans, std::uint32_t robot,
                            std::span<const std::int64_t> times_ms);

}  // namespace dmrp::host
