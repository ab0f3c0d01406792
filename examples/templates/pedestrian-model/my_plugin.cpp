// SPDX-License-Identifier: MIT
// A complete pedestrian model: everybody looks ahead in several directions, takes the one that leads nearest to the
// destination before something is in the way, and walks slowly enough to stop in time.
// Copy it, rename it, replace step().
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <dmrp/plugin.hpp>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/grid_view.hpp>
#include <dmrp/toolkit/navigation_field.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <map>
#include <stdexcept>

namespace {

namespace toolkit = dmrp::toolkit;

constexpr double cell_m = 0.25;  // of the grid on which ways are found

class LookAhead final : public dmrp::PedestrianModel {
 public:
  // The id must stay the same in all versions. Begin it with a domain that you own; `dmrp.` is reserved.
  // The host gives only the extensions that are named here: needs() for those without which the plugin cannot run,
  // uses() for others.
  static dmrp::Descriptor describe() {
    return dmrp::Descriptor("org.example.my_plugin", "Look ahead", "0.1.0")
        .vendor("Example")
        .license("MIT")
        .summary("people take the direction that brings them nearest to their destination before a collision")
        .source("Moussaid, Helbing, Theraulaz: How simple rules determine pedestrian behavior, PNAS 108 (2011)")
        .needs(DMRP_EXT_WALKING_GRID);
  }

  // The keys that an experiment file may set under `params`. Speed and radius are not among them: each person has its
  // own.
  dmrp::Param<double> horizon = param("horizon", 6.0).unit("m").range(0.5, 50.0).doc("how far people look");
  dmrp::Param<double> sight = param("sight", 1.3).unit("rad").range(0.1, 3.1).doc("how far to each side people look");
  dmrp::Param<int> directions = param("directions", 6).range(1, 100).doc("directions looked at on each side");
  dmrp::Param<double> relaxation =
      param("relaxation", 0.5).unit("s").range(0.05, 5.0).doc("time to the wanted velocity, and kept to a collision");

  // A trial begins: reset all state of the previous one. Extensions are asked for here.
  dmrp::Status start(const dmrp::Start& start) override {
    const auto& walking_grid = extension<dmrp_walking_grid>();
    const dmrp_walking_grid_request request = {sizeof(request), 0, cell_m, start.world->person_radius_m};
    const dmrp_grid* grid = walking_grid.grid(&walking_grid, &request);
    if (grid == nullptr) throw std::runtime_error("the host has no walking grid for this world");
    grid_ = toolkit::GridView(*grid);
    ways_.clear();
    return dmrp::Status::ok;
  }

  // Called at every physics step, 50 times a second. The host decides who is present and where they go, and keeps
  // bodies solid; the model gives velocities. An index is not a person: people are known by their id.
  dmrp::Status step(const dmrp::Crowd& crowd, dmrp::Motions& motions) override {
    const double step_s = dmrp::seconds(crowd.dt_ns);
    for (std::size_t i = 0; i < crowd.people.size(); ++i) {
      const dmrp::Person& person = crowd.people[i];
      const dmrp::Vec2 wanted = wanted_velocity(person, crowd);
      motions[i].velocity = toolkit::lerp(person.velocity, wanted, std::min(1.0, step_s / relaxation));
    }
    return dmrp::Status::ok;
  }

 private:
  // The direction that ends nearest to a point at the horizon on the way to the destination; straight on among equals.
  dmrp::Vec2 wanted_velocity(const dmrp::Person& person, const dmrp::Crowd& crowd) {
    const dmrp::Vec2 way = way_of(person).direction(person.position);
    if (way == dmrp::Vec2{0.0, 0.0}) return way;  // arrived, or there is no way
    dmrp::Vec2 best = way;
    double best_free_m = 0.0;
    double best_left_m = 2.0 * horizon;
    for (int i = 0; i <= 2 * directions; ++i) {
      const double angle = (i % 2 == 0 ? -1.0 : 1.0) * ((i + 1) / 2) * sight / directions;
      const dmrp::Vec2 direction = toolkit::rotate(way, angle);
      const double free_m = free_way_m(person, direction, crowd);
      const double left_m = toolkit::distance(*horizon * way, free_m * direction);
      if (left_m >= best_left_m) continue;
      best = direction;
      best_free_m = free_m;
      best_left_m = left_m;
    }
    return std::min(person.desired_speed, best_free_m / relaxation) * best;
  }

  // How far the person can walk in this direction at its desired speed before it touches something, if the others keep
  // their velocities; at most the horizon.
  double free_way_m(const dmrp::Person& person, dmrp::Vec2 direction, const dmrp::Crowd& crowd) const {
    double free_m = free_of_walls_m(person.position, direction);
    const auto avoid = [&](dmrp::Vec2 position, dmrp::Vec2 velocity, double radius_m) {
      const dmrp::Vec2 approach = person.desired_speed * direction - velocity;
      const double meet_s = time_to_touch_s(position - person.position, approach, person.radius_m + radius_m);
      free_m = std::min(free_m, person.desired_speed * meet_s);
    };
    for (const dmrp::Person& other : crowd.people)
      if (other.id != person.id) avoid(other.position, other.velocity, other.radius_m);
    for (const dmrp::Agent& robot : crowd.robots) avoid(toolkit::position(robot.pose), robot.velocity, robot.radius_m);
    return free_m;
  }

  // The cells of the grid are free for a person's centre. People outside them, pushed against a wall, see no wall.
  double free_of_walls_m(dmrp::Vec2 from, dmrp::Vec2 direction) const {
    if (!grid_.free(grid_.cell_of(from))) return horizon;
    for (double ahead_m = cell_m; ahead_m < horizon; ahead_m += cell_m)
      if (!grid_.free(grid_.cell_of(from + ahead_m * direction))) return ahead_m - cell_m;
    return horizon;
  }

  // When two discs touch whose centres are `apart` and approach each other; infinity if they do not.
  static double time_to_touch_s(dmrp::Vec2 apart, dmrp::Vec2 approach, double sum_of_radii_m) {
    constexpr double never = std::numeric_limits<double>::infinity();
    const double closing = toolkit::dot(apart, approach);
    if (closing <= 0.0) return never;
    const double gap = toolkit::squared_norm(apart) - sum_of_radii_m * sum_of_radii_m;
    if (gap <= 0.0) return 0.0;
    const double squared_speed = toolkit::squared_norm(approach);
    const double discriminant = closing * closing - squared_speed * gap;
    return discriminant < 0.0 ? never : (closing - std::sqrt(discriminant)) / squared_speed;
  }

  // People with the same target_id walk to the same place: one field of ways for all of them.
  const toolkit::NavigationField& way_of(const dmrp::Person& person) {
    const auto [place, is_new] = ways_.try_emplace(person.target_id);
    if (is_new) place->second.compute(grid_, toolkit::Rectangle{person.area_lower, person.area_upper});
    return place->second;
  }

  toolkit::GridView grid_;  // the host's, valid until the next start()
  std::map<std::uint32_t, toolkit::NavigationField> ways_;
};

}  // namespace

// All plugin classes of the library; once per library.
DMRP_PLUGINS(LookAhead)
