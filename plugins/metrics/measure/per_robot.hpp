// SPDX-License-Identifier: MIT
// per_robot.hpp: values by robot, and the system's value: their mean, sum, minimum or maximum.
//
// All functions skip undefined values (NaN) and return NaN if no value is defined.
#pragma once

#include <cmath>
#include <dmrp/plugin.hpp>
#include <vector>

#include "metrics/measure/sums.hpp"

namespace dmrp::metrics {

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

// Reports `of_robots`, the values by index of the robot, and of_system(of_robots) as the system's value.
inline void give(MetricSink& sink, const char* name, const std::vector<double>& of_robots,
                 double (*of_system)(const std::vector<double>&)) {
  for (std::size_t robot = 0; robot < of_robots.size(); ++robot) sink.robot(name, robot, of_robots[robot]);
  sink.system(name, of_system(of_robots));
}

inline void give_mean(MetricSink& sink, const char* name, const std::vector<double>& of_robots) {
  give(sink, name, of_robots, &mean_of_defined);
}

// value_of(element) for each element.
template <class Element, class ValueOf>
std::vector<double> values_of(const std::vector<Element>& elements, ValueOf&& value_of) {
  std::vector<double> values;
  for (const Element& element : elements) values.push_back(value_of(element));
  return values;
}

}  // namespace dmrp::metrics
