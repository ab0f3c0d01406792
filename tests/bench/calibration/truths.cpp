// SPDX-License-Identifier: MIT
#include "tests/bench/calibration/truths.hpp"

#include <cmath>

namespace dmrp::bench {
namespace {

double exponential(toolkit::Stream& random) {
  return -std::log(1.0 - random.uniform());
}

template <class Value>
Values drawn(std::size_t entries, std::size_t tasks, Value value) {
  Values values(entries, std::vector<double>(tasks));
  for (std::size_t task = 0; task < tasks; ++task)
    for (std::size_t entry = 0; entry < entries; ++entry) values[entry][task] = value(entry, task);
  return values;
}

std::vector<double> normals(toolkit::Stream& random, std::size_t count) {
  std::vector<double> values(count);
  for (double& value : values) value = random.normal();
  return values;
}

}  // namespace

Values drawn_times(toolkit::Stream& random, std::size_t entries, std::size_t tasks, double slower) {
  const std::vector<double> difficulty = normals(random, tasks);
  return drawn(entries, tasks, [&](std::size_t entry, std::size_t task) {
    const double tail = random.chance(0.1) ? 0.3 * exponential(random) : 0.0;
    const double time = std::exp(0.3 * difficulty[task] + 0.12 * random.normal() + tail);
    return entry + 1 == entries ? time * (1.0 + slower) : time;
  });
}

Values drawn_shares(toolkit::Stream& random, std::size_t entries, std::size_t tasks, double worse) {
  constexpr int robots = 5;
  const std::vector<double> difficulty = normals(random, tasks);
  return drawn(entries, tasks, [&](std::size_t entry, std::size_t task) {
    const double arrives = 1.0 / (1.0 + std::exp(-2.2 - difficulty[task] - 0.5 * random.normal()));
    const double succeeds = entry + 1 == entries ? arrives * (1.0 - worse) : arrives;
    int arrived = 0;
    for (int robot = 0; robot < robots; ++robot) arrived += random.chance(succeeds) ? 1 : 0;
    return static_cast<double>(arrived) / robots;
  });
}

Values drawn_times_by_seeds(toolkit::Stream& random, std::size_t entries, std::size_t tasks, std::size_t seeds) {
  return drawn(entries, tasks, [&](std::size_t, std::size_t) {
    const double effect = 0.3 * random.normal();
    double sum = 0.0;
    for (std::size_t seed = 0; seed < seeds; ++seed) sum += std::exp(effect + 0.1 * random.normal());
    return sum / static_cast<double>(seeds);
  });
}

Values drawn_times_in_worlds(toolkit::Stream& random, std::size_t entries, std::size_t worlds, std::size_t tasks) {
  const Values effect = drawn(entries, worlds, [&](std::size_t, std::size_t) { return 0.3 * random.normal(); });
  return drawn(entries, worlds * tasks, [&](std::size_t entry, std::size_t task) {
    return std::exp(effect[entry][task / tasks] + 0.1 * random.normal());
  });
}

Values drawn_delays(toolkit::Stream& random, std::size_t entries, std::size_t tasks) {
  const std::vector<double> density = normals(random, tasks);
  return drawn(entries, tasks, [&](std::size_t, std::size_t task) {
    return 2.0 + density[task] + exponential(random) + 0.5 * random.normal();
  });
}

Values drawn_normals(toolkit::Stream& random, std::size_t entries, std::size_t tasks, double agreement) {
  const std::vector<double> of_task = normals(random, tasks);
  return drawn(entries, tasks, [&](std::size_t, std::size_t task) {
    return std::sqrt(agreement) * of_task[task] + std::sqrt(1.0 - agreement) * random.normal();
  });
}

}  // namespace dmrp::bench
