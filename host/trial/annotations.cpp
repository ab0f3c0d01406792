// SPDX-License-Identifier: MIT
#include "host/trial/annotations.hpp"

#include <dmrp/descriptor.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>

#include "host/errors/escaped_text.hpp"
#include "host/plugins/v1_sizes.hpp"

namespace dmrp::host {
namespace {

// The limits that ext/annotate.h states.
constexpr std::uint32_t most_poses = 1000;
constexpr std::size_t most_note_bytes = 1000;
constexpr std::size_t most_trace_bytes = std::size_t{256} << 20;

bool is_finite(const dmrp_pose& pose) {
  return std::isfinite(pose.x) && std::isfinite(pose.y) && std::isfinite(pose.theta);
}

// Escaped, and at most most_note_bytes bytes without a partial UTF-8 character.
std::string shortened(const char* text) {
  std::string out = escaped(text);
  if (out.size() <= most_note_bytes) return out;
  std::size_t length = most_note_bytes;
  while (length > 0 && (static_cast<unsigned char>(out[length]) & 0xC0) == 0x80) --length;
  out.resize(length);
  return out;
}

// No result depends on an annotation: one that cannot be recorded is lost.
template <class Body>
void drop_if_it_throws(Body&& body) noexcept {
  try {
    body();
  } catch (...) {
  }
}

Annotations& self_of(const dmrp_annotate* annotate) {
  return *static_cast<Annotations*>(annotate->context);
}

}  // namespace

Annotations::Annotations(core::TraceEncoder* trace, std::uint32_t plugin_kind, std::uint32_t first_robot,
                         std::uint32_t robot_count)
    : trace_(trace), plugin_kind_(plugin_kind), first_robot_(first_robot), robot_count_(robot_count) {
  extension_.struct_size = sizeof(extension_);
  extension_.context = this;
  extension_.wanted = [](const dmrp_annotate* self) noexcept -> std::int32_t { return self_of(self).wanted() ? 1 : 0; };
  extension_.trajectory = [](const dmrp_annotate* self, const dmrp_trajectory* trajectory) noexcept {
    if (trajectory) drop_if_it_throws([&] { self_of(self).trajectory(*trajectory); });
  };
  extension_.note = [](const dmrp_annotate* self, const dmrp_note* note) noexcept {
    if (note) drop_if_it_throws([&] { self_of(self).note(*note); });
  };
}

bool Annotations::wanted() const {
  return trace_ && trace_->written_bytes() < most_trace_bytes;
}

std::optional<core::AnnotationSource> Annotations::source(std::uint32_t robot) const {
  if (plugin_kind_ != DMRP_KIND_LOCAL_CONTROLLER) return core::AnnotationSource{plugin_kind_, 0};
  if (robot < first_robot_ || robot - first_robot_ >= robot_count_) return std::nullopt;
  return core::AnnotationSource{plugin_kind_, robot};
}

void Annotations::trajectory(const dmrp_trajectory& theirs) {
  if (!wanted() || !has_v1_0<dmrp_trajectory>(theirs.struct_size)) return;
  const dmrp_trajectory c = copy_struct(theirs);
  if (!c.poses || c.step_ns < 0 || (c.role != DMRP_ANNOTATE_PREDICTED && c.role != DMRP_ANNOTATE_CANDIDATE)) return;
  const dmrp_pose* const end = std::find_if_not(c.poses, c.poses + std::min(c.count, most_poses), is_finite);
  const auto about = source(c.robot);
  if (end != c.poses && about) trace_->trajectory(*about, c.role, std::span(c.poses, end), c.step_ns);
}

void Annotations::note(const dmrp_note& theirs) {
  if (!wanted() || !has_v1_0<dmrp_note>(theirs.struct_size)) return;
  const dmrp_note c = copy_struct(theirs);
  const auto about = source(c.robot);
  if (c.text && about) trace_->note(*about, shortened(c.text));
}

}  // namespace dmrp::host
