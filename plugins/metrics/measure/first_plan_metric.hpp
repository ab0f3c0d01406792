// SPDX-License-Identifier: MIT
// first_plan_metric.hpp: the base of metrics that look at the first plan alone, not at what the robots then do.
#pragma once

#include <dmrp/plugin.hpp>

namespace dmrp::metrics {

class FirstPlanMetric : public Metric {
 public:
  void begin(const dmrp_plan* plan) final { first_plan_ = plan; }
  void observe(const Sample&) final {}

 protected:
  bool has_paths() const { return first_plan_ && first_plan_->path_count > 0; }

  const dmrp_plan* first_plan_ = nullptr;  // none if planning failed
};

}  // namespace dmrp::metrics
