// SPDX-License-Identifier: MIT
#include "host/guests/inside/annotations.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <string>

#include "host/errors/escaped_text.hpp"
#include "host/plugins/v1_sizes.hpp"

namespace dmrp::host {
namespace {

// The limits that ext/annotate.h states.
constexpr std::uint32_t most_poses = 1000;
constexpr std::size_t most_note_bytes = 1000;
constexpr std::size_t most_trace_bytes = std::size_t{256} << 20;

// What one request annotates beyond this is lost: no result depends on it.
constexpr std::size_t most_buffer_bytes = std::size_t{64} << 20;

constexpr std::uint32_t note_role = 0;  // the DMRP_ANNOTATE_* are those of trajectories

// What comes before the poses, or the text, of an annotation.
struct Header {
  std::uint32_t instance;
  std::uint32_t robot;
  std::uint32_t role;
  std::uint32_t bytes;  // that follow
  std::int64_t step_ns;
};

void append(AnnotationBuffer& buffer, const Header& header, const void* body) {
  if (buffer.bytes.size() + sizeof(header) + header.bytes > most_buffer_bytes) return;
  const auto add = [&](const void* bytes, std::size_t count) {
    const auto* const first = static_cast<const std::uint8_t*>(bytes);
    buffer.bytes.insert(buffer.bytes.end(), first, first + count);
  };
  add(&header, sizeof(header));
  add(body, header.bytes);
}

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

bool is_role(std::uint32_t role) {
  return role == DMRP_ANNOTATE_PREDICTED || role == DMRP_ANNOTATE_CANDIDATE;
}

// All of them as they should be: those before the first that is not finite.
std::vector<dmrp_pose> poses_in(std::span<const std::uint8_t> body) {
  std::vector<dmrp_pose> poses(std::min<std::size_t>(body.size() / sizeof(dmrp_pose), most_poses));
  if (!poses.empty()) std::memcpy(poses.data(), body.data(), poses.size() * sizeof(dmrp_pose));
  poses.erase(std::find_if_not(poses.begin(), poses.end(), is_finite), poses.end());
  return poses;
}

void record(const Header& header, std::span<const std::uint8_t> body, core::AnnotationSource about,
            core::TraceEncoder& trace) {
  if (header.role == note_role) {
    const std::string text(body.begin(), body.end());
    return trace.note(about, shortened(text.c_str()));
  }
  const std::vector<dmrp_pose> poses = poses_in(body);
  if (is_role(header.role) && header.step_ns >= 0 && !poses.empty())
    trace.trajectory(about, header.role, poses, header.step_ns);
}

}  // namespace

Annotations::Annotations(AnnotationBuffer& buffer, std::uint32_t instance) : buffer_(buffer), instance_(instance) {
  extension_.struct_size = sizeof(extension_);
  extension_.context = this;
  extension_.wanted = [](const dmrp_annotate* self) noexcept -> std::int32_t {
    return self_of(self).buffer_.wanted ? 1 : 0;
  };
  extension_.trajectory = [](const dmrp_annotate* self, const dmrp_trajectory* trajectory) noexcept {
    if (trajectory) drop_if_it_throws([&] { self_of(self).trajectory(*trajectory); });
  };
  extension_.note = [](const dmrp_annotate* self, const dmrp_note* note) noexcept {
    if (note) drop_if_it_throws([&] { self_of(self).note(*note); });
  };
}

void Annotations::trajectory(const dmrp_trajectory& theirs) {
  if (!buffer_.wanted || !has_v1_0<dmrp_trajectory>(theirs.struct_size)) return;
  const dmrp_trajectory c = copy_struct(theirs);
  if (!c.poses || c.step_ns < 0 || !is_role(c.role)) return;
  const dmrp_pose* const end = std::find_if_not(c.poses, c.poses + std::min(c.count, most_poses), is_finite);
  const auto bytes = static_cast<std::uint32_t>(static_cast<std::size_t>(end - c.poses) * sizeof(dmrp_pose));
  append(buffer_, {instance_, c.robot, c.role, bytes, c.step_ns}, c.poses);
}

void Annotations::note(const dmrp_note& theirs) {
  if (!buffer_.wanted || !has_v1_0<dmrp_note>(theirs.struct_size)) return;
  const dmrp_note c = copy_struct(theirs);
  if (!c.text) return;
  const std::size_t bytes = strnlen(c.text, most_note_bytes + 4);
  append(buffer_, {instance_, c.robot, note_role, static_cast<std::uint32_t>(bytes), 0}, c.text);
}

bool takes_annotations(const core::TraceEncoder& trace) {
  return trace.written_bytes() < most_trace_bytes;
}

void record_annotations(std::span<const std::uint8_t> bytes, const AnnotationSourceOf& source,
                        core::TraceEncoder& trace) {
  while (bytes.size() >= sizeof(Header)) {
    Header header;
    std::memcpy(&header, bytes.data(), sizeof(header));
    bytes = bytes.subspan(sizeof(header));
    if (header.bytes > bytes.size()) return;
    const auto about = source(header.instance, header.robot);
    if (about && takes_annotations(trace)) record(header, bytes.first(header.bytes), *about, trace);
    bytes = bytes.subspan(header.bytes);
  }
}

}  // namespace dmrp::host
