// SPDX-License-Identifier: MIT
#include "tests/rimea/metrics/counter_flow.hpp"

#include <cmath>

#include "tests/rimea/metrics/describe_rimea.hpp"

namespace dmrp::rimea {

Descriptor CounterFlow::describe() {
  return describe_rimea("rimea.counter_flow", "Counter-flow")
      .source("lane order: Nowak, Schadschneider, Phys. Rev. E 85 (2012), doi:10.1103/PhysRevE.85.066128")
      .summary("speed and lane order of people who walk both ways")
      .value("relative_speed", "1", Direction::none, Subjects::system,
             "speed towards the target along x over the desired speed, mean over time and people")
      .value("lane_order", "1", Direction::none, Subjects::system, "0: no lanes, 1: rows of one direction each");
}

void CounterFlow::begin(const dmrp::MetricTrial&) {
  area_ = rectangle_of(lower_m, upper_m);
  people_ = relative_speeds_ = orders_ = random_orders_ = 0.0;
}

void CounterFlow::observe(const Sample& sample) {
  if (!is_due(sample.t_ns, interval_s) || seconds(sample.t_ns) <= from_s) return;
  present_.clear();
  for (const Person& person : sample.people) {
    if (!toolkit::contains(area_, person.position)) continue;
    const double direction = person.target.x > person.position.x ? 1.0 : -1.0;
    present_.push_back({person.position.y, direction});
    relative_speeds_ += direction * person.velocity.x / person.desired_speed;
  }
  add_order();
}

void CounterFlow::add_order() {
  for (const Walker& walker : present_) {
    double same = 0.0;
    double opposite = 0.0;
    for (const Walker& other : present_) {
      if (std::abs(other.y_m - walker.y_m) > 0.5 * row_width_m) continue;
      (other.direction == walker.direction ? same : opposite) += 1.0;
    }
    const double balance = (same - opposite) / (same + opposite);
    orders_ += balance * balance;
    random_orders_ += 1.0 / (same + opposite);
    ++people_;
  }
}

void CounterFlow::finish(const TrialEnd&, MetricSink& sink) {
  sink.system("relative_speed", people_ > 0.0 ? relative_speeds_ / people_ : undefined);
  const double random_share = people_ - random_orders_;
  sink.system("lane_order", random_share > 0.0 ? (orders_ - random_orders_) / random_share : undefined);
}

}  // namespace dmrp::rimea
