// SPDX-License-Identifier: MIT
// rows.hpp: what is measured: a procedure, something true, and how often the procedure is right about it.
#pragma once

#include <cstddef>
#include <dmrp/toolkit/random.hpp>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace dmrp::bench {

// One benchmark: whether the procedure found something false, covered the truth, or found what is there.
struct Outcome {
  bool is_hit = false;
  bool is_hit_of_reference = false;  // by the procedure that the power is compared with
  double width = std::numeric_limits<double>::quiet_NaN();
};

enum class Measure { false_positives, coverage, power };

struct Row {
  std::string procedure;
  std::string truth;
  std::size_t n = 0;  // observations
  Measure measure = Measure::false_positives;
  std::optional<double>
      target;  // at most, of false positives; at least, of the others: a power's is the reference's less
               // this. None: only reported
  std::function<Outcome(toolkit::Stream&)> benchmark;
};

std::vector<Row> best_set_rows();
std::vector<Row> test_rows();
std::vector<Row> interval_rows();

struct Measured {
  double share = 0.0;  // of benchmarks that are hits
  double share_of_reference = 0.0;
  double width = 0.0;  // the mean; NaN where there is none
};
Measured measure(const Row& row, std::size_t benchmarks);

// Whether the target is met, but for three standard errors of what so many benchmarks measure.
bool meets_target(const Row& row, const Measured& measured, std::size_t benchmarks);

}  // namespace dmrp::bench
