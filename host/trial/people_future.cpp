// SPDX-License-Identifier: MIT
#include "host/trial/people_future.hpp"

#include <dmrp/toolkit/vec2.hpp>

namespace dmrp::host {

namespace {

constexpr std::int64_t told_ns = 10'000'000'000;

// The people keep clear of the robots' starts, as in the trial.
core::Scenario without_robots(core::Scenario scenario) {
  std::vector<dmrp_vec2> starts;
  for (const core::RobotTask& robot : scenario.robots) starts.push_back({robot.start.x, robot.start.y});
  scenario.other_starts.insert(scenario.other_starts.begin(), starts.begin(), starts.end());
  scenario.robots.clear();
  return scenario;
}

}  // namespace

PeopleFuture::PeopleFuture(const VariantWorld& variant, std::uint64_t seed, Instance* model, std::int64_t budget_ns)
    : world_(without_robots(variant.scenario), variant.types, variant.simulation, variant.geometry, variant.routes,
             seed) {
  if (model) crowd_.emplace(*model, world_, budget_ns);
  const auto last = static_cast<std::uint32_t>(told_ns / world_.settings().control_period_ns);
  extension_ = {sizeof(extension_), last, this,
                [](const dmrp_people_future* self, std::uint32_t periods_ahead) noexcept -> const dmrp_people_frame* {
                  const auto& frames = static_cast<const PeopleFuture*>(self->context)->frames_;
                  return periods_ahead < frames.size() ? &frames[periods_ahead].view : nullptr;
                }};
  keep_frame();
}

void PeopleFuture::advance(std::int64_t t_ns) {
  const std::int64_t period_ns = world_.settings().control_period_ns;
  while (world_.t_ns() < t_ns + extension_.last * period_ns) {
    step();
    if (world_.t_ns() % period_ns == 0) keep_frame();
  }
  while (frames_.front().view.t_ns < t_ns) frames_.pop_front();
}

void PeopleFuture::step() {
  at_rest_.assign(world_.people().size(), {0.0, 0.0});
  if (!crowd_ || at_rest_.empty()) {
    world_.step(at_rest_);
    return;
  }
  crowd_->update(world_.t_ns() / world_.settings().step_ns);
  world_.step(crowd_->velocities());
}

void PeopleFuture::keep_frame() {
  const auto people = world_.person_agents();
  Frame& frame = frames_.emplace_back();
  frame.people.assign(people.begin(), people.end());
  frame.view = {sizeof(frame.view), static_cast<std::uint32_t>(people.size()),           sizeof(dmrp_agent), 0,
                world_.t_ns(),      frame.people.empty() ? nullptr : frame.people.data()};
}

}  // namespace dmrp::host
