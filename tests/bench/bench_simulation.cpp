// SPDX-License-Identifier: MIT
// bench_simulation: the real-time factor of the world on one core. Robots have constant commands.
//
//   simulation/mall_bare/real_time_factor                 4 robots, 12 people, 50 Hz, no plugin: people walk straight
//   simulation/mall_lidar/real_time_factor                the same with lidars of 360 beams at 10 Hz
//   simulation/mall_costmap/real_time_factor              the same with local costmaps on these
//   simulation/mall_social_force/real_time_factor         people by the social force plugin
//   simulation/mall_social_force_lidar/real_time_factor   the same with the lidars
//   simulation/hall_bare/real_time_factor                 100 robots, 1,000 people, 50 Hz, no plugin
//   simulation/hall_social_force/real_time_factor         people by the social force plugin
#include <algorithm>
#include <dmrp/toolkit/vec2.hpp>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/people/flow_routes.hpp"
#include "core/scene/planning_grid.hpp"
#include "core/scene/world_view.hpp"
#include "core/sensors/costmap.hpp"
#include "core/sensors/lidar.hpp"
#include "core/sensors/visibility.hpp"
#include "core/world/world.hpp"
#include "tests/bench/bench_rows.hpp"
#include "tests/bench/bench_simulation_world.hpp"
#include "tests/unit/given_walking_grid.hpp"
#include "tests/unit/plugin_under_test.hpp"

namespace {

using namespace dmrp;

enum class Walking { straight, social_force };
enum class Sensors { none, lidar, costmap };

struct Setup {
  core::Scenario scenario;
  Walking walking;
  Sensors sensors;
  double duration_s;
};

// Computes the velocities of the people of one world.
class PeopleVelocities {
 public:
  PeopleVelocities(const Setup& setup, const core::StaticGeometry& geometry, const core::PlanningGrid& walking_grid)
      : view_(setup.scenario, {}, {}, geometry, walking_grid, 0), grid_(walking_grid.view()), walking_grid_(grid_) {
    if (setup.walking == Walking::straight) return;
    model_ = std::make_unique<test::PluginUnderTest>("libdmrp_pedestrians.so", "dmrp.pedestrian.social_force");
    walking_grid_.offer(model_->host());
    if (model_->start(view_.world()) != DMRP_OK) throw std::runtime_error("the model does not start");
  }

  const std::vector<dmrp_vec2>& of(const core::World& world) {
    velocities_.resize(world.people().size());
    if (model_) {
      step_model(world);
    } else {
      for (std::size_t i = 0; i < velocities_.size(); ++i) {
        const dmrp_person& person = world.people()[i];
        velocities_[i] = person.desired_speed * toolkit::normalized(person.target - person.position);
      }
    }
    return velocities_;
  }

 private:
  void step_model(const core::World& world) {
    dmrp_crowd crowd{};
    crowd.struct_size = sizeof(crowd);
    crowd.person_count = static_cast<std::uint32_t>(world.people().size());
    crowd.t_ns = world.t_ns();
    crowd.dt_ns = world.settings().step_ns;
    crowd.people = world.people().data();
    crowd.robots = world.robot_agents().data();
    crowd.person_stride = sizeof(dmrp_person);
    crowd.robot_count = static_cast<std::uint32_t>(world.robot_agents().size());
    crowd.robot_stride = sizeof(dmrp_agent);
    motions_.resize(crowd.person_count);
    dmrp_motions motions = {sizeof(motions), crowd.person_count, sizeof(dmrp_motion), 0, motions_.data()};
    if (model_->as<dmrp_pedestrian_model>().step(model_->self(), &crowd, &motions) != DMRP_OK)
      throw std::runtime_error("a step failed");
    std::transform(motions_.begin(), motions_.end(), velocities_.begin(),
                   [](const dmrp_motion& motion) { return motion.velocity; });
  }

  core::WorldView view_;
  dmrp_grid grid_;
  test::GivenWalkingGrid walking_grid_;
  std::unique_ptr<test::PluginUnderTest> model_;
  std::vector<dmrp_motion> motions_;
  std::vector<dmrp_vec2> velocities_;
};

void sense(core::Sight& sight, core::Lidar& lidar, std::vector<std::unique_ptr<core::LocalCostmap>>& costmaps,
           std::vector<float>& ranges) {
  const core::World& world = sight.world();
  for (std::uint32_t robot = 0; robot < world.robots().size(); ++robot) {
    sight.scan_from(robot, lidar, ranges);
    if (!costmaps.empty()) costmaps[robot]->update(world.robots()[robot].pose, lidar.describe(world.t_ns(), ranges));
  }
}

// Simulated time over processor time.
double real_time_factor(const Setup& setup) {
  const core::Scenario& scenario = setup.scenario;
  const core::RobotSettings robot;
  const core::SimulationSettings settings;
  const auto geometry = std::make_shared<const core::StaticGeometry>(scenario);
  const core::PlanningGrid walking_grid = core::build_walking_grid(*geometry, scenario.people.radius_m);
  const core::FlowRoutes routes = core::find_flow_routes(scenario, walking_grid);
  core::World world(scenario, robot, settings, geometry, routes, 1);
  core::Sight sight(world);
  PeopleVelocities people(setup, *geometry, walking_grid);
  core::Lidar lidar(robot.lidar, geometry);
  std::vector<float> ranges(lidar.beams());
  std::vector<std::unique_ptr<core::LocalCostmap>> costmaps;
  if (setup.sensors == Sensors::costmap)
    for (std::size_t i = 0; i < scenario.robots.size(); ++i)
      costmaps.push_back(std::make_unique<core::LocalCostmap>(robot.costmap, robot.radius_m));

  people.of(world);  // computes the navigation fields, once a trial
  const double start_s = bench::processor_s();
  const std::int64_t steps_per_tick = settings.control_period_ns / settings.step_ns;
  const auto steps = static_cast<std::int64_t>(setup.duration_s * 1e9) / settings.step_ns;
  for (std::int64_t step = 0; step < steps; ++step) {
    if (step % steps_per_tick == 0) {
      if (setup.sensors != Sensors::none) sense(sight, lidar, costmaps, ranges);
      for (std::uint32_t i = 0; i < scenario.robots.size(); ++i)
        world.set_command(i, {0.6, 0.0, i % 2 == 0 ? 0.15 : -0.15});
    }
    world.step(people.of(world));
  }
  return setup.duration_s / (bench::processor_s() - start_s);
}

double best_of(int rounds, const Setup& setup) {
  double best = 0.0;
  for (int i = 0; i < rounds; ++i) best = std::max(best, real_time_factor(setup));
  return best;
}

}  // namespace

int main(int argc, char** argv) {
  const bench::Output output = bench::output_options(argc, argv);
  const core::Scenario mall = bench::shipped_mall();
  const core::Scenario hall = bench::make_hall(100, 1000);
  std::vector<bench::Row> rows;
  const auto add = [&](const char* name, Setup setup) {
    if (output.quick) setup.duration_s = 1.0;
    rows.push_back(
        {"simulation/" + std::string(name) + "/real_time_factor", best_of(output.quick ? 1 : 3, setup), "1"});
  };
  add("mall_bare", {mall, Walking::straight, Sensors::none, 600.0});
  add("mall_lidar", {mall, Walking::straight, Sensors::lidar, 120.0});
  add("mall_costmap", {mall, Walking::straight, Sensors::costmap, 120.0});
  add("mall_social_force", {mall, Walking::social_force, Sensors::none, 600.0});
  add("mall_social_force_lidar", {mall, Walking::social_force, Sensors::lidar, 120.0});
  add("hall_bare", {hall, Walking::straight, Sensors::none, 20.0});
  add("hall_social_force", {hall, Walking::social_force, Sensors::none, 20.0});
  bench::write_rows(rows, output);
  return 0;
}
