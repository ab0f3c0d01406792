// SPDX-License-Identifier: MIT
#include "host/workers/messages.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "host/results/result_bytes.hpp"
#include "host/workers/stored_plan.hpp"
#include "host/workers/whole_number.hpp"

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

template <class T>
nlohmann::json or_null(const std::optional<T>& value) {
  return value ? nlohmann::json(*value) : nlohmann::json();
}
std::optional<double> number_or_none(const nlohmann::json& json) {
  return json.is_null() ? std::nullopt : std::optional(json.get<double>());
}

template <class T>
std::vector<T> whole_numbers(const nlohmann::json& json) {
  std::vector<T> numbers;
  for (const nlohmann::json& number : json) numbers.push_back(whole_number<T>(number));
  return numbers;
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

void to_json(nlohmann::json& json, const MetricEvent& e) {
  const nlohmann::json place = e.place ? nlohmann::json::array({e.place->x, e.place->y}) : nlohmann::json();
  json = nlohmann::json::array({e.metric, e.from_ns, e.to_ns, e.robots, e.people, e.text, e.severity, place});
}
void from_json(const nlohmann::json& json, MetricEvent& e) {
  json.at(0).get_to(e.metric);
  e.from_ns = whole_number<std::int64_t>(json.at(1));
  e.to_ns = whole_number<std::int64_t>(json.at(2));
  e.robots = whole_numbers<std::uint32_t>(json.at(3));
  e.people = whole_numbers<std::uint64_t>(json.at(4));
  json.at(5).get_to(e.text);
  e.severity = whole_number<std::uint32_t>(json.at(6));
  const nlohmann::json& place = json.at(7);
  e.place = place.is_null() ? std::nullopt : std::optional(dmrp_vec2{place.at(0), place.at(1)});
}

DMRP_FIELDS(Job, trial, stamp, trace_file, scratch_file, skip_metrics, plan, new_plan)

void to_json(nlohmann::json& json, const TimingReason& reason) {
  json = nlohmann::json::array({reason.plugin, reason.text});
}
void from_json(const nlohmann::json& json, TimingReason& reason) {
  json.at(0).get_to(reason.plugin);
  json.at(1).get_to(reason.text);
}
DMRP_FIELDS(TrialDone, outcome, timing, sim_time_s, task)

void to_json(nlohmann::json& json, const FaultRecord& f) {
  json = {{"kind", f.kind},   {"plugin", f.plugin}, {"function", f.function}, {"step", f.step},
          {"robot", f.robot}, {"signal", f.signal}, {"detail", f.detail},     {"rerun", f.rerun}};
}
void from_json(const nlohmann::json& json, FaultRecord& f) {
  json.at("kind").get_to(f.kind);
  json.at("plugin").get_to(f.plugin);
  json.at("function").get_to(f.function);
  f.step = whole_number<std::int64_t>(json.at("step"));
  f.robot = whole_number<std::int32_t>(json.at("robot"));
  f.signal = whole_number<std::int32_t>(json.at("signal"));
  json.at("detail").get_to(f.detail);
  json.at("rerun").get_to(f.rerun);
}

void to_json(nlohmann::json& json, const PlanStatistic& statistic) {
  // JSON has no infinity: as text
  json = nlohmann::json::array({statistic.name, statistic.value});
  if (!std::isfinite(statistic.value)) json[1] = fmt::format("{}", statistic.value);
}
void from_json(const nlohmann::json& json, PlanStatistic& statistic) {
  json.at(0).get_to(statistic.name);
  statistic.value =
      json.at(1).is_string() ? std::strtod(json.at(1).get<std::string>().c_str(), nullptr) : json.at(1).get<double>();
}

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
}

// An array, not an object: there are many values. JSON keeps the bits of finite doubles (shortest round trip).
void to_json(nlohmann::json& json, const MetricValue& v) {
  json = nlohmann::json::array({v.metric, v.subject_kind, or_null(v.subject), or_null(v.coordinate), or_null(v.value)});
}
void from_json(const nlohmann::json& json, MetricValue& v) {
  json.at(0).get_to(v.metric);
  v.subject_kind = whole_number<std::uint32_t>(json.at(1));
  v.subject = json.at(2).is_null() ? std::nullopt : std::optional(whole_number<std::uint64_t>(json.at(2)));
  v.coordinate = number_or_none(json.at(3));
  v.value = number_or_none(json.at(4));
}

void to_json(nlohmann::json& json, const MetricResult& result) {
  json = {{"index", result.index}, {"values", result.values}, {"events", result.events}};
}
void from_json(const nlohmann::json& json, MetricResult& result) {
  result.index = whole_number<std::uint32_t>(json.at("index"));
  json.at("values").get_to(result.values);
  json.at("events").get_to(result.events);
}

void send_in_pieces(const MetricResult& result, const std::function<void(const MetricResult& piece, bool last)>& send) {
  std::size_t value = 0;
  std::size_t event = 0;
  for (bool last = false; !last;) {
    MetricResult piece{result.index, {}, {}};
    std::size_t bytes = 0;
    fill(piece.values, bytes, result.values, value);
    fill(piece.events, bytes, result.events, event);
    last = value == result.values.size() && event == result.events.size();
    send(piece, last);
  }
}

}  // namespace dmrp::host
