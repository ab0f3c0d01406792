// SPDX-License-Identifier: MIT
// broad_phase.hpp: which bodies may meet, by FCL's dynamic AABB trees. collision_shapes.hpp decides whether they do.
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

// Static boxes.
class BoxTree {
 public:
  explicit BoxTree(std::span<const toolkit::Rectangle> boxes);
  ~BoxTree();

  // Indices of the boxes that touch `box`, ascending. Overwrites `found`.
  void touching(const toolkit::Rectangle& box, std::vector<std::uint32_t>& found) const;

  // The smallest distance_to(index) over all boxes, and its index; the lowest index among equals. distance_to must not
  // be less than the distance from the point to the box of that index. {infinity, count} without boxes.
  std::pair<double, std::uint32_t> nearest(dmrp_vec2 point,
                                           const std::function<double(std::uint32_t)>& distance_to) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

// Moving discs.
class BodyPairs {
 public:
  BodyPairs();
  ~BodyPairs();

  // All pairs (a < b) of discs whose bounding boxes touch, in ascending order. Overwrites `found`.
  void touching(std::span<const dmrp_vec2> centers, std::span<const double> radii,
                std::vector<std::pair<std::uint32_t, std::uint32_t>>& found);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace dmrp::core
