// SPDX-License-Identifier: MIT
// broad_phase.hpp: who is near whom, by FCL's dynamic AABB trees. FCL gives candidates; distances are exact 2-D
// geometry elsewhere, since FCL's own narrow phase differs by shape and solver at the very touch.
#pragma once

#include <dmrp/values.h>

#include <cstdint>
#include <dmrp/toolkit/rectangle.hpp>
#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace dmrp::core {

// Boxes that never move.
class BoxTree {
 public:
  explicit BoxTree(std::span<const toolkit::Rectangle> boxes);
  ~BoxTree();
  BoxTree(BoxTree&&) noexcept;
  BoxTree& operator=(BoxTree&&) noexcept;

  // Indices of the boxes that touch this one, ascending. Replaces what `found` held.
  void touching(const toolkit::Rectangle& box, std::vector<std::uint32_t>& found) const;

  // The smallest distance_to(index) over all boxes, and whose; the lowest index of several. distance_to must not be
  // less than the distance from the point to the index's box. {infinity, count} without boxes.
  std::pair<double, std::uint32_t> nearest(dmrp_vec2 point,
                                           const std::function<double(std::uint32_t)>& distance_to) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

// Discs that move.
class BodyPairs {
 public:
  BodyPairs();
  ~BodyPairs();
  BodyPairs(BodyPairs&&) noexcept;
  BodyPairs& operator=(BodyPairs&&) noexcept;

  // All pairs (a < b) of discs whose bounding boxes touch, in order. Replaces what `found` held.
  void touching(std::span<const dmrp_vec2> centers, std::span<const double> radii,
                std::vector<std::pair<std::uint32_t, std::uint32_t>>& found);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace dmrp::core
