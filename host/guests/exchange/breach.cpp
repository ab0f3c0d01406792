// SPDX-License-Identifier: MIT
#include "host/guests/exchange/breach.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "host/results/result_bytes.hpp"

namespace dmrp::host {

namespace {

constexpr double fastest_person_mps = 5.0;  // pedestrian_model.h
constexpr const char* no_room = "the values and events of a metric in one trial take more than 32 MB";

}  // namespace

std::string breach_of(const dmrp_command& command) {
  if (std::isfinite(command.v_x) && std::isfinite(command.v_y) && std::isfinite(command.omega)) return "";
  return fmt::format("gave the command ({}, {}, {})", command.v_x, command.v_y, command.omega);
}

std::string breach_of(std::uint64_t person, dmrp_vec2 velocity) {
  if (std::hypot(velocity.x, velocity.y) <= fastest_person_mps) return "";
  return fmt::format("gave person {} the velocity ({}, {})", person, velocity.x, velocity.y);
}

std::string MetricAnswer::breach_of_robot(std::uint64_t robot) const {
  return robot < robots_ ? "" : fmt::format("robot {}, but there are {}", robot, robots_);
}

std::string MetricAnswer::breach_of_value(const MetricValue& value) const {
  const auto spec = std::find_if(info_.values.begin(), info_.values.end(),
                                 [&](const MetricValueSpec& one) { return one.name == value.metric; });
  if (spec == info_.values.end()) return "its descriptor does not declare it";
  if (value.subject_kind > DMRP_SUBJECT_PEDESTRIAN || !(spec->subjects & (1u << value.subject_kind)))
    return fmt::format("its descriptor declares no subject {}", value.subject_kind);
  if (value.subject.has_value() == (value.subject_kind == DMRP_SUBJECT_SYSTEM)) return "it is of another subject";
  if (value.subject_kind == DMRP_SUBJECT_ROBOT)
    if (std::string breach = breach_of_robot(*value.subject); !breach.empty()) return breach;
  if (!std::isfinite(value.value.value_or(0.0)) || !std::isfinite(value.coordinate.value_or(0.0)))
    return "it is infinite (NaN is undefined)";
  constexpr double rounding = 1e-9;
  const double given = value.value.value_or(spec->minimum);
  if (given < spec->minimum - rounding || given > spec->maximum + rounding)
    return fmt::format("it is {}, but its descriptor declares {} to {}", given, spec->minimum, spec->maximum);
  if (!spec->curve && value.coordinate) return "it has a coordinate, but is no curve";
  return "";
}

// A metric need not look at what the host answers: what had no room shows at the end.
std::string MetricAnswer::take_room(std::size_t bytes) {
  bytes_ += bytes;
  return bytes_ <= most_result_bytes ? "" : no_room;
}

std::string MetricAnswer::add(MetricValue value) {
  if (std::string breach = breach_of_value(value); !breach.empty()) return breach;
  if (!given_.emplace(value.metric, value.subject_kind, value.subject, value.coordinate).second)
    return "it was given before";
  if (std::string breach = take_room(bytes_of(value)); !breach.empty()) return breach;
  result_.values.push_back(std::move(value));
  return "";
}

std::string MetricAnswer::add(MetricEvent event) {
  if (event.to_ns < event.from_ns) return "it ends before it begins";
  if (event.severity > DMRP_SEVERITY_SERIOUS) return fmt::format("its severity is {}", event.severity);
  for (const std::uint32_t robot : event.robots)
    if (std::string breach = breach_of_robot(robot); !breach.empty()) return breach;
  if (bytes_of(event) > most_event_bytes) return "it takes more than 1 MB";
  if (std::string breach = take_room(bytes_of(event)); !breach.empty()) return breach;
  result_.events.push_back(std::move(event));
  return "";
}

std::string MetricAnswer::breach(const std::string& refused) const {
  if (bytes_ > most_result_bytes) return no_room;
  for (const MetricValueSpec& spec : info_.values) {
    const bool given = std::any_of(result_.values.begin(), result_.values.end(), [&](const MetricValue& value) {
      return value.metric == spec.name && value.subject_kind == DMRP_SUBJECT_SYSTEM;
    });
    if (!given) return fmt::format("gave no system value of {}{}", spec.name, refused);
  }
  return "";
}

}  // namespace dmrp::host
