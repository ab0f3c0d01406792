// SPDX-License-Identifier: MIT
// summary_layout.hpp: which metrics the table at the end of a run shows: a data file, so that code names no plugin.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace dmrp::host {

struct SummaryTableColumn {
  std::string metric;  // name of a value; columns of metrics that were not measured are left out
  std::string header;  // the unit is put behind it
  std::uint32_t decimals = 2;
  std::string spread;  // metric that is shown as "±0.17" behind it; "" for none
};

struct SummaryLayout {
  std::vector<SummaryTableColumn> columns;
  std::string arrived;   // metric that is 1 for each robot that did its task; "" leaves it out of the closing line
  std::string contacts;  // metric whose system value counts contacts; likewise

  // Metrics that are about failing itself: a trial that ended in a fault counts as 0 in them, and the paper's rule
  // leaves no failed trial out of them.
  std::vector<std::string> counts_failures;
};

// `name` is for messages. Throws std::runtime_error.
SummaryLayout parse_summary_layout(std::string_view json, const std::string& name);
SummaryLayout read_summary_layout(const std::filesystem::path& path);

}  // namespace dmrp::host
