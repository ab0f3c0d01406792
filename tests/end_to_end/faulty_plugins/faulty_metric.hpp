// SPDX-License-Identifier: MIT
// faulty_metric.hpp: counts samples, and has one fault. One class per fault: names of values are unique in a run.
#pragma once

#include <limits>
#include <stdexcept>
#include <vector>

#include "tests/end_to_end/faulty_plugins/misbehave.hpp"

namespace dmrp::test {

enum class MetricFault {
  none,
  crash,
  exit,
  memory,
  rounding,
  silent,
  infinite,
  beyond,
  undeclared,
  throw_in_begin,
  flood,
  recovers
};

constexpr const char* name_of(MetricFault fault) {
  constexpr const char* names[] = {"none",     "crash",  "exit",       "memory",         "rounding", "silent",
                                   "infinite", "beyond", "undeclared", "throw_in_begin", "flood",    "recovers"};
  return names[static_cast<int>(fault)];
}

template <MetricFault fault>
class FaultyMetric final : public dmrp::Metric {
 public:
  static dmrp::Descriptor describe() {
    return dmrp::Descriptor("test.metric." + name(), "Faulty metric, " + name(), "1.0.0")
        .license("MIT")
        .value("test_" + name(), "1", dmrp::Direction::none, dmrp::Subjects::system, "number of samples",
               fault == MetricFault::beyond ? dmrp::share_range : dmrp::ValueRange{});
  }

  void begin(const dmrp::MetricTrial&) override {
    samples_ = 0;
    if (fault == MetricFault::throw_in_begin) throw std::runtime_error("thrown on purpose");
    // a fault in the first trial of the process only: it recovers by start() and begin()
    if (fault == MetricFault::recovers && !failed_once_) {
      failed_once_ = true;
      throw std::runtime_error("thrown on purpose");
    }
  }
  void observe(const dmrp::Sample&) override {
    if (++samples_ == 10) misbehave(name());
  }
  void finish(const dmrp::TrialEnd&, dmrp::MetricSink& sink) override {
    if (fault == MetricFault::silent) return;
    const std::string value = fault == MetricFault::undeclared ? "test_other" : "test_" + name();
    sink.system(value.c_str(), fault == MetricFault::infinite ? std::numeric_limits<double>::infinity() : samples_);
    if (fault == MetricFault::flood) flood(sink);
  }

 private:
  static std::string name() { return name_of(fault); }

  // 37 MB of events; it does not look at what the host answers.
  static void flood(dmrp::MetricSink& sink) {
    const std::vector<dmrp::Subject> subjects(45'000, dmrp::robot_subject(0));
    for (int i = 0; i < 40; ++i) try {
        sink.event({"flood", 0, 0, subjects, ""});
      } catch (const std::logic_error&) {
      }
  }

  int samples_ = 0;
  bool failed_once_ = false;
};

}  // namespace dmrp::test
