// SPDX-License-Identifier: MIT
#include "host/workers/messages.hpp"

#include <nlohmann/json.hpp>

namespace dmrp::host {

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
  json.at(1).get_to(e.from_ns);
  json.at(2).get_to(e.to_ns);
  json.at(3).get_to(e.robots);
  json.at(4).get_to(e.people);
  json.at(5).get_to(e.text);
  json.at(6).get_to(e.severity);
  const nlohmann::json& place = json.at(7);
  e.place = place.is_null() ? std::nullopt : std::optional(dmrp_vec2{place.at(0), place.at(1)});
}

DMRP_FIELDS(Job, trial, stamp, trace_file, scratch_file, skip_metrics, known_events)
DMRP_FIELDS(TrialDone, outcome, repeatable, sim_time_s)
DMRP_FIELDS(FaultRecord, kind, plugin, function, step, robot, signal, detail, rerun)

namespace {

template <class T>
nlohmann::json or_null(const std::optional<T>& value) {
  return value ? nlohmann::json(*value) : nlohmann::json();
}
template <class T>
std::optional<T> from_null(const nlohmann::json& json) {
  return json.is_null() ? std::nullopt : std::optional<T>(json.get<T>());
}

}  // namespace

// An array, not an object: there are many values. JSON keeps the bits of finite doubles (shortest round trip).
void to_json(nlohmann::json& json, const MetricValue& v) {
  json = nlohmann::json::array({v.metric, v.subject_kind, or_null(v.subject), or_null(v.coordinate), or_null(v.value)});
}
void from_json(const nlohmann::json& json, MetricValue& v) {
  v = {json.at(0).get<std::string>(), json.at(1).get<std::uint32_t>(), from_null<std::uint64_t>(json.at(2)),
       from_null<double>(json.at(3)), from_null<double>(json.at(4))};
}

DMRP_FIELDS(MetricResult, index, values, events)

}  // namespace dmrp::host
