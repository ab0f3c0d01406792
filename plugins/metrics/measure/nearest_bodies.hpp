// SPDX-License-Identifier: MIT
// nearest_bodies.hpp: the surface distance from each of many moving bodies to the nearest of others.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <dmrp/toolkit/neighbour_grid.hpp>
#include <limits>
#include <utility>
#include <vector>

#include "metrics/measure/surface_distance.hpp"

namespace dmrp::metrics {

// The outlines of all robots, or of all people, sample by sample, and how far they move at most.
class OutlinesInTime {
 public:
  void observe_robots(const World& world, const Sample& sample) {
    begin(sample.robots.size());
    for (std::size_t robot = 0; robot < outlines_.size(); ++robot) {
      if (world.robots()[robot].footprint->part_count == 0)
        move(robot, disc_of(world.robots()[robot], sample.robots[robot]));
      else
        move(robot, outline_of(world.robots()[robot], sample.robots[robot]));
    }
    end();
  }
  void observe_people(const Sample& sample) {
    begin(sample.people.size());
    for (std::size_t person = 0; person < outlines_.size(); ++person) move(person, disc_of(sample.people[person]));
    end();
  }

  std::size_t size() const { return outlines_.size(); }
  const Outline& operator[](std::size_t body) const { return outlines_[body]; }
  double widest_m() const { return widest_m_; }  // greatest radius

  // A body moves between two samples of one list by at most the difference of these.
  double travelled_m() const { return travelled_m_; }
  // Another number after their count changed: the indices may be those of others.
  std::uint64_t list() const { return lists_; }

  // The indices of bodies that are at most distance_m away, and of some others, in ascending order.
  const std::vector<std::uint32_t>& near(Vec2 center, double distance_m) {
    if (!sorted_) grid_.build(size(), near_m, [this](std::size_t body) { return outlines_[body].disc.center; });
    sorted_ = true;
    return grid_.near(center, distance_m);
  }

 private:
  void begin(std::size_t count) {
    lists_ += count != outlines_.size();
    outlines_.resize(count);
    squared_move_ = widest_m_ = 0.0;
    sorted_ = false;
  }
  void see(std::size_t body, const Disc& disc) {
    squared_move_ = std::max(squared_move_, toolkit::squared_distance(outlines_[body].disc.center, disc.center));
    widest_m_ = std::max(widest_m_, disc.radius_m);
  }
  void move(std::size_t body, const Disc& disc) {
    see(body, disc);
    outlines_[body].disc = disc;
  }
  void move(std::size_t body, Outline&& outline) {
    see(body, outline.disc);
    outlines_[body] = std::move(outline);
  }
  void end() { travelled_m_ += std::sqrt(squared_move_); }

  std::vector<Outline> outlines_;
  toolkit::NeighbourGrid grid_;
  bool sorted_ = false;  // grid_ is of this sample
  double squared_move_ = 0.0;
  double widest_m_ = 0.0;
  double travelled_m_ = 0.0;
  std::uint64_t lists_ = 0;
};

// Gives what NearestBody gives of all bodies. Looks at those alone that were near at the last full search, while all
// others cannot be nearer: each body moves by no more than is travelled in its list.
class NearestInTime {
 public:
  // `travelled_m`: of the body itself. `except`: its index, if it is one of the others.
  double distance_m(const Outline& own, double travelled_m, OutlinesInTime& others, std::size_t except = SIZE_MAX) {
    const double travelled_by_both_m = travelled_m + others.travelled_m();
    if (list_ == others.list()) {
      const double found_m = nearest(own, others, near_, except);
      const double rounding_m = 1e-6;
      if (found_m <= beyond_m_ - (travelled_by_both_m - searched_at_m_) - rounding_m) return defined(found_m);
    }
    list_ = others.list();
    searched_at_m_ = travelled_by_both_m;
    return defined(search(own, others, except));
  }

 private:
  static constexpr double spare_m = 1.0;  // until the next search
  static constexpr std::size_t few = 16;  // of so few it is faster to look at all

  static double defined(double distance_m) { return std::isinf(distance_m) ? undefined : distance_m; }

  static double nearest(const Outline& own, const OutlinesInTime& others, const std::vector<std::uint32_t>& bodies,
                        std::size_t except) {
    NearestBody nearest(own);
    for (const std::uint32_t body : bodies)
      if (body != except) nearest.add(others[body]);
    const double found_m = nearest.distance_m();
    return std::isnan(found_m) ? std::numeric_limits<double>::infinity() : found_m;
  }

  double search(const Outline& own, OutlinesInTime& others, std::size_t except) {
    const double touching_m = own.disc.radius_m + others.widest_m();
    for (beyond_m_ = near_m;; beyond_m_ *= 2.0) {
      near_ = others.near(own.disc.center, touching_m + beyond_m_);
      const double found_m = nearest(own, others, near_, except);
      const bool all = near_.size() == others.size();
      if (!all && found_m + spare_m > beyond_m_) continue;
      if (all) beyond_m_ = others.size() <= few ? std::numeric_limits<double>::infinity() : found_m + spare_m;
      keep_near(own, others);
      return found_m;
    }
  }

  void keep_near(const Outline& own, const OutlinesInTime& others) {
    const auto is_far = [&](std::uint32_t body) { return surface_distance(own.disc, others[body].disc) > beyond_m_; };
    near_.erase(std::remove_if(near_.begin(), near_.end(), is_far), near_.end());
  }

  std::vector<std::uint32_t> near_;  // at the last full search, in ascending order: all not farther than
  double beyond_m_ = 0.0;
  double searched_at_m_ = 0.0;       // travelled by both
  std::uint64_t list_ = UINT64_MAX;  // none
};

}  // namespace dmrp::metrics
