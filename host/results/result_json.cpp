// SPDX-License-Identifier: MIT
#include "host/results/result_json.hpp"

#include <nlohmann/json.hpp>

#include "host/results/whole_number.hpp"

namespace dmrp::host {

namespace {

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

void to_json(nlohmann::json& json, const TimingReason& reason) {
  json = nlohmann::json::array({reason.plugin, reason.text});
}
void from_json(const nlohmann::json& json, TimingReason& reason) {
  json.at(0).get_to(reason.plugin);
  json.at(1).get_to(reason.text);
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

}  // namespace dmrp::host
