// SPDX-License-Identifier: MIT
#include "tests/unit/controllers/arena.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/polyline.hpp>

#include "core/world/drive.hpp"

namespace dmrp::test {

namespace {

constexpr double step_s = 0.02;
constexpr std::int64_t step_ns = 20'000'000;
constexpr std::int64_t period_ns = 100'000'000;
constexpr double tracking_range_m = 10.0;

dmrp_pose moved(const dmrp_pose& from, const dmrp_twist& velocity, double dt) {
  const double heading = from.theta + 0.5 * velocity.omega * dt;
  return {from.x + velocity.v_x * dt * std::cos(heading), from.y + velocity.v_x * dt * std::sin(heading),
          toolkit::wrap(from.theta + velocity.omega * dt)};
}

// The gap between two convex outlines along the axis, of all their edges' normals, on which it is widest: a lower bound
// of their distance, negative if and only if they overlap.
double gap_between(const std::vector<dmrp_vec2>& a, const std::vector<dmrp_vec2>& b) {
  double widest = -1e9;
  const auto try_edges = [&widest](const std::vector<dmrp_vec2>& of, const std::vector<dmrp_vec2>& other) {
    for (std::size_t i = 0; i < of.size(); ++i) {
      const dmrp_vec2 edge = of[(i + 1) % of.size()] - of[i];
      const dmrp_vec2 outward = toolkit::normalized({edge.y, -edge.x});
      double least = 1e9;
      for (const dmrp_vec2 corner : other) least = std::min(least, toolkit::dot(outward, corner - of[i]));
      widest = std::max(widest, least);
    }
  };
  try_edges(a, b);
  try_edges(b, a);
  return widest;
}

double ramp(double value, double target, double step) {
  return value + std::clamp(target - value, -step, step);
}

}  // namespace

Body with_rectangle(Body body, double ahead_m, double behind_m, double half_width_m) {
  body.corners = {
      {-behind_m, -half_width_m}, {ahead_m, -half_width_m}, {ahead_m, half_width_m}, {-behind_m, half_width_m}};
  body.radius_m = std::hypot(std::max(ahead_m, behind_m), half_width_m);
  body.inscribed_radius_m = std::min({ahead_m, behind_m, half_width_m});
  return body;
}

Walker standing(dmrp_vec2 at) {
  return {0.3, [at](double, dmrp_vec2) { return at; }};
}

Walker walking(dmrp_vec2 from, dmrp_vec2 to, double speed, double start_s) {
  return {0.3, [=](double t_s, dmrp_vec2) {
            const double share = speed * std::max(0.0, t_s - start_s) / toolkit::distance(from, to);
            return toolkit::lerp(from, to, std::min(1.0, share));
          }};
}

std::vector<dmrp_vec2> metre_path(const std::vector<dmrp_vec2>& corners) {
  std::vector<dmrp_vec2> path = {corners.front()};
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const int metres = std::max(1, static_cast<int>(std::lround(toolkit::distance(corners[i - 1], corners[i]))));
    for (int k = 1; k <= metres; ++k)
      path.push_back(toolkit::lerp(corners[i - 1], corners[i], static_cast<double>(k) / metres));
  }
  return path;
}

Trip::Trip(const std::string& controller, Course course, ParamOverrides overrides)
    : original_(std::move(course)),
      sensors_(original_.sight, original_.body.inscribed_radius_m),
      plugin_(std::make_unique<PluginUnderTest>("libdmrp_controllers.so", controller, std::move(overrides))) {
  const Body& body = original_.body;
  limits_ = body.limits;
  footprint_ = disc_footprint(body.radius_m);
  if (!body.corners.empty()) {
    part_ = polygon_of(body.corners);
    footprint_.part_count = 1;
    footprint_.parts = &part_;
    footprint_.part_stride = sizeof(part_);
    footprint_.inscribed_radius_m = body.inscribed_radius_m;
  }
  grid_.struct_size = sizeof(grid_);
  grid_.resolution_m = 1.0;
  if (original_.costmap) sensors_.offer(plugin_->host());
  if (original_.annotate) notes_.offer(plugin_->host());
  start();
}

Trip::~Trip() = default;

void Trip::start() {
  course_ = original_;
  drive_ = {};
  sensors_.reset();
  notes_.trajectories.clear();
  notes_.notes.clear();
  pose_ = course_.start;
  velocity_ = {0.0, 0.0, 0.0};
  steering_rad_ = 0.0;
  t_ns_ = 0;
  settled_ns_ = 0;
  no_solution_s_ = 0.0;
  drawn_revision_ = 0;
  handed_ = 0;
  update_ = 0;
  observation_ = {};
  goal_.pose = {course_.path.back().x, course_.path.back().y, course_.goal_heading};
  goal_.tolerance_m = course_.goal_tolerance_m;
  goal_.tolerance_rad = 0.2;
  goal_.tolerance_speed = 0.1;
  goal_.settle_ns = 500'000'000;
  robot_.name = "robot";
  robot_.type = "";
  robot_.kinematics = original_.body.kinematics;
  robot_.goals = &goal_;
  robot_.goal_count = 1;
  robot_.goal_stride = sizeof(goal_);
  robot_.limits = &limits_;
  robot_.footprint = &footprint_;
  robot_.start = pose_;
  world_.struct_size = sizeof(world_);
  world_.lower = {-100.0, -100.0};
  world_.upper = {100.0, 100.0};
  world_.step_ns = step_ns;
  world_.control_period_ns = period_ns;
  world_.time_limit_ns = static_cast<std::int64_t>(course_.time_limit_s * 1e9);
  world_.robots = &robot_;
  world_.robot_count = 1;
  world_.robot_stride = sizeof(robot_);
  world_.planning_grid = &grid_;
  if (plugin_->start(world_) != DMRP_OK) drive_.breaches.push_back("start() failed");
}

bool Trip::finished() const {
  return drive_.arrived || drive_.time_s >= course_.time_limit_s;
}

dmrp_vec2 Trip::velocity() const {
  return finished() ? dmrp_vec2{0.0, 0.0} : toolkit::rotate({velocity_.v_x, velocity_.v_y}, pose_.theta);
}

void Trip::control_period() {
  decide();
  for (std::int64_t k = 0; k < period_ns / step_ns; ++k) drive_on();
}

void Trip::decide() {
  if (finished()) return;
  if (course_.change) course_.change(course_, drive_.time_s, pose_);
  if (course_.revision != drawn_revision_) draw_path();
  hand_path();
  sensors_.set_boxes(course_.boxes);
  track();
  sensors_.look(pose_, t_ns_, bodies_, agents_);
  observe();
  command();
}

void Trip::draw_path() {
  drawn_revision_ = course_.revision;
  handed_ = 0;
  waypoints_.clear();
  for (const dmrp_vec2 point : course_.path) {
    dmrp_waypoint waypoint{};
    waypoint.x = point.x;
    waypoint.y = point.y;
    waypoint.theta = NAN;
    waypoint.t_ns = t_ns_ + static_cast<std::int64_t>(waypoints_.size()) * 1'800'000'000;
    waypoints_.push_back(waypoint);
  }
  toolkit::arc_lengths(waypoints_, arcs_);
  observation_.progress_m = 0.0;
  goal_.pose = {course_.path.back().x, course_.path.back().y, course_.goal_heading};
}

// The path up to the last waypoint that is released, whenever that is another one.
void Trip::hand_path() {
  const auto all = static_cast<std::uint32_t>(waypoints_.size());
  const std::uint32_t count = course_.released < all ? course_.released + 1 : all;
  if (count == handed_) return;
  std::vector<dmrp_waypoint> handed(waypoints_.begin(), waypoints_.begin() + count);
  const dmrp_path path = {sizeof(path), count, sizeof(dmrp_waypoint), count < all ? DMRP_PATH_PARTIAL : 0,
                          handed.data()};
  const dmrp_path_update update = {sizeof(update), 0, ++update_, &path, handed_ > 0 ? DMRP_PATH_CONTINUES : 0, 0};
  handed_ = count;
  if (plugin_->as<dmrp_local_controller>().set_path(plugin_->self(), &update) != DMRP_OK)
    drive_.breaches.push_back("set_path() failed");
}

void Trip::track() {
  bodies_.clear();
  agents_.clear();
  const dmrp_vec2 here = toolkit::position(pose_);
  for (std::size_t i = 0; i < course_.walkers.size(); ++i) {
    const Walker& walker = course_.walkers[i];
    const dmrp_vec2 at = walker.at(drive_.time_s, here);
    bodies_.push_back({at, walker.radius_m});
    if (!course_.tracking || toolkit::distance(here, at) > tracking_range_m) continue;
    const dmrp_vec2 velocity =
        walker.velocity ? walker.velocity() : (at - walker.at(drive_.time_s - step_s, here)) / step_s;
    const double heading = std::atan2(velocity.y, velocity.x);
    if (!sensors_.sees(here, at)) continue;
    agents_.push_back({i, walker.kind, 0, {at.x, at.y, heading}, velocity, walker.radius_m});
  }
  const auto by_kind = [](const dmrp_agent& a, const dmrp_agent& b) { return a.kind < b.kind; };
  std::stable_sort(agents_.begin(), agents_.end(), by_kind);
}

void Trip::observe() {
  dmrp_observation& now = observation_;
  const double progress_m = now.progress_m;
  const dmrp_twist applied = now.applied;
  now = {};
  now.struct_size = sizeof(now);
  now.t_ns = t_ns_;
  now.dt_ns = period_ns;
  now.pose = pose_;
  now.velocity = velocity_;
  now.applied = applied;
  now.goal = &goal_;
  now.goal_count = 1;
  now.goal_stride = sizeof(goal_);
  const toolkit::PathPlace place =
      toolkit::project(waypoints_, arcs_, toolkit::position(pose_), progress_m, progress_m + 2.0);
  now.progress_m = place.arc_m;
  drive_.path_deviation_m = std::max(drive_.path_deviation_m, place.distance_m);
  while (now.progress_waypoint + 1 < waypoints_.size() && arcs_[now.progress_waypoint + 1] <= place.arc_m)
    ++now.progress_waypoint;
  now.limits = &limits_;
  now.footprint = &footprint_;
  now.agents = agents_.data();
  now.agent_count = static_cast<std::uint32_t>(agents_.size());
  now.agent_stride = sizeof(dmrp_agent);
}

void Trip::command() {
  command_ = {};
  command_.struct_size = sizeof(command_);
  const std::int32_t status = plugin_->as<dmrp_local_controller>().step(plugin_->self(), &observation_, &command_);
  no_solution_s_ = status == DMRP_NO_SOLUTION ? no_solution_s_ + 0.1 : 0.0;
  drive_.longest_no_solution_s = std::max(drive_.longest_no_solution_s, no_solution_s_);
  const auto demand = [this](bool held, const char* what) {
    if (!held) drive_.breaches.push_back(std::string(what) + " at " + std::to_string(drive_.time_s) + " s");
  };
  if (status == DMRP_NO_SOLUTION) {
    command_.v_x = command_.v_y = command_.omega = 0.0;
  } else if (original_.body.kinematics != DMRP_KINEMATICS_DIFFERENTIAL) {
    demand_ability(status);
  } else {
    const double rounding = 1e-9;
    demand(status == DMRP_OK, "a status that is neither OK nor NO_SOLUTION");
    demand(std::isfinite(command_.v_x) && std::isfinite(command_.omega) && command_.v_y == 0.0, "no finite command");
    demand(command_.v_x >= limits_.v_min - rounding && command_.v_x <= limits_.v_max + rounding, "v out of limits");
    demand(std::abs(command_.omega) <= limits_.omega_max + rounding, "omega out of limits");
    demand(std::abs(command_.v_x - velocity_.v_x) <= limits_.a_max * 0.1 + rounding, "v out of reach");
    demand(std::abs(command_.omega - velocity_.omega) <= limits_.alpha_max * 0.1 + rounding, "omega out of reach");
  }
  drive_.poses.push_back(pose_);
  drive_.commands.push_back(command_);
}

// Of a drive that is not differential.
void Trip::demand_ability(std::int32_t status) {
  const double rounding = 1e-9;
  const auto demand = [this](bool held, const char* what) {
    if (!held) drive_.breaches.push_back(std::string(what) + " at " + std::to_string(drive_.time_s) + " s");
  };
  demand(status == DMRP_OK, "a status that is neither OK nor NO_SOLUTION");
  demand(std::isfinite(command_.v_x) && std::isfinite(command_.v_y) && std::isfinite(command_.omega), "not finite");
  const dmrp_twist given = {command_.v_x, command_.v_y, command_.omega};
  const dmrp_twist able = core::clip_to_drive(given, static_cast<core::Drive>(original_.body.kinematics), limits_);
  demand(std::abs(able.v_x - given.v_x) <= rounding, "v_x outside the drive's ability");
  demand(std::abs(able.v_y - given.v_y) <= rounding, "v_y outside the drive's ability");
  demand(std::abs(able.omega - given.omega) <= rounding, "omega outside the drive's ability");
}

void Trip::drive_on() {
  if (finished()) return;
  if (original_.body.kinematics != DMRP_KINEMATICS_DIFFERENTIAL) {
    const auto kind = static_cast<core::Drive>(original_.body.kinematics);
    const dmrp_twist able = core::clip_to_drive({command_.v_x, command_.v_y, command_.omega}, kind, limits_);
    const core::DriveState next = core::advance({pose_, velocity_, steering_rad_}, able, kind, limits_, step_s);
    observation_.applied = able;
    pose_ = next.pose;
    velocity_ = next.velocity;
    steering_rad_ = next.steering_rad;
    end_step();
    return;
  }
  velocity_.v_x = ramp(velocity_.v_x, command_.v_x, limits_.a_max * step_s);
  velocity_.omega = ramp(velocity_.omega, command_.omega, limits_.alpha_max * step_s);
  observation_.applied = velocity_;
  pose_ = moved(pose_, velocity_, step_s);
  end_step();
}

void Trip::end_step() {
  drive_.turned_rad += std::abs(velocity_.omega) * step_s;
  t_ns_ += step_ns;
  drive_.time_s = static_cast<double>(t_ns_) * 1e-9;
  judge();
}

double Trip::clearance_from(const toolkit::Rectangle& box) const {
  const dmrp_vec2 at = toolkit::position(pose_);
  if (original_.body.corners.empty())
    return (toolkit::contains(box, at) ? -toolkit::depth(box, at) : toolkit::distance(box, at)) - footprint_.radius_m;
  std::vector<dmrp_vec2> outline;
  for (const dmrp_vec2 corner : original_.body.corners) outline.push_back(toolkit::to_world(pose_, corner));
  return gap_between(outline, {box.lower, {box.upper.x, box.lower.y}, box.upper, {box.lower.x, box.upper.y}});
}

double Trip::static_clearance() const {
  double nearest = 1e9;
  for (const Box& box : course_.boxes) nearest = std::min(nearest, clearance_from({box.lower, box.upper}));
  return nearest;
}

void Trip::judge() {
  const dmrp_vec2 at = toolkit::position(pose_);
  drive_.end = pose_;
  drive_.static_clearance_m = std::min(drive_.static_clearance_m, static_clearance());
  for (const Walker& walker : course_.walkers) {
    const dmrp_vec2 other = walker.at(drive_.time_s, at);
    const double clearance = toolkit::distance(other, at) - walker.radius_m - footprint_.radius_m;
    drive_.walker_clearance_m = std::min(drive_.walker_clearance_m, clearance);
    const double approach =
        velocity_.v_x * toolkit::dot(toolkit::from_angle(pose_.theta), toolkit::normalized(other - at));
    if (approach > 0.05) drive_.own_walker_clearance_m = std::min(drive_.own_walker_clearance_m, clearance);
  }
  drive_.goal_distance_m = toolkit::distance(at, toolkit::position(goal_.pose));
  const bool there = drive_.goal_distance_m <= goal_.tolerance_m &&
                     toolkit::norm({velocity_.v_x, velocity_.v_y}) <= goal_.tolerance_speed &&
                     (std::isnan(goal_.pose.theta) ||
                      std::abs(toolkit::difference(pose_.theta, goal_.pose.theta)) <= goal_.tolerance_rad);
  settled_ns_ = there ? settled_ns_ + step_ns : 0;
  drive_.arrived = settled_ns_ >= goal_.settle_ns;
}

Drive run(const std::string& controller, const Course& course, const ParamOverrides& overrides) {
  Trip trip(controller, course, overrides);
  while (!trip.finished()) trip.control_period();
  return trip.result();
}

std::vector<Drive> drive_together(const std::string& controller, std::vector<Course> courses,
                                  const ParamOverrides& overrides) {
  // the courses read the trips only while these drive
  std::vector<std::unique_ptr<Trip>> trips(courses.size());
  for (std::size_t i = 0; i < courses.size(); ++i)
    for (std::size_t k = 0; k < courses.size(); ++k) {
      if (k == i) continue;
      courses[i].walkers.push_back({courses[k].body.radius_m,
                                    [&trips, k](double, dmrp_vec2) { return toolkit::position(trips[k]->pose()); },
                                    DMRP_AGENT_ROBOT, [&trips, k] { return trips[k]->velocity(); }});
    }
  for (std::size_t i = 0; i < courses.size(); ++i)
    trips[i] = std::make_unique<Trip>(controller, std::move(courses[i]), overrides);
  const auto is_finished = [](const auto& trip) { return trip->finished(); };
  while (!std::all_of(trips.begin(), trips.end(), is_finished)) {
    for (const auto& trip : trips) trip->decide();
    for (std::int64_t k = 0; k < period_ns / step_ns; ++k)
      for (const auto& trip : trips) trip->drive_on();
  }
  std::vector<Drive> drives;
  for (const auto& trip : trips) drives.push_back(trip->result());
  return drives;
}

std::array<Drive, 2> drive_two(const std::string& controller, Course one, Course other,
                               const ParamOverrides& overrides) {
  const std::vector<Drive> drives = drive_together(controller, {std::move(one), std::move(other)}, overrides);
  return {drives[0], drives[1]};
}

}  // namespace dmrp::test
