// SPDX-License-Identifier: MIT
// annotations.hpp: dmrp.annotate/1: a guest keeps what its instances annotate in a call; the judge writes it to the trace.
#pragma once

#include <dmrp/ext/annotate.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/trace/trace_encoder.hpp"

namespace dmrp::host {

// The annotations of one request, as bytes.
struct AnnotationBuffer {
  bool wanted = false;  // by the trace
  std::vector<std::uint8_t> bytes{};
};

// For one instance. Drops invalid annotations silently, so that no result depends on them.
class Annotations {
 public:
  // The buffer outlives it.
  Annotations(AnnotationBuffer& buffer, std::uint32_t instance);
  Annotations(const Annotations&) = delete;
  Annotations& operator=(const Annotations&) = delete;

  const dmrp_annotate* extension() const { return &extension_; }

 private:
  void trajectory(const dmrp_trajectory& theirs);
  void note(const dmrp_note& theirs);

  AnnotationBuffer& buffer_;
  std::uint32_t instance_;
  dmrp_annotate extension_{};
};

// Whether a trace still takes annotations.
bool takes_annotations(const core::TraceEncoder& trace);

// Whom an annotation of an instance about a robot is from; nothing if it is about a robot that the instance does not drive.
using AnnotationSourceOf =
    std::function<std::optional<core::AnnotationSource>(std::uint32_t instance, std::uint32_t robot)>;

// Writes the annotations of a buffer to the trace. A guest can have written anything: what cannot be is dropped.
void record_annotations(std::span<const std::uint8_t> bytes, const AnnotationSourceOf& source,
                        core::TraceEncoder& trace);

}  // namespace dmrp::host
