// SPDX-License-Identifier: MIT
#include "controllers/teb/timed_elastic_band.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/vec2.hpp>

#include "controllers/motion/drive_ability.hpp"

#

namespace dmrp::controllers::teb {

namespace {

constexpr double turn_first_rad = 0.25 * toolkit::pi;

// The maximum number of poses passed since the last cycle.
constexpr std::size_t prune_ahead = 10;

// Rounds of resizing. Each round halves intervals that are too long: ten rounds divide by up to a thousand.
constexpr int resize_rounds = 10;

double mean_heading(double from, double to) {
  return toolkit::wrap(from + 0.5 * toolkit::difference(from, to));
}

// A car-like robot that faces more than 45 degrees away from the first leg begins with the tightest arc toward it: no band
// with a kink that it cannot drive becomes one that it can.
void append_arc(TimedElasticBand& band, Vec2 to, const Limits& limits) {
  face_by_arc(band.pose(0), to, 1.0 / sharpest_curvature(limits), turn_first_rad,
              [&](const Pose& pose, double length_m) {
                band.append({pose.x, pose.y, toolkit::wrap(pose.theta)}, length_m / limits.v_max);
              });
}

// Appends a straight leg to a point, with the heading along the leg.
void append_leg(TimedElasticBand& band, Vec2 to, const Limits& limits, const Parameters& parameters) {
  const Pose from = band.pose(band.size() - 1);
  const Vec2 leg = to - toolkit::position(from);
  const double heading = std::atan2(leg.y, leg.x);
  const double reach_m = limits.v_max * parameters.dt_ref;
  const int steps = std::max(1, static_cast<int>(std::lround(toolkit::norm(leg) / reach_m)));
  for (int i = 1; i <= steps; ++i) {
    if (band.size() + 2 > parameters.max_samples) break;
    const Vec2 at = toolkit::position(from) + (static_cast<double>(i) / steps) * leg;
    const Pose last = band.pose(band.size() - 1);
    const double drive_s = toolkit::norm(leg) / steps / limits.v_max;
    const double turn_s = std::abs(toolkit::difference(last.theta, heading)) / limits.omega_max;
    band.append({at.x, at.y, heading}, std::max(drive_s, turn_s));
  }
}

}  // namespace

void TimedElasticBand::reserve(std::size_t poses) {
  x.reserve(poses);
  y.reserve(poses);
  theta.reserve(poses);
  dt.reserve(poses);
}

void TimedElasticBand::clear() {
  x.clear();
  y.clear();
  theta.clear();
  dt.clear();
}

double TimedElasticBand::duration_s() const {
  double sum = 0.0;
  for (const double t : dt) sum += t;
  return sum;
}

void TimedElasticBand::begin(const Pose& start) {
  clear();
  x.push_back(start.x);
  y.push_back(start.y);
  theta.push_back(start.theta);
}

void TimedElasticBand::append(const Pose& pose, double dt_s) {
  x.push_back(pose.x);
  y.push_back(pose.y);
  theta.push_back(pose.theta);
  dt.push_back(dt_s);
}

void TimedElasticBand::split(std::size_t i) {
  const auto at = static_cast<std::ptrdiff_t>(i + 1);
  const double half_s = 0.5 * dt[i];
  const Pose middle = {0.5 * (x[i] + x[i + 1]), 0.5 * (y[i] + y[i + 1]), mean_heading(theta[i], theta[i + 1])};
  x.insert(x.begin() + at, middle.x);
  y.insert(y.begin() + at, middle.y);
  theta.insert(theta.begin() + at, middle.theta);
  dt[i] = half_s;
  dt.insert(dt.begin() + at, half_s);
}

void TimedElasticBand::remove(std::size_t i) {
  const auto at = static_cast<std::ptrdiff_t>(i);
  const double before_s = dt[i - 1];
  x.erase(x.begin() + at);
  y.erase(y.begin() + at);
  theta.erase(theta.begin() + at);
  dt.erase(dt.begin() + at - 1);
  dt[std::min(i - 1, dt.size() - 1)] += before_s;
}

void lay_out(TimedElasticBand& band, const Pose& start, const Pose& goal, const std::vector<Vec2>& points,
             const Limits& limits, const Parameters& parameters) {
  const double reach_m = limits.v_max * parameters.dt_ref;
  band.begin(start);
  if (is_car_like(limits)) {
    const auto far = std::find_if(points.begin(), points.end(), [&](Vec2 point) {
      return toolkit::distance(toolkit::position(start), point) >= reach_m;
    });
    append_arc(band, far == points.end() ? toolkit::position(goal) : *far, limits);
  }
  for (const Vec2 point : points) {
    const Vec2 last = band.position(band.size() - 1);
    if (toolkit::distance(last, point) < reach_m) continue;
    if (toolkit::distance(point, toolkit::position(goal)) < reach_m) break;
    append_leg(band, point, limits, parameters);
  }
  append_leg(band, toolkit::position(goal), limits, parameters);
  // the last pose is the goal, with its own heading
  const std::size_t last = band.size() - 1;
  band.set_pose(last, goal);
  const double turn_s = std::abs(toolkit::difference(band.theta[last - 1], goal.theta)) / limits.omega_max;
  band.dt[last - 1] = std::max(band.dt[last - 1], turn_s);
  while (band.size() < parameters.min_samples) {
    const auto longest = std::max_element(band.dt.begin(), band.dt.end()) - band.dt.begin();
    band.split(static_cast<std::size_t>(longest));
  }
}

void move_ends(TimedElasticBand& band, const Pose& start, const Pose& goal, std::size_t min_samples) {
  const Vec2 robot = toolkit::position(start);
  std::size_t nearest = 0;
  double nearest_m = toolkit::distance(band.position(0), robot);
  const std::size_t last = std::min(band.size() > min_samples ? band.size() - min_samples : 0, prune_ahead);
  for (std::size_t i = 1; i <= last; ++i) {
    const double distance_m = toolkit::distance(band.position(i), robot);
    if (!(distance_m < nearest_m)) break;
    nearest = i;
    nearest_m = distance_m;
  }
  const auto count = static_cast<std::ptrdiff_t>(nearest);
  if (count > 0) {
    for (std::vector<double>* values : {&band.x, &band.y, &band.theta, &band.dt})
      values->erase(values->begin(), values->begin() + count);
  }
  band.set_pose(0, start);
  band.set_pose(band.size() - 1, goal);
}

void resize(TimedElasticBand& band, const Parameters& parameters) {
  const double longest_s = parameters.dt_ref + parameters.dt_hysteresis;
  const double shortest_s = parameters.dt_ref - parameters.dt_hysteresis;
  bool changed = true;
  for (int round = 0; round < resize_rounds && changed; ++round) {
    changed = false;
    for (std::size_t i = 0; i < band.dt.size(); ++i) {
      if (band.dt[i] > longest_s && band.size() < parameters.max_samples) {
        if (band.dt[i] > 2.0 * parameters.dt_ref || i + 1 == band.dt.size()) {
          band.split(i);
          ++i;
          changed = true;
        } else {
          // keeps the poses and moves the excess time to the next interval
          band.dt[i + 1] += band.dt[i] - parameters.dt_ref;
          band.dt[i] = parameters.dt_ref;
        }
      } else if (band.dt[i] < shortest_s && band.size() > parameters.min_samples) {
        const bool is_last = i + 1 == band.dt.size();
        band.remove(is_last ? i : i + 1);
        changed = true;
      }
    }
  }
}

}  // namespace dmrp::controllers::teb
