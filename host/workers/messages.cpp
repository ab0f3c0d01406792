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

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(MetricEvent, metric, from_ns, to_ns, robots, text)
DMRP_FIELDS(Job, trial, trace_file, scratch_file, keep_trace_of_success, skip_metrics, known_events)
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
