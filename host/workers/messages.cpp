// SPDX-License-Identifier: MIT
#include "host/workers/messages.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "host/results/result_bytes.hpp"
#include "host/results/result_json.hpp"
#include "host/results/whole_number.hpp"
#include "host/workers/stored_plan.hpp"

namespace dmrp::host {

namespace {

constexpr std::size_t piece_bytes = 256 * 1024;  // reached by the last value or event of a piece

// Moves `from` on by as many elements as the piece has room for.
template <class T>
void fill(std::vector<T>& piece, std::size_t& bytes, const std::vector<T>& all, std::size_t& from) {
  for (; from < all.size() && bytes < piece_bytes; ++from) {
    bytes += bytes_of(all[from]);
    piece.push_back(all[from]);
  }
}

}  // namespace

// As NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE, but not inline: the header needs no json.hpp.
#define DMRP_FIELDS(Type, ...)                                                   \
  void to_json(nlohmann::json& nlohmann_json_j, const Type& nlohmann_json_t) {   \
    NLOHMANN_JSON_EXPAND(NLOHMANN_JSON_PASTE(NLOHMANN_JSON_TO, __VA_ARGS__))     \
  }                                                                              \
  void from_json(const nlohmann::json& nlohmann_json_j, Type& nlohmann_json_t) { \
    NLOHMANN_JSON_EXPAND(NLOHMANN_JSON_PASTE(NLOHMANN_JSON_FROM, __VA_ARGS__))   \
  }

DMRP_FIELDS(Job, trial, trace_file, scratch_file, plan, new_plan)

DMRP_FIELDS(TrialDone, outcome, timing, sim_time_s, task)

void to_json(nlohmann::json& json, const StoredPlan& plan) {
  json = {{"timing", plan.timing}};
  if (plan.fault) {
    json["fault"] = *plan.fault;
    json["task"] = plan.task;
    return;
  }
  json["status"] = plan.answer.status;
  json["planning_ns"] = plan.answer.planning_ns;
  json["processor_ns"] = plan.answer.processor_ns;
  json["statistics"] = plan.answer.statistics;
  json["paths_sha256"] = plan.paths_sha256;
  if (!plan.answer.text.empty()) json["text"] = plan.answer.text;
}
void from_json(const nlohmann::json& json, StoredPlan& plan) {
  json.at("timing").get_to(plan.timing);
  if (json.contains("fault")) {
    plan.fault = json.at("fault").get<FaultRecord>();
    json.at("task").get_to(plan.task);
    return;
  }
  plan.answer.status = whole_number<std::int32_t>(json.at("status"));
  plan.answer.planning_ns = whole_number<std::int64_t>(json.at("planning_ns"));
  plan.answer.processor_ns = whole_number<std::int64_t>(json.at("processor_ns"));
  json.at("statistics").get_to(plan.answer.statistics);
  json.at("paths_sha256").get_to(plan.paths_sha256);
  plan.answer.text = json.value("text", "");
}

void send_in_pieces(const MetricResult& result, const std::function<void(const MetricResult& piece)>& send) {
  std::size_t value = 0;
  std::size_t event = 0;
  for (bool last = false; !last;) {
    MetricResult piece{result.index, {}, {}};
    std::size_t bytes = 0;
    fill(piece.values, bytes, result.values, value);
    fill(piece.events, bytes, result.events, event);
    last = value == result.values.size() && event == result.events.size();
    send(piece);
  }
}

nlohmann::json json_of(const core::FlowRoutes& routes) {
  nlohmann::json json = nlohmann::json::array();
  for (const std::vector<core::Route>& legs : routes.legs) {
    nlohmann::json flow = nlohmann::json::array();
    for (const core::Route& leg : legs) {
      std::vector<double> coordinates;
      for (const dmrp_vec2& point : leg) coordinates.insert(coordinates.end(), {point.x, point.y});
      flow.push_back(std::move(coordinates));
    }
    json.push_back(std::move(flow));
  }
  return json;
}

core::FlowRoutes routes_in(const nlohmann::json& json) {
  core::FlowRoutes routes;
  for (const nlohmann::json& flow : json) {
    std::vector<core::Route>& legs = routes.legs.emplace_back();
    for (const nlohmann::json& leg : flow) {
      const auto coordinates = leg.get<std::vector<double>>();
      core::Route& route = legs.emplace_back();
      for (std::size_t i = 0; i + 1 < coordinates.size(); i += 2) route.push_back({coordinates[i], coordinates[i + 1]});
    }
  }
  return routes;
}

}  // namespace dmrp::host
