// SPDX-License-Identifier: MIT
#include "host/trial/crowd_model.hpp"

#include <fmt/format.h>

#include <cmath>
#include <span>

namespace dmrp::host {

namespace {

constexpr double fastest_person_mps = 5.0;  // faster people are an error of the model

}  // namespace

CrowdModel::CrowdModel(Instance& model, const core::World& world, std::int64_t budget_ns)
    : model_(model), world_(world), budget_ns_(budget_ns), table_(model.table<dmrp_pedestrian_model>()) {}

CallGuard::Result CrowdModel::update(std::int64_t step) {
  const auto people = world_.people();
  const auto robots = world_.robot_agents();
  const dmrp_crowd crowd = {sizeof(crowd),       static_cast<std::uint32_t>(people.size()),
                            world_.t_ns(),       world_.settings().step_ns,
                            people.data(),       robots.data(),
                            sizeof(dmrp_person), static_cast<std::uint32_t>(robots.size()),
                            sizeof(dmrp_agent),  0};
  motions_.resize(people.size());
  dmrp_motions motions = {sizeof(motions), crowd.person_count, sizeof(dmrp_motion), 0, motions_.data()};
  input_.clear();
  input_.add(std::span(people.data(), people.size()));
  input_.add(std::span(robots.data(), robots.size()));
  const auto result = model_.call("step", step, budget_ns_, Answers::no_other,
                                  [&] { return table_.step(model_.self(), &crowd, &motions); });
  motions_.check(model_.site("step", step), "the motions");
  input_.check(model_.site("step", step), "the crowd");
  velocities_.resize(people.size());
  for (std::size_t i = 0; i < velocities_.size(); ++i) {
    velocities_[i] = motions_[i].velocity;
    if (!(std::hypot(velocities_[i].x, velocities_[i].y) <= fastest_person_mps))
      throw PluginFault(
          fault_kind::bad_output, model_.site("step", step),
          fmt::format("gave person {} the velocity ({}, {})", people[i].id, velocities_[i].x, velocities_[i].y));
  }
  return result;
}

}  // namespace dmrp::host
