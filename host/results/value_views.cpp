// SPDX-License-Identifier: MIT
#include "host/results/value_views.hpp"

#include <algorithm>

namespace dmrp::host {
namespace {

constexpr std::size_t most_metrics = 1900;  // SQLite's results have at most 2,000 columns

std::string quoted(const std::string& text, char quote) {
  std::string out(1, quote);
  for (const char c : text) out += c == quote ? std::string(2, quote) : std::string(1, c);
  return out + quote;
}

std::string metric_columns(std::span<const MetricColumn> metrics) {
  std::string sql;
  for (const MetricColumn& metric : metrics.first(std::min(metrics.size(), most_metrics))) {
    const std::string title =
        metric.unit.empty() || metric.unit == "1" ? metric.name : metric.name + " [" + metric.unit + "]";
    sql += ",\n  max(CASE WHEN metric = " + quoted(metric.name, '\'') + " THEN value END) AS " + quoted(title, '"');
  }
  return sql;
}

}  // namespace

std::string create_value_views(std::span<const MetricColumn> metrics) {
  const std::string columns = metric_columns(metrics);
  return "CREATE VIEW trial_values AS SELECT trial.*" + columns +
         "\nFROM trial LEFT JOIN value ON trial_id = id AND subject_kind = 'system' AND coordinate IS NULL GROUP BY "
         "id;\n"
         "CREATE VIEW robot_values AS SELECT trial_id, subject AS robot" +
         columns + "\nFROM value WHERE subject_kind = 'robot' AND coordinate IS NULL GROUP BY trial_id, subject;\n";
}

}  // namespace dmrp::host
