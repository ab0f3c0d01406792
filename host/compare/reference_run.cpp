// SPDX-License-Identifier: MIT
#include "host/compare/reference_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

#include "host/errors/input_error.hpp"
#include "host/files/read_file.hpp"
#include "host/files/text_lines.hpp"

namespace dmrp::host {
namespace {

namespace fs = std::filesystem;

struct Field {
  std::string text;
  std::size_t column = 1;
};

// The fields of a line of CSV (RFC 4180).
std::vector<Field> fields_of(std::string_view line) {
  std::vector<Field> fields(1);
  bool is_quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool is_doubled = is_quoted && line[i] == '"' && i + 1 < line.size() && line[i + 1] == '"';
    if (line[i] == '"' && !is_doubled) {
      is_quoted = !is_quoted;
    } else if (line[i] == ',' && !is_quoted) {
      fields.push_back({"", i + 2});
    } else {
      fields.back().text += line[i];
      if (is_doubled) ++i;
    }
  }
  return fields;
}

// The table of trials: fields by row and name of their column.
class TrialsTable {
 public:
  explicit TrialsTable(const fs::path& file) : lines_(read_file(file, file.string()), file.string()) {
    const std::vector<Field> header = fields_of(lines_.line(1));
    for (std::size_t i = 0; i < header.size(); ++i) columns_[header[i].text] = i;
  }

  std::size_t row_count() const { return lines_.count() == 0 ? 0 : lines_.count() - 1; }
  bool has(const std::string& column) const { return columns_.contains(column); }

  void read(std::size_t row) {
    line_ = row + 2;
    fields_ = fields_of(lines_.line(line_));
    if (fields_.size() != columns_.size())
      lines_.fail(line_, 1, fmt::format("has {} fields, the first line {}", fields_.size(), columns_.size()));
  }

  const std::string& text(const std::string& column) const { return field(column).text; }

  template <class Number>
  Number number(const std::string& column) const {
    const Field& field = this->field(column);
    const char* const end = field.text.data() + field.text.size();
    Number value{};
    if (const auto read = std::from_chars(field.text.data(), end, value); read.ec != std::errc() || read.ptr != end)
      lines_.fail(line_, field.column, fmt::format("{} must be a number, not '{}'", column, field.text));
    return value;
  }

 private:
  const Field& field(const std::string& column) const {
    const auto known = columns_.find(column);
    if (known == columns_.end()) lines_.fail(1, 1, fmt::format("there is no column {}", column));
    return fields_[known->second];
  }

  TextLines lines_;
  std::map<std::string, std::size_t> columns_;
  std::size_t line_ = 0;
  std::vector<Field> fields_;
};

TrialRecord trial_of(const TrialsTable& table) {
  TrialRecord trial;
  trial.id = table.number<std::uint64_t>("trial");
  trial.scenario = table.text("scenario");
  trial.robots = table.number<std::uint32_t>("robots");
  trial.global_planner = table.text("global_planner");
  trial.local_controller = table.text("local_controller");
  trial.pedestrian_model = table.text("pedestrian_model");
  trial.repetition = table.number<std::uint32_t>("repetition");
  trial.seed = table.number<std::uint64_t>("seed");
  trial.outcome = table.text("outcome");
  trial.task = table.text("task");
  trial.task_is_drawn = table.number<int>("task_is_drawn") != 0;
  return trial;
}

}  // namespace

bool is_reference_run(const fs::path& directory) {
  std::error_code ignored;
  return !fs::exists(directory / "results.sqlite", ignored) && fs::is_regular_file(directory / "trials.csv", ignored);
}

ReportRun read_reference_run(const fs::path& directory, std::span<const MetricColumn> metrics) {
  ReportRun run;
  run.manifest = read_manifest(directory / "manifest.json");
  TrialsTable table(directory / "trials.csv");
  for (const MetricColumn& metric : metrics)
    if (table.has(metric.name)) run.metrics.push_back(metric);
  for (std::size_t row = 0; row < table.row_count(); ++row) {
    table.read(row);
    TrialRecord& trial = run.trials.emplace_back(trial_of(table));
    for (const MetricColumn& metric : run.metrics) {
      MetricValue value{metric.name, DMRP_SUBJECT_SYSTEM, {}, {}, {}};
      if (!table.text(metric.name).empty()) value.value = table.number<double>(metric.name);
      trial.values.push_back(std::move(value));
    }
  }
  return run;
}

}  // namespace dmrp::host
