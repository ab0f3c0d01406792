// SPDX-License-Identifier: MIT
// A controller for robots of every drive: it reads from its own robot's description what it may command, and from the
// footprint how much room it needs ahead.
#include <algorithm>
#include <cmath>
#include <dmrp/plugin.hpp>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/polyline.hpp>
#include <vector>

namespace {

namespace toolkit = dmrp::toolkit;

// How far the footprint reaches along a direction in the robot's frame.
double extent(const dmrp::Footprint& footprint, dmrp::Vec2 direction) {
  if (footprint.part_count == 0) return footprint.radius_m;
  double reach = 0.0;
  for (const dmrp::Polygon& part : dmrp::parts(footprint))
    for (std::uint32_t i = 0; i < part.vertex_count; ++i)
      reach = std::max(reach, toolkit::dot(part.vertices[i], direction));
  return reach;
}

class AnyDrive final : public dmrp::LocalController {
 public:
  static dmrp::Descriptor describe() {
    return dmrp::Descriptor("org.example.any_drive", "Any drive", "0.1.0")
        .kinematics(1u << DMRP_KINEMATICS_DIFFERENTIAL | 1u << DMRP_KINEMATICS_HOLONOMIC |
                    1u << DMRP_KINEMATICS_ACKERMANN)
        .flags(DMRP_FLAG_BACKWARDS);
  }

  dmrp::Status start(const dmrp::Start& start) override {
    path_.clear();
    reverses_ = false;
    kinematics_ = start.world.robots()[static_cast<std::size_t>(start.robot)].kinematics;
    return dmrp::Status::ok;
  }

  void set_path(dmrp::Path path, std::uint64_t) override {
    path_.assign(path.begin(), path.end());
    toolkit::arc_lengths(path_, arcs_);
  }

  dmrp::Status step(const dmrp::Observation& now, dmrp::Command& command) override {
    if (path_.empty()) return dmrp::Status::no_solution;
    const double end_m = arcs_.back();
    // A car turns into a corner by the radius of its turn before it.
    const double turn_m =
        kinematics_ == DMRP_KINEMATICS_ACKERMANN ? now.limits.wheelbase_m / std::tan(now.limits.steering_max) : 0.0;
    const dmrp::Vec2 ahead = toolkit::point_at(path_, arcs_, std::min(now.progress_m + 0.6 + turn_m, end_m));
    const dmrp::Vec2 offset = toolkit::to_local(now.pose, ahead);
    // A car may reach the length of its path beside the end.
    const double left_m =
        std::max(end_m - now.progress_m, toolkit::norm(toolkit::to_local(now.pose, toolkit::position(path_.back()))));
    const double speed = std::min({now.limits.v_max, std::sqrt(now.limits.a_max * left_m), clear_speed(now, offset)});
    switch (kinematics_) {
      case DMRP_KINEMATICS_HOLONOMIC:
        slide(now, offset, speed, command);
        break;
      case DMRP_KINEMATICS_ACKERMANN:
        steer(now, offset, speed, command);
        break;
      default:  // a drive that turns on the spot
        command.omega = 2.0 * std::atan2(offset.y, offset.x);
        command.v_x = speed * std::max(0.0, offset.x / std::max(toolkit::norm(offset), 1e-9));
    }
    return dmrp::Status::ok;
  }

 private:
  // The speed that leaves 0.2 m to the nearest agent on the way, from the edge of the footprint.
  static double clear_speed(const dmrp::Observation& now, dmrp::Vec2 offset) {
    const dmrp::Vec2 direction = toolkit::normalized(offset);
    double speed = now.limits.v_max;
    for (const dmrp::Agent& agent : now.agents) {
      const dmrp::Vec2 to = toolkit::to_local(now.pose, toolkit::position(agent.pose));
      const double along_m = toolkit::dot(to, direction);
      const dmrp::Vec2 aside = toolkit::perpendicular(direction);
      const double beside_m = std::abs(toolkit::dot(to, aside)) - agent.radius_m -
                              extent(now.footprint, toolkit::dot(to, aside) < 0.0 ? -aside : aside);
      if (along_m <= 0.0 || beside_m > 0.0) continue;
      const double gap_m = along_m - agent.radius_m - extent(now.footprint, direction) - 0.2;
      speed = std::min(speed, std::sqrt(std::max(0.0, now.limits.a_max * gap_m)));
    }
    return speed;
  }

  // Straight to the point, whatever the heading, within the limits of both axes; the heading turns as the goal wants it.
  static void slide(const dmrp::Observation& now, dmrp::Vec2 offset, double speed, dmrp::Command& command) {
    dmrp::Vec2 velocity = speed * toolkit::normalized(offset);
    velocity = velocity * std::min(1.0, now.limits.v_y_max / std::max(std::abs(velocity.y), 1e-9));
    command.v_x = velocity.x;
    command.v_y = velocity.y;
    if (!std::isnan(now.goal.pose.theta))
      command.omega = 2.0 * toolkit::difference(now.pose.theta, now.goal.pose.theta);
  }

  // The circle through the point ahead, as far as the wheels turn in this period from where they are. The robot turns to a
  // point behind it as a car does: backwards, with the wheels turned away from the point.
  void steer(const dmrp::Observation& now, dmrp::Vec2 offset, double speed, dmrp::Command& command) {
    const double bearing = std::abs(std::atan2(offset.y, offset.x));
    reverses_ = now.limits.v_min < 0.0 && bearing > (reverses_ ? 0.5 : 1.5);
    const double curvature = 2.0 * offset.y / std::max(toolkit::squared_norm(offset), 1e-9);
    const double wanted = reverses_ ? std::copysign(now.limits.steering_max, -offset.y)
                                    : std::clamp(std::atan(now.limits.wheelbase_m * curvature),
                                                 -now.limits.steering_max, now.limits.steering_max);
    const double reach = now.limits.steering_rate_max * dmrp::seconds(now.dt_ns);
    const double steering = now.steering_angle + std::clamp(wanted - now.steering_angle, -reach, reach);
    command.v_x = reverses_ ? std::max(now.limits.v_min, -speed) : speed;
    command.omega = command.v_x * std::tan(steering) / now.limits.wheelbase_m;
  }

  std::uint32_t kinematics_ = DMRP_KINEMATICS_DIFFERENTIAL;
  bool reverses_ = false;
  std::vector<dmrp::Waypoint> path_;
  std::vector<double> arcs_;
};

}  // namespace

DMRP_PLUGINS(AnyDrive)
