// SPDX-License-Identifier: MIT
// table_figure.hpp: a table as an SVG figure, set as papers set it: three rules, no lines between columns.
#pragma once

#include <string>

#include "host/export/mean_table.hpp"

namespace dmrp::host {

// Needs at least one row and one metric.
std::string table_figure(const MeanTable& table);

}  // namespace dmrp::host
