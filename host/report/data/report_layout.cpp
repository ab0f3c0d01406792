// SPDX-License-Identifier: MIT
#include "host/report/data/report_layout.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "host/files/read_file.hpp"

namespace dmrp::host {
namespace {

constexpr std::array<const char*, 8> known_keys{"replays",   "tables",      "heat_map",   "distributions",
                                                "diagnosis", "comparisons", "completion", "curves"};

ComparedMetric parse_comparison(const nlohmann::json& json) {
  ComparedMetric compared;
  for (const auto& [key, value] : json.items()) {
    if (key == "metric")
      value.get_to(compared.metric);
    else if (key == "test" && value == "signed_rank")
      compared.test = PairedTest::signed_rank;
    else if (key == "test" && value == "mean")
      compared.test = PairedTest::mean;
    else if (key == "test")
      throw std::runtime_error("'test' must be \"signed_rank\" or \"mean\"");
    else if (key == "censored")
      value.get_to(compared.censored);
    else if (key == "both_succeeded")
      value.get_to(compared.both_succeeded);
    else
      throw std::runtime_error("unknown key '" + key + "' of a comparison");
  }
  if (compared.censored && compared.both_succeeded)
    throw std::runtime_error("a comparison cannot be both 'censored' and 'both_succeeded'");
  if (compared.metric.empty()) throw std::runtime_error("a comparison without 'metric'");
  return compared;
}

ReportLayout parse(std::string_view text) {
  const nlohmann::json json = nlohmann::json::parse(text);
  if (!json.is_object()) throw std::runtime_error("not a table of keys");
  for (const auto& [key, value] : json.items())
    if (std::find(known_keys.begin(), known_keys.end(), key) == known_keys.end())
      throw std::runtime_error("unknown key '" + key + "'");

  ReportLayout layout;
  layout.json = text;
  for (const nlohmann::json& comparison : json.value("comparisons", nlohmann::json::array()))
    layout.comparisons.push_back(parse_comparison(comparison));
  if (json.contains("diagnosis")) {
    json["diagnosis"].at("x").get_to(layout.diagnosis.x);
    json["diagnosis"].at("y").get_to(layout.diagnosis.y);
  }
  if (json.contains("completion")) json["completion"].at("metric").get_to(layout.completion);
  for (const nlohmann::json& curve : json.value("curves", nlohmann::json::array()))
    layout.curves.push_back({curve.at("metric"), curve.at("coordinate"), curve.at("coordinate_unit")});
  if (json.contains("replays")) {
    json["replays"].at("rank_by").get_to(layout.replays.rank_by);
    layout.replays.budget_bytes = json["replays"].at("megabytes").get<std::size_t>() * 1'000'000;
  }
  return layout;
}

}  // namespace

ReportLayout parse_report_layout(std::string_view json, const std::string& name) {
  try {
    return parse(json);
  } catch (const std::exception& error) {
    throw std::runtime_error(name + ": " + error.what());
  }
}

ReportLayout read_report_layout(const std::filesystem::path& path) {
  return parse_report_layout(read_file(path, path.string()), path.string());
}

}  // namespace dmrp::host
