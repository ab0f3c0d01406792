// SPDX-License-Identifier: MIT
// per_robot.hpp: a value a robot, and what the system's is made of: their mean, sum, least or greatest.
//
// All leave out what is undefined (NaN) and are undefined where nothing is left.
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

// fmin and fmax take the number where one of two is NaN.
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

// `of_robots`: one a robot, by index. `of_system` makes the system's value of them.
inline void give(MetricSink& sink, const char* name, const std::vector<double>& of_robots,
                 double (*of_system)(const std::vector<double>&)) {
  for (std::size_t robot = 0; robot < of_robots.size(); ++robot) sink.robot(name, robot, of_robots[robot]);
  sink.system(name, of_system(of_robots));
}

inline void give_mean(MetricSink& sink, const char* name, const std::vector<double>& of_robots) {
  give(sink, name, of_robots, &mean_of_defined);
}

// The same of any elements: `value_of(element)` is a robot's value.
template <class Element, class ValueOf>
std::vector<double> values_of(const std::vector<Element>& elements, ValueOf&& value_of) {
  std::vector<double> values;
  for (const Element& element : elements) values.push_back(value_of(element));
  return values;
}

}  // namespace dmrp::metrics
