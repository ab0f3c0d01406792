// SPDX-License-Identifier: MIT
// walking_world.hpp: a small world for pedestrian models, with boxes as walls, a walking grid, and solid bodies: a body
// loses the part of its motion that would deepen an overlap. (In the host's world, people also push each other.)
#pragma once

#include <cstdint>
#include <dmrp/toolkit/random.hpp>
#include <memory>
#include <string>
#include <vector>

#include "tests/unit/given_walking_grid.hpp"
#include "tests/unit/plugin_under_test.hpp"

namespace dmrp::test {

struct Box {
  dmrp_vec2 lower;
  dmrp_vec2 upper;
};

double distance_to_box(const Box& box, dmrp_vec2 point);  // 0 inside

// The static world: a rectangle with boxes in it. Its address must not change.
class WalkingWorld {
 public:
  WalkingWorld(dmrp_vec2 size, std::vector<Box> boxes, double cell_m = 0.25);
  WalkingWorld(const WalkingWorld&) = delete;
  WalkingWorld& operator=(const WalkingWorld&) = delete;

  const dmrp_world& c() const { return world_; }
  const dmrp_grid& walking_grid() const { return grid_; }
  double clearance(dmrp_vec2 point) const;  // to the nearest box or border; 0 or less outside

 private:
  void rasterise(double cell_m);

  dmrp_vec2 size_;
  std::vector<Box> boxes_;
  std::vector<dmrp_segment> segments_;
  std::vector<uint8_t> free_, edges_;
  std::vector<float> clearance_;
  dmrp_grid grid_{};
  dmrp_world world_{};
};

// A person with defaults for all other fields. The target area is a square of 0.4 m around the target.
dmrp_person person(uint64_t id, dmrp_vec2 position, dmrp_vec2 target, double desired_speed = 1.3);

dmrp_agent robot(uint64_t id, dmrp_vec2 position, dmrp_vec2 velocity = {0.0, 0.0}, double radius_m = 0.25);

bool arrived(const dmrp_person& person);  // within 0.5 m of the target
bool all_arrived(const std::vector<dmrp_person>& people);

// The least gap between two people's bodies; negative where they overlap.
double least_gap(const std::vector<dmrp_person>& people);

// A random point at least 0.5 m from all walls.
dmrp_vec2 anywhere(const WalkingWorld& world, toolkit::Stream& chance);

// People at random positions with gaps of at least 5 cm and random targets.
std::vector<dmrp_person> random_people(const WalkingWorld& world, uint64_t count, uint64_t seed, double radius_m = 0.3);

// A model, its people and robots, stepped at 50 Hz.
class Walk {
 public:
  static constexpr double step_s = 0.02;

  Walk(const WalkingWorld& world, const std::string& model, ParamOverrides params = {}, uint64_t seed = 1);

  // Begins a new trial with the same instance; keeps people and robots.
  void restart(const WalkingWorld& world, uint64_t seed);

  std::vector<dmrp_person> people;
  std::vector<dmrp_agent> robots;
  std::vector<dmrp_vec2> velocities;  // the model's last answer
  const dmrp_walking_grid_request& asked_grid() const { return walking_grid_->asked; }
  const std::vector<FakeHost::LogLine>& log() { return model_.host().log; }
  double t_s() const { return static_cast<double>(step_) * step_s; }

  // One step. Robots move at their velocities. Fails the test if a velocity is not finite or above 5 m/s.
  void step();

  // Steps until done() returns true or the time limit is reached. Returns the last result of done().
  template <class Done>
  bool until(double time_limit_s, Done&& done) {
    const double end_s = t_s() + time_limit_s;
    while (t_s() < end_s) {
      step();
      if (done()) return true;
    }
    return false;
  }

 private:
  void keep_solid();

  const WalkingWorld* world_;
  std::unique_ptr<GivenWalkingGrid> walking_grid_;
  PluginUnderTest model_;
  int64_t step_ = 0;
};

void walk_for(Walk& walk, double duration_s);

// The least distance between the centres of a person who walks 20 m east and a robot in the way. Fails the test if the
// person does not arrive.
double passing_distance(const std::string& model, ParamOverrides params, const dmrp_agent& in_the_way);

}  // namespace dmrp::test
