// SPDX-License-Identifier: MIT
// A pedestrian model moves the people of the stage, among robots that drive to their goals.
#include <memory>

#include "host/check/rehearsal/rehearsal.hpp"
#include "host/check/rehearsal/stage_extensions.hpp"
#include "host/guests/exchange/breach.hpp"

namespace dmrp::host {

namespace {

class PedestrianCalls {
 public:
  PedestrianCalls(Instance& instance, const PluginInfo& info, Stage& stage)
      : instance_(instance),
        stage_(stage),
        table_(instance.table<dmrp_pedestrian_model>()),
        extensions_(instance, info, stage, 0),
        inputs_(stage.settings.grown_bytes) {
    for (std::uint32_t i = 0; i < stage.world.robots().size(); ++i) stage.world.set_command(i, {0.5, 0.0, 0.0});
  }

  bool next(Outputs& outputs) {
    if (step_ >= stage_.settings.ticks) {
      const dmrp_trial_end end = {sizeof(end), DMRP_ENDING_TIME_LIMIT, stage_.world.t_ns(), nullptr,
                                  0,           sizeof(dmrp_robot_end)};
      instance_.end_trial(end, step_, stage_budget_ns);
      return false;
    }
    const std::vector<dmrp_person> people = stage_.people();
    const std::vector<dmrp_agent> robots = stage_.agents(stage_.world.robot_agents());
    const std::vector<dmrp_motion> none(people.size());
    inputs_.clear();
    // motions are the plugin's to write to: not part of the inputs that are compared
    Inputs motions_memory(stage_.settings.grown_bytes);
    dmrp_motions motions = {sizeof(motions), static_cast<std::uint32_t>(people.size()),
                            motions_memory.stride<dmrp_motion>(), 0, motions_memory.array(none.data(), none.size())};
    const dmrp_crowd* const crowd = inputs_.one(dmrp_crowd{
        0, motions.count, stage_.world.t_ns(), stage_.variant.simulation.step_ns,
        inputs_.array(people.data(), people.size()), inputs_.array(robots.data(), robots.size()),
        inputs_.stride<dmrp_person>(), static_cast<std::uint32_t>(robots.size()), inputs_.stride<dmrp_agent>(), 0});
    inputs_.seal();
    instance_.call("step", step_, stage_budget_ns, Answers::no_other,
                   [&] { return table_.step(instance_.self(), crowd, &motions); });
    motions_memory.check_output<dmrp_motion>(people.size(), instance_.site("step", step_));
    std::vector<dmrp_vec2> velocities;
    for (std::size_t i = 0; i < people.size(); ++i) {
      const dmrp_vec2 velocity = motions_memory.at(motions.motions, i).velocity;
      if (const std::string breach = breach_of(people[i].id, velocity); !breach.empty())
        throw PluginFault(fault_kind::bad_output, instance_.site("step", step_), breach);
      velocities.push_back(velocity);
      outputs.insert(outputs.end(), {velocity.x, velocity.y});
    }
    stage_.world.step(velocities);
    ++step_;
    return true;
  }

 private:
  Instance& instance_;
  Stage& stage_;
  dmrp_pedestrian_model table_;
  StageExtensions extensions_;
  Inputs inputs_;
  std::int64_t step_ = 0;
};

}  // namespace

Calls pedestrian_calls(Instance& instance, const PluginInfo& info, Stage& stage) {
  return [calls = std::make_shared<PedestrianCalls>(instance, info, stage)](Outputs& outputs) {
    return calls->next(outputs);
  };
}

}  // namespace dmrp::host
