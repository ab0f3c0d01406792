// SPDX-License-Identifier: MIT
#include "tests/rimea/metrics/evacuation.hpp"

#include "tests/rimea/metrics/describe_rimea.hpp"

namespace dmrp::rimea {

Descriptor Evacuation::describe() {
  return describe_rimea("rimea.evacuation", "Evacuation")
      .summary("time until all people have left")
      .value("evacuation_time", "s", Direction::none, Subjects::system,
             "time until the last person left; undefined if somebody stayed")
      .value("people_left_behind", "1", Direction::lower_is_better, Subjects::system, "people present at the end");
}

void Evacuation::begin(const dmrp::MetricTrial&) {
  people_ = 0;
  deserted_s_ = undefined;
}

void Evacuation::observe(const Sample& sample) {
  if (sample.people.size() == 0 && people_ > 0) deserted_s_ = seconds(sample.t_ns);
  people_ = sample.people.size();
}

void Evacuation::finish(const TrialEnd&, MetricSink& sink) {
  sink.system("evacuation_time", people_ == 0 ? deserted_s_ : undefined);
  sink.system("people_left_behind", static_cast<double>(people_));
}

}  // namespace dmrp::rimea
