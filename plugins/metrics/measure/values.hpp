// SPDX-License-Identifier: MIT
// values.hpp: what metrics declare and report: values by robot, and the system's value, which is their mean, sum, minimum
// or maximum; curves over a threshold; events. Includes what every metric needs: the C++ layer, strings, vectors.
#pragma once

#include <algorithm>
#include <cmath>
#include <dmrp/plugin.hpp>
#include <functional>
#include <string>
#include <vector>

#include "metrics/measure/sums.hpp"

namespace dmrp::metrics {

using Direction::higher_is_better;
using Direction::lower_is_better;
using Subjects::system_and_robots;

inline Descriptor describe_metric(const char* id, const char* name) {
  return Descriptor(id, name, "0.1.0").vendor("dmrp").license("MIT");
}

// The system's value: skips undefined values (NaN) of robots; NaN if none is defined.
using OfSystem = double (*)(const std::vector<double>& of_robots);

inline double sum_of_defined(const std::vector<double>& values) {
  CompensatedSum sum;
  bool any = false;
  for (const double value : values) {
    if (std::isnan(value)) continue;
    sum.add(value);
    any = true;
  }
  return any ? sum.value() : undefined;
}

inline double mean_of_defined(const std::vector<double>& values) {
  const auto count = std::count_if(values.begin(), values.end(), [](double value) { return !std::isnan(value); });
  return sum_of_defined(values) / static_cast<double>(count);
}

// fmin and fmax return the number if one of two arguments is NaN.
inline double least_of_defined(const std::vector<double>& values) {
  double least = undefined;
  for (const double value : values) least = std::fmin(least, value);
  return least;
}

inline double greatest_of_defined(const std::vector<double>& values) {
  double greatest = undefined;
  for (const double value : values) greatest = std::fmax(greatest, value);
  return greatest;
}

// value_of(element), or the element's member of this name, for each element.
template <class Element, class ValueOf>
std::vector<double> values_of(const std::vector<Element>& elements, ValueOf&& value_of) {
  std::vector<double> values;
  for (const Element& element : elements) values.push_back(std::invoke(value_of, element));
  return values;
}

// Reports `of_robots`, the values by index of the robot, and of_system(of_robots) as the system's value.
inline void give(MetricSink& sink, const char* name, OfSystem of_system, const std::vector<double>& of_robots) {
  for (std::size_t robot = 0; robot < of_robots.size(); ++robot) sink.robot(name, robot, of_robots[robot]);
  sink.system(name, of_system(of_robots));
}

// Reports value_at(threshold) for each distinct threshold in ascending order, or one undefined value if there are none.
template <class ValueAt>
void give_curve(MetricSink& sink, const char* name, std::vector<double> thresholds, ValueAt&& value_at) {
  std::sort(thresholds.begin(), thresholds.end());
  thresholds.erase(std::unique(thresholds.begin(), thresholds.end()), thresholds.end());
  for (const double threshold : thresholds) sink.curve(name, threshold, value_at(threshold));
  if (thresholds.empty()) sink.system(name, undefined);
}

// A time in which something happened to a robot.
struct Spell {
  std::int64_t from_ns;
  std::int64_t to_ns;
};

// Reports an event of these robots, by index.
inline void give_event(MetricSink& sink, const char* name, Spell spell, const std::vector<std::uint32_t>& robots,
                       const std::string& text, Vec2 place = {undefined, undefined},
                       Severity severity = Severity::info) {
  std::vector<Subject> subjects;
  for (const std::uint32_t robot : robots) subjects.push_back(robot_subject(robot));
  sink.event({name, spell.from_ns, spell.to_ns, subjects, text, place, severity});
}

// A robot that circled may be excluded though it arrived.
inline bool succeeded(const RobotEnd& end) {
  return end.arrival_ns >= 0 && end.failure == DMRP_FAILURE_NONE;
}

}  // namespace dmrp::metrics
