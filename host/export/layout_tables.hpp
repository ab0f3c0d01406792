// SPDX-License-Identifier: MIT
// layout_tables.hpp: the tables of the report's layout (host/layouts/report.json) as tables of a paper.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "host/export/mean_table.hpp"

namespace dmrp::host {

// Rows stand below their scenario, except in tables that have scenarios across. People are named only if there are
// several pedestrian models.
std::vector<TableSpec> layout_tables(const std::string& report_layout_json, std::span<const TrialRecord> trials);

// How the layout writes a metric: header, decimals, spread; its name and two decimals if it does not.
SummaryTableColumn column_of(const std::string& report_layout_json, const std::string& metric);

}  // namespace dmrp::host
