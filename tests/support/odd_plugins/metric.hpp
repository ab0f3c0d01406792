// SPDX-License-Identifier: MIT
// metric.hpp: one value, and one event of a robot and a person.
#pragma once

#include <dmrp/ext/walking_grid.h>
#include <dmrp/metric.h>

#include <limits>

#include "tests/support/odd_plugins/grown.hpp"
#include "tests/support/odd_plugins/instance.hpp"

namespace dmrp::test {

inline std::int32_t begin(dmrp_instance* self, const dmrp_metric_trial*) {
  return self->status_of("begin");
}

inline std::int32_t observe(dmrp_instance* self, const dmrp_sample*) {
  return self->status_of("observe");
}

// The number of free cells for people; NaN without a grid.
inline double free_cells(const dmrp_instance& self) {
  const auto* extension = static_cast<const dmrp_walking_grid*>(self.extension(DMRP_EXT_WALKING_GRID));
  const Grown<dmrp_walking_grid_request> request({0, self.is("reserved request") ? 7u : 0u, 0.5, 0.3},
                                                 self.extra("request"));
  const dmrp_grid* const grid = extension->grid(extension, request.get());
  if (!grid) return std::numeric_limits<double>::quiet_NaN();
  double count = 0.0;
  for (std::uint32_t i = 0; i < grid->width * grid->height; ++i) count += grid->free[i] != 0;
  return count;
}

inline std::int32_t finish(dmrp_instance* self, const dmrp_trial_end*, dmrp_metric_sink* sink) {
  const Grown<dmrp_metric_result> result(
      {0, DMRP_SUBJECT_SYSTEM, "odd", 0, std::numeric_limits<double>::quiet_NaN(), free_cells(*self)},
      self->extra("result"));
  if (sink->value(sink, result.get()) != DMRP_OK) return self->error("the host refuses the value");
  GrownArray<dmrp_subject> subjects(self->extra("subject"));
  subjects.push_back({DMRP_SUBJECT_ROBOT, 0, 1});
  subjects.push_back({77, 0, 9});  // of a kind that the host does not know
  subjects.push_back({DMRP_SUBJECT_PEDESTRIAN, 0, 5});
  const Grown<dmrp_event> event(
      {0, 77, "odd", 10, 20, subjects.data(), subjects.count(), subjects.stride(), {1.5, 2.5}, "a\nb"},
      self->extra("event"));
  if (sink->event(sink, event.get()) != DMRP_OK) return self->error("the host refuses the event");
  return self->status_of("finish");
}

inline constexpr dmrp_metric metric_table = {sizeof(dmrp_metric), 0, &begin, &observe, &finish};

}  // namespace dmrp::test
