// SPDX-License-Identifier: MIT
#include "tests/rimea/metrics/solidity.hpp"

#include <algorithm>
#include <dmrp/toolkit/shape_distance.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <numeric>

#include "tests/rimea/metrics/describe_rimea.hpp"

namespace dmrp::rimea {

Descriptor Solidity::describe() {
  return describe_rimea("rimea.solidity", "Solidity")
      .summary("whether people stay out of walls and out of each other, at every sample")
      .value("outside_free_space", "1", Direction::lower_is_better, Subjects::system,
             "people whose centre was ever inside a shape or outside the world; walls are thicker than a step, so this "
             "counts everybody who went through one")
      .value("wall_overlap", "m", Direction::lower_is_better, Subjects::system,
             "how deep somebody's body was in a wall, at most")
      .value("people_overlap", "m", Direction::lower_is_better, Subjects::system,
             "how deep two bodies were in each other, at most");
}

void Solidity::begin(const dmrp::MetricTrial&) {
  outside_.clear();
  wall_overlap_m_ = people_overlap_m_ = 0.0;
}

void Solidity::observe(const Sample& sample) {
  for (const Person& person : sample.people) observe_walls(person);
  observe_each_other(sample.people);
}

void Solidity::observe_walls(const Person& person) {
  double clearance_m = toolkit::depth({world()->lower, world()->upper}, person.position);
  for (const dmrp_shape& shape : world().shapes()) {
    const double to_bounds_m = toolkit::distance(toolkit::bounds(shape), person.position);
    if (to_bounds_m < person.radius_m)
      clearance_m = std::min(clearance_m, toolkit::signed_distance(shape, person.position));
  }
  if (clearance_m < 0.0) outside_.insert(person.id);
  wall_overlap_m_ = std::max(wall_overlap_m_, person.radius_m - clearance_m);
}

// People who overlap are close to each other in the order by x.
void Solidity::observe_each_other(const Span<Person>& people) {
  by_x_.resize(people.size());
  std::iota(by_x_.begin(), by_x_.end(), std::size_t{0});
  std::sort(by_x_.begin(), by_x_.end(),
            [&](std::size_t one, std::size_t two) { return people[one].position.x < people[two].position.x; });
  double broadest_m = 0.0;
  for (const Person& person : people) broadest_m = std::max(broadest_m, person.radius_m);
  for (std::size_t i = 0; i < by_x_.size(); ++i) {
    const Person& person = people[by_x_[i]];
    for (std::size_t j = i + 1; j < by_x_.size(); ++j) {
      const Person& other = people[by_x_[j]];
      if (other.position.x - person.position.x > person.radius_m + broadest_m) break;
      const double depth_m = person.radius_m + other.radius_m - toolkit::distance(person.position, other.position);
      people_overlap_m_ = std::max(people_overlap_m_, depth_m);
    }
  }
}

void Solidity::finish(const TrialEnd&, MetricSink& sink) {
  sink.system("outside_free_space", static_cast<double>(outside_.size()));
  sink.system("wall_overlap", wall_overlap_m_);
  sink.system("people_overlap", people_overlap_m_);
}

}  // namespace dmrp::rimea
