// SPDX-License-Identifier: MIT
#include "host/export/trial_filter.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <optional>

#include "host/errors/input_error.hpp"
#include "host/export/trials_table.hpp"
#include "host/toml/nearest_name.hpp"

namespace dmrp::host {
namespace {

constexpr std::size_t most_listed = 12;

std::optional<double> number_of(const std::string& text) {
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  return !text.empty() && *end == '\0' ? std::optional(number) : std::nullopt;
}

bool same_value(const std::string& a, const std::string& b) {
  return a == b || (number_of(a) && number_of(a) == number_of(b));
}

std::string none_of(const std::string& condition, const std::string& written, const std::vector<std::string>& known,
                    const char* kind) {
  const bool few = known.size() <= most_listed;
  return fmt::format("--where {}: '{}' is none of {}{}", condition, written,
                     few ? join_names(known) : fmt::format("the {} {} of this run", known.size(), kind),
                     did_you_mean(written, known));
}

}  // namespace

std::vector<TrialRecord> trials_where(const std::vector<std::string>& conditions, std::span<const TrialRecord> trials,
                                      const RunSettings& settings) {
  const std::vector<std::string> columns = label_columns(settings);
  std::map<std::string, std::vector<std::string>> wanted;  // by column
  for (const std::string& condition : conditions) {
    const std::size_t sign = condition.find('=');
    if (sign == std::string::npos) throw InputError(fmt::format("--where: '{}' is not KEY=VALUE", condition));
    std::string column = condition.substr(0, sign);
    if (column == "planner" || column == "controller") column = (column == "planner" ? "global_" : "local_") + column;
    const std::string value = condition.substr(sign + 1);
    if (std::find(columns.begin(), columns.end(), column) == columns.end())
      throw InputError(none_of(condition, column, columns, "columns"));
    std::vector<std::string> known;
    for (const TrialRecord& trial : trials)
      if (std::string found = label_text(column, trial, settings);
          std::find(known.begin(), known.end(), found) == known.end())
        known.push_back(std::move(found));
    if (std::none_of(known.begin(), known.end(), [&](const std::string& found) { return same_value(found, value); }))
      throw InputError(none_of(condition, value, known, "values"));
    wanted[column].push_back(value);
  }
  std::vector<TrialRecord> agreeing;
  for (const TrialRecord& trial : trials)
    if (std::all_of(wanted.begin(), wanted.end(), [&](const auto& entry) {
          const std::string text = label_text(entry.first, trial, settings);
          return std::any_of(entry.second.begin(), entry.second.end(),
                             [&](const std::string& value) { return same_value(text, value); });
        }))
      agreeing.push_back(trial);
  if (agreeing.empty())
    throw InputError(fmt::format("--where {}: no trial has all of these", fmt::join(conditions, " ")));
  return agreeing;
}

}  // namespace dmrp::host
