// SPDX-License-Identifier: MIT
#include "host/trial/annotations.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>
#include <string_view>

namespace dmrp::host {
namespace {

// The limits that ext/annotate.h states.
constexpr std::uint32_t most_poses = 1000;
constexpr std::size_t most_note_bytes = 1000;
constexpr std::size_t most_trace_bytes = std::size_t{256} << 20;

bool is_finite(const dmrp_pose& pose) {
  return std::isfinite(pose.x) && std::isfinite(pose.y) && std::isfinite(pose.theta);
}

// The first most_note_bytes bytes, without a partial UTF-8 character.
std::string_view shortened(const char* text) {
  std::size_t length = strnlen(text, most_note_bytes + 1);
  if (length > most_note_bytes) {
    --length;
    while (length > 0 && (static_cast<unsigned char>(text[length]) & 0xC0) == 0x80) --length;
  }
  return {text, length};
}

Annotations& self_of(const dmrp_annotate* annotate) {
  return *static_cast<Annotations*>(annotate->context);
}

}  // namespace

Annotations::Annotations(core::TraceEncoder* trace, core::AnnotationSource source) : trace_(trace), source_(source) {
  extension_.struct_size = sizeof(extension_);
  extension_.context = this;
  extension_.wanted = [](const dmrp_annotate* self) -> std::int32_t { return self_of(self).wanted() ? 1 : 0; };
  extension_.trajectory = [](const dmrp_annotate* self, std::uint32_t role, const dmrp_pose* poses, std::uint32_t count,
                             std::int64_t step_ns) { self_of(self).trajectory(role, poses, count, step_ns); };
  extension_.note = [](const dmrp_annotate* self, const char* text) { self_of(self).note(text); };
}

bool Annotations::wanted() const {
  return trace_ && trace_->written_bytes() < most_trace_bytes;
}

void Annotations::trajectory(std::uint32_t role, const dmrp_pose* poses, std::uint32_t count, std::int64_t step_ns) {
  if (!wanted() || !poses || step_ns < 0) return;
  if (role != DMRP_ANNOTATE_PREDICTED && role != DMRP_ANNOTATE_CANDIDATE) return;
  const dmrp_pose* const end = std::find_if_not(poses, poses + std::min(count, most_poses), is_finite);
  if (end != poses) trace_->trajectory(source_, role, std::span(poses, end), step_ns);
}

void Annotations::note(const char* text) {
  if (wanted() && text) trace_->note(source_, shortened(text));
}

}  // namespace dmrp::host
