// SPDX-License-Identifier: MIT
#include "tests/unit/controllers/random_worlds.hpp"

#include <dmrp/ext/distance_field.h>
#include <dmrp/ext/local_costmap.h>
#include <dmrp/ext/obstacle_clusters.h>
#include <dmrp/local_controller.h>
#include <dmrp/world.h>

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/distance_transform.hpp>
#include <dmrp/toolkit/polyline.hpp>
#include <dmrp/toolkit/random.hpp>
#include <dmrp/toolkit/vec2.hpp>

#include "core/sensors/obstacle_clusters.hpp"
#include "tests/unit/controllers/robot_body.hpp"

namespace dmrp::test {

namespace {

using toolkit::Stream;

struct Block {
  dmrp_vec2 lower;
  dmrp_vec2 upper;
};

// A costmap of any size with obstacles, its distance field and its clusters.
class Perception {
 public:
  Perception(Stream& random, double inscribed_radius_m) : inscribed_radius_m_(inscribed_radius_m) {
    width_ = 41 + static_cast<std::uint32_t>(random.below(100));
    height_ = random.chance(0.5) ? width_ : 41 + static_cast<std::uint32_t>(random.below(100));
    resolution_m_ = random.chance(0.7) ? 0.05 : random.uniform(0.03, 0.12);
    inflation_radius_m_ = inscribed_radius_m + random.uniform(0.0, 0.5);
    cost_scaling_ = random.uniform(1.0, 10.0);
    costmap_extension_ = {sizeof(costmap_extension_), 0, this, [](const dmrp_local_costmap* self, std::uint32_t) {
                            return &static_cast<const Perception*>(self->context)->costmap_;
                          }};
    field_extension_ = {sizeof(field_extension_), 0, this, [](const dmrp_distance_field* self, std::uint32_t) {
                          return &static_cast<const Perception*>(self->context)->field_;
                        }};
    clusters_extension_ = {sizeof(clusters_extension_), 0, this, [](const dmrp_obstacle_clusters* self, std::uint32_t) {
                             return &static_cast<const Perception*>(self->context)->list_;
                           }};
  }
  Perception(const Perception&) = delete;
  Perception& operator=(const Perception&) = delete;

  void offer(FakeHost& host) const {
    host.extensions[DMRP_EXT_LOCAL_COSTMAP] = &costmap_extension_;
    host.extensions[DMRP_EXT_DISTANCE_FIELD] = &field_extension_;
    host.extensions[DMRP_EXT_OBSTACLE_CLUSTERS] = &clusters_extension_;
  }

  void look(const dmrp_pose& pose, std::int64_t t_ns, const std::vector<Block>& blocks,
            const std::vector<dmrp_agent>& agents) {
    const auto corner = [this](double center, std::uint32_t cells) {
      return (std::floor(center / resolution_m_) - static_cast<double>(cells / 2)) * resolution_m_;
    };
    const dmrp_vec2 origin = {corner(pose.x, width_), corner(pose.y, height_)};
    lethal_.assign(std::size_t{width_} * height_, 0);
    for (std::uint32_t row = 0; row < height_; ++row)
      for (std::uint32_t column = 0; column < width_; ++column)
        lethal_[std::size_t{row} * width_ + column] =
            stands_at(origin + resolution_m_ * dmrp_vec2{column + 0.5, row + 0.5}, blocks, agents);
    const double field_cap_m = 6.0;
    const std::vector<float>& distances =
        transform_.compute(width_, height_, resolution_m_, lethal_.data(), field_cap_m);
    costs_.resize(lethal_.size());
    std::transform(distances.begin(), distances.end(), costs_.begin(), [this](float d) { return cost_at(d); });
    costmap_ = {sizeof(costmap_),    width_,        height_,      0, t_ns, resolution_m_, origin, inscribed_radius_m_,
                inflation_radius_m_, cost_scaling_, costs_.data()};
    field_ = {sizeof(field_), width_, height_, 0, t_ns, resolution_m_, origin, field_cap_m, distances.data()};
    list_ = finder_.derive(costmap_, agents);
  }

 private:
  static bool stands_at(dmrp_vec2 at, const std::vector<Block>& blocks, const std::vector<dmrp_agent>& agents) {
    const auto in_block = [at](const Block& b) {
      return at.x >= b.lower.x && at.x <= b.upper.x && at.y >= b.lower.y && at.y <= b.upper.y;
    };
    const auto in_agent = [at](const dmrp_agent& agent) {
      return toolkit::distance(at, toolkit::position(agent.pose)) <= agent.radius_m;
    };
    return std::any_of(blocks.begin(), blocks.end(), in_block) || std::any_of(agents.begin(), agents.end(), in_agent);
  }

  std::uint8_t cost_at(double distance_m) const {
    if (distance_m <= 0.0) return DMRP_COST_LETHAL;
    if (distance_m < inscribed_radius_m_) return DMRP_COST_INSCRIBED;
    if (distance_m > inflation_radius_m_) return DMRP_COST_FREE;
    return static_cast<std::uint8_t>(252.0 * std::exp(-cost_scaling_ * (distance_m - inscribed_radius_m_)));
  }

  double inscribed_radius_m_;
  std::uint32_t width_;
  std::uint32_t height_;
  double resolution_m_;
  double inflation_radius_m_;
  double cost_scaling_;
  std::vector<std::uint8_t> lethal_;
  std::vector<std::uint8_t> costs_;
  toolkit::DistanceTransform transform_;
  core::ObstacleClusters finder_;
  dmrp_costmap costmap_{};
  dmrp_field field_{};
  dmrp_obstacle_cluster_list list_{};
  dmrp_local_costmap costmap_extension_{};
  dmrp_distance_field field_extension_{};
  dmrp_obstacle_clusters clusters_extension_{};
};

dmrp_limits random_limits(Stream& random) {
  dmrp_limits limits = {sizeof(limits),
                        0,
                        0.0,
                        random.uniform(0.1, 2.0),
                        0.0,
                        random.uniform(0.2, 3.0),
                        random.uniform(0.2, 4.0),
                        random.uniform(0.2, 6.0),
                        0.0,
                        0.0,
                        0.0};
  if (random.chance(0.4)) limits.v_min = -random.uniform(0.05, limits.v_max);
  return limits;
}

// A disc, or a convex polygon that contains the origin: points of an ellipse with another centre.
dmrp_footprint random_footprint(Stream& random, std::vector<dmrp_vec2>& vertices, std::vector<dmrp_polygon>& parts) {
  vertices.clear();
  const double radius_m = random.uniform(0.1, 0.5);
  if (random.chance(0.5)) return disc_footprint(radius_m);
  const auto count = 3 + random.below(6);
  const dmrp_vec2 center = {random.uniform(-0.2, 0.2) * radius_m, 0.0};
  const double slim = random.uniform(0.5, 1.0);
  double reach_m = 0.0;
  for (std::uint64_t i = 0; i < count; ++i) {
    const dmrp_vec2 on_circle =
        radius_m * toolkit::from_angle(2.0 * toolkit::pi * static_cast<double>(i) / static_cast<double>(count));
    vertices.push_back(center + dmrp_vec2{on_circle.x, slim * on_circle.y});
    reach_m = std::max(reach_m, toolkit::norm(vertices.back()));
  }
  double inscribed_m = reach_m;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const dmrp_vec2 side = vertices[(i + 1) % vertices.size()] - vertices[i];
    inscribed_m = std::min(inscribed_m, toolkit::cross(vertices[i], side) / toolkit::norm(side));
  }
  parts = {polygon_of(vertices)};
  return polygon_footprint(parts, reach_m, inscribed_m);
}

dmrp_vec2 somewhere_near(Stream& random, dmrp_vec2 at, double reach_m) {
  return at + dmrp_vec2{random.uniform(-reach_m, reach_m), random.uniform(-reach_m, reach_m)};
}

// Up to thirty legs with waits, a tour of up to three goals; sometimes a single waypoint, or all at one point.
std::vector<dmrp_waypoint> random_path(Stream& random, dmrp_vec2 from, std::int64_t t_ns) {
  std::vector<dmrp_waypoint> path;
  const std::uint64_t count = random.chance(0.15) ? 1 : 1 + random.below(30);
  const bool stays = random.chance(0.05);
  dmrp_vec2 at = random.chance(0.5) ? from : somewhere_near(random, from, 1.0);
  std::uint32_t goal = 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    dmrp_waypoint waypoint{};
    waypoint.x = at.x;
    waypoint.y = at.y;
    waypoint.theta = NAN;
    waypoint.t_ns = t_ns + static_cast<std::int64_t>(i) * 1'000'000'000;
    waypoint.goal_index = goal;
    path.push_back(waypoint);
    if (goal < 2 && random.chance(0.05)) ++goal;
    if (!stays && !random.chance(0.15)) at = somewhere_near(random, at, 1.2);
  }
  return path;
}

double ramp(double from, double to, double most) {
  return from + std::clamp(to - from, -most, most);
}

}  // namespace

RandomDrive drive_at_random(PluginUnderTest& plugin, std::uint64_t seed, int steps) {
  Stream random(seed, "test.random_world");
  RandomDrive drive;
  const auto demand = [&drive](int step, bool held, const char* what) {
    if (!held) drive.breaches.push_back(std::string(what) + " at step " + std::to_string(step));
  };
  const dmrp_limits limits = random_limits(random);
  std::vector<dmrp_vec2> vertices;
  std::vector<dmrp_polygon> parts;
  const dmrp_footprint footprint = random_footprint(random, vertices, parts);
  Perception perception(random, footprint.inscribed_radius_m);
  perception.offer(plugin.host());
  const std::int64_t dt_ns = random.chance(0.5) ? 100'000'000 : 20'000'000 * (1 + std::int64_t(random.below(20)));
  const double dt_s = 1e-9 * static_cast<double>(dt_ns);

  std::vector<Block> blocks(random.below(25));
  for (Block& block : blocks) {
    block.lower = somewhere_near(random, {0.0, 0.0}, 6.0);
    block.upper = block.lower + dmrp_vec2{random.uniform(0.0, 1.5), random.uniform(0.0, 1.5)};
  }
  std::vector<dmrp_agent> agents(random.below(6));
  for (std::size_t i = 0; i < agents.size(); ++i) {
    const dmrp_vec2 at = somewhere_near(random, {0.0, 0.0}, random.chance(0.1) ? 0.2 : 4.0);
    const dmrp_vec2 velocity = random.chance(0.3) ? dmrp_vec2{0.0, 0.0} : somewhere_near(random, {0.0, 0.0}, 1.5);
    agents[i] = {i, DMRP_AGENT_PERSON, 0, {at.x, at.y, 0.0}, velocity, random.uniform(0.1, 0.6)};
  }

  dmrp_pose pose = {random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-3.2, 3.2)};
  dmrp_goal goal = {pose, 0.2, 0.2, 0.1, 500'000'000};
  dmrp_robot robot{};
  robot.name = "robot";
  robot.type = "";
  robot.kinematics = DMRP_KINEMATICS_DIFFERENTIAL;
  robot.goals = &goal;
  robot.goal_count = 1;
  robot.goal_stride = sizeof(goal);
  robot.limits = &limits;
  robot.footprint = &footprint;
  robot.start = pose;
  dmrp_grid grid{};
  grid.struct_size = sizeof(grid);
  grid.resolution_m = 1.0;
  dmrp_world world{};
  world.struct_size = sizeof(world);
  world.lower = {-100.0, -100.0};
  world.upper = {100.0, 100.0};
  world.step_ns = 20'000'000;
  world.control_period_ns = dt_ns;
  world.time_limit_ns = 600'000'000'000;
  world.robots = &robot;
  world.robot_count = 1;
  world.robot_stride = sizeof(robot);
  world.planning_grid = &grid;
  demand(-1, plugin.start(world, seed) == DMRP_OK, "start() failed");

  const auto& controller = plugin.as<dmrp_local_controller>();
  std::vector<dmrp_waypoint> waypoints;
  std::vector<double> arcs;
  std::size_t handed = 0;  // waypoints of these that the controller has
  std::uint32_t handed_for = 0;
  dmrp_observation now{};
  std::uint64_t revision = 0;
  for (int step = 0; step < steps; ++step) {
    now.struct_size = sizeof(now);
    now.dt_ns = dt_ns;
    if (step == 0 || random.chance(0.03)) {
      waypoints = random_path(random, toolkit::position(pose), now.t_ns);
      toolkit::arc_lengths(waypoints, arcs);
      now.progress_m = 0.0;
      now.progress_waypoint = 0;
      now.goal_index = 0;
      handed = 0;
    }
    if (now.goal_index < waypoints.back().goal_index && random.chance(0.03)) ++now.goal_index;
    for (dmrp_agent& agent : agents) {
      agent.pose.x += agent.velocity.x * dt_s;
      agent.pose.y += agent.velocity.y * dt_s;
    }
    const auto is_of_goal = [&](const dmrp_waypoint& w) { return w.goal_index <= now.goal_index; };
    const auto goal_end = std::find_if_not(waypoints.begin(), waypoints.end(), is_of_goal) - 1;
    if (step % 40 == 0) goal.pose.theta = random.chance(0.5) ? NAN : random.uniform(-3.2, 3.2);
    goal.pose = {goal_end->x, goal_end->y, goal.pose.theta};
    if (handed == 0 || handed_for != now.goal_index || step % 10 == 0) {
      const std::size_t most = static_cast<std::size_t>(goal_end - waypoints.begin()) + 1;
      const std::size_t least = std::min<std::size_t>(now.progress_waypoint + 1, most);
      const std::size_t count = random.chance(0.5) ? most : least + random.below(most - least + 1);
      const dmrp_path path = {sizeof(path), static_cast<std::uint32_t>(count), sizeof(dmrp_waypoint),
                              count < most ? DMRP_PATH_PARTIAL : 0, waypoints.data()};
      const dmrp_path_update update = {sizeof(update), 0, revision + 1, &path, handed > 0 ? DMRP_PATH_CONTINUES : 0, 0};
      if (count != handed) {
        ++revision;
        demand(step, controller.set_path(plugin.self(), &update) == DMRP_OK, "set_path() failed");
      }
      handed = count;
      handed_for = now.goal_index;
    }
    const toolkit::PathPlace place =
        toolkit::project(waypoints, arcs, toolkit::position(pose), now.progress_m, now.progress_m + 2.0);
    now.progress_m = std::min(std::max(now.progress_m, place.arc_m), arcs[handed - 1]);
    while (now.progress_waypoint + 1 < handed && arcs[now.progress_waypoint + 1] <= now.progress_m)
      ++now.progress_waypoint;
    now.pose = pose;
    now.goal = &goal;
    now.goal_stride = sizeof(goal);
    now.goal_count = waypoints.back().goal_index + 1;
    now.limits = &limits;
    now.footprint = &footprint;
    now.agents = agents.data();
    now.agent_count = static_cast<std::uint32_t>(agents.size());
    now.agent_stride = sizeof(dmrp_agent);
    perception.look(pose, now.t_ns, blocks, agents);

    dmrp_command command{};
    command.struct_size = sizeof(command);
    const std::int32_t status = controller.step(plugin.self(), &now, &command);
    const double rounding = 1e-9;
    if (status != DMRP_OK) {
      demand(step, status == DMRP_NO_SOLUTION, "a status that is neither OK nor NO_SOLUTION");
      command.v_x = command.v_y = command.omega = 0.0;
    } else {
      demand(step, std::isfinite(command.v_x) && std::isfinite(command.omega) && command.v_y == 0.0,
             "no finite command");
      demand(step, command.v_x >= limits.v_min - rounding && command.v_x <= limits.v_max + rounding, "v out of limits");
      demand(step, std::abs(command.omega) <= limits.omega_max + rounding, "omega out of limits");
      demand(step, std::abs(command.v_x - now.velocity.v_x) <= limits.a_max * dt_s + rounding, "v out of reach");
      demand(step, std::abs(command.omega - now.velocity.omega) <= limits.alpha_max * dt_s + rounding,
             "omega out of reach");
    }
    drive.commands.push_back(command);
    if (!drive.breaches.empty()) break;

    now.velocity.v_x = ramp(now.velocity.v_x, command.v_x, limits.a_max * dt_s);
    now.velocity.omega = ramp(now.velocity.omega, command.omega, limits.alpha_max * dt_s);
    now.applied = {command.v_x, command.v_y, command.omega};
    const double heading = pose.theta + 0.5 * now.velocity.omega * dt_s;
    pose = {pose.x + now.velocity.v_x * dt_s * std::cos(heading), pose.y + now.velocity.v_x * dt_s * std::sin(heading),
            toolkit::wrap(pose.theta + now.velocity.omega * dt_s)};
    now.t_ns += dt_ns;
  }
  return drive;
}

}  // namespace dmrp::test
