// SPDX-License-Identifier: MIT
#include "reciprocal/linear_program.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace dmrp::reciprocal {

namespace {

// Velocities and sines below this are rounding errors.
constexpr double tolerance = 1e-9;

// The two objectives: the velocity nearest to a point, and the one farthest along a direction.
struct NearestTo {
  Vec2 wish;

  // The optimum on the line, as a multiple of its direction between `low` and `high`.
  double best_along(const HalfPlane& line, double low, double high) const {
    return std::clamp(toolkit::dot(line.direction, wish - line.point), low, high);
  }
};

struct FarthestAlong {
  Vec2 way;

  double best_along(const HalfPlane& line, double low, double high) const {
    return toolkit::dot(line.direction, way) > 0.0 ? high : low;
  }
};

// The best velocity on the border of planes[index] within the disc and all planes before it. False if there is none.
template <class Objective>
bool best_on_border(const std::vector<HalfPlane>& planes, std::size_t index, double max_speed,
                    const Objective& objective, Vec2& best) {
  const HalfPlane& line = planes[index];
  const double middle = -toolkit::dot(line.point, line.direction);
  const double squared_half = max_speed * max_speed + middle * middle - toolkit::squared_norm(line.point);
  if (squared_half < 0.0) return false;
  const double half = std::sqrt(squared_half);
  double low = middle - half;
  double high = middle + half;

  for (std::size_t i = 0; i < index; ++i) {
    const double sine = toolkit::cross(line.direction, planes[i].direction);
    const double outside = violation(planes[i], line.point);
    if (std::abs(sine) <= tolerance) {
      if (outside > tolerance) return false;
      continue;
    }
    // the violation of planes[i] at parameter t is outside + t * sine
    const double bound = -outside / sine;
    if (sine > 0.0) {
      high = std::min(high, bound);
    } else {
      low = std::max(low, bound);
    }
    if (low > high + tolerance) return false;
  }
  // borders that meet in one point may miss it by a rounding error
  if (low > high) low = high = 0.5 * (low + high);
  best = line.point + objective.best_along(line, low, high) * line.direction;
  return true;
}

// Adds the planes one by one; `best` is the best velocity in the disc at first. Returns the number of planes that have
// a common velocity; `best` is the best one in all of these.
template <class Objective>
std::size_t best_in_all(const std::vector<HalfPlane>& planes, double max_speed, const Objective& objective,
                        Vec2& best) {
  for (std::size_t i = 0; i < planes.size(); ++i)
    if (violation(planes[i], best) > 0.0 && !best_on_border(planes, i, max_speed, objective, best)) return i;
  return planes.size();
}

}  // namespace

Vec2 VelocityProgram::solve(const std::vector<HalfPlane>& planes, std::size_t hard_count, double max_speed,
                            Vec2 preferred) {
  assert(hard_count <= planes.size() && max_speed >= 0.0);
  const double speed = toolkit::norm(preferred);
  Vec2 best = speed > max_speed ? preferred * (max_speed / speed) : preferred;
  const std::size_t met = best_in_all(planes, max_speed, NearestTo{preferred}, best);
  if (met == planes.size()) return best;
  if (met >= hard_count) return least_violation(planes, hard_count, met, max_speed, best);
  return least_violation(planes, hard_count, hard_count, max_speed, {0.0, 0.0});  // only by rounding errors
}

// The third dimension of the linear programme is the violation allowed for all soft planes. When a plane is added, the
// optimum has the same violation of it; for each earlier plane, it lies on the side of the two borders' bisector where
// the earlier plane is violated less.
Vec2 VelocityProgram::least_violation(const std::vector<HalfPlane>& planes, std::size_t hard_count,
                                      std::size_t first_violated, double max_speed, Vec2 start) {
  Vec2 best = start;
  double allowed = 0.0;
  for (std::size_t i = first_violated; i < planes.size(); ++i) {
    const HalfPlane& newest = planes[i];
    if (violation(newest, best) <= allowed) continue;

    bisected_.assign(planes.begin(), planes.begin() + static_cast<std::ptrdiff_t>(hard_count));
    for (std::size_t j = hard_count; j < i; ++j) {
      const HalfPlane& older = planes[j];
      const double sine = toolkit::cross(newest.direction, older.direction);
      Vec2 point = 0.5 * (newest.point + older.point);
      if (std::abs(sine) > tolerance) {
        point = newest.point - newest.direction * (violation(older, newest.point) / sine);
      } else if (toolkit::dot(newest.direction, older.direction) > 0.0) {
        continue;  // parallel: the newest is the stricter one, because its violation is greater
      }
      bisected_.push_back({point, toolkit::normalized(older.direction - newest.direction)});
    }

    const Vec2 inward = toolkit::perpendicular(newest.direction);
    Vec2 candidate = inward * max_speed;
    // planes without a common velocity are a rounding error: the velocity found so far is in all of them
    if (best_in_all(bisected_, max_speed, FarthestAlong{inward}, candidate) == bisected_.size()) best = candidate;
    allowed = violation(newest, best);
  }
  return best;
}

}  // namespace dmrp::reciprocal
