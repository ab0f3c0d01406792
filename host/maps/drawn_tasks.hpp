// SPDX-License-Identifier: MIT
// drawn_tasks.hpp: random tasks on a map of cells.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/maps/movingai.hpp"

namespace dmrp::host {

// Distinct starts on the free cells, each with the same probability, and distinct goals; each goal can be reached from
// its start by moves between cells that share an edge. Throws InputError if the map has too few free cells.
std::vector<MovingAiTask> draw_tasks(const core::CellMap& map, const std::string& shown_path, std::uint32_t count,
                                     std::uint64_t seed);

}  // namespace dmrp::host
