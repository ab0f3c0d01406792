// SPDX-License-Identifier: MIT
// annotations.hpp: dmrp.annotate/1 for one plugin instance in one trial: writes its annotations to the trace.
#pragma once

#include <dmrp/ext/annotate.h>

#include <cstdint>

#include "core/trace/trace_encoder.hpp"

namespace dmrp::host {

// Drops invalid annotations silently, so that no result depends on them.
class Annotations {
 public:
  // `trace` outlives it; nullptr if no annotations are recorded.
  Annotations(core::TraceEncoder* trace, core::AnnotationSource source);
  Annotations(const Annotations&) = delete;
  Annotations& operator=(const Annotations&) = delete;

  const dmrp_annotate* extension() const { return &extension_; }

 private:
  bool wanted() const;
  void trajectory(std::uint32_t role, const dmrp_pose* poses, std::uint32_t count, std::int64_t step_ns);
  void note(const char* text);

  core::TraceEncoder* trace_;
  core::AnnotationSource source_;
  dmrp_annotate extension_{};
};

}  // namespace dmrp::host
