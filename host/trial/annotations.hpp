// SPDX-License-Identifier: MIT
// annotations.hpp: dmrp.annotate/1 for one plugin instance in one trial: writes its annotations to the trace.
#pragma once

#include <dmrp/ext/annotate.h>

#include <cstdint>
#include <optional>

#include "core/trace/trace_encoder.hpp"

namespace dmrp::host {

// Drops invalid annotations silently, so that no result depends on them.
class Annotations {
 public:
  // `trace` outlives it; nullptr if no annotations are recorded. `plugin_kind`: DMRP_KIND_*. The robots that a controller
  // drives are first_robot and the robot_count - 1 after it; annotations of other plugins are not about a robot.
  Annotations(core::TraceEncoder* trace, std::uint32_t plugin_kind, std::uint32_t first_robot,
              std::uint32_t robot_count);
  Annotations(const Annotations&) = delete;
  Annotations& operator=(const Annotations&) = delete;

  const dmrp_annotate* extension() const { return &extension_; }

 private:
  bool wanted() const;
  std::optional<core::AnnotationSource> source(std::uint32_t robot) const;
  void trajectory(const dmrp_trajectory& theirs);
  void note(const dmrp_note& theirs);

  core::TraceEncoder* trace_;
  std::uint32_t plugin_kind_;
  std::uint32_t first_robot_;
  std::uint32_t robot_count_;
  dmrp_annotate extension_{};
};

}  // namespace dmrp::host
