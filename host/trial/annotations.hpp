// SPDX-License-Identifier: MIT
// annotations.hpp: dmrp.annotate/1 for one plugin instance in one trial: what it says goes to the trace.
#pragma once

#include <dmrp/ext/annotate.h>

#include <cstdint>

#include "core/trace/trace_encoder.hpp"

namespace dmrp::host {

// Takes whatever a plugin says without complaint: what cannot be kept is dropped, so that no result depends on it.
class Annotations {
 public:
  // `trace` outlives it; nullptr where no annotations are kept.
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
