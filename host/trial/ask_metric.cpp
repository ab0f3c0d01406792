// SPDX-License-Identifier: MIT
#include "host/trial/ask_metric.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>

#include "host/guests/exchange/breach.hpp"
#include "host/results/result_json.hpp"
#include "host/trial/trial_plugins.hpp"

namespace dmrp::host {

namespace {

[[noreturn]] void throw_unbelievable(const GuestInstance& metric, const char* why) {
  throw PluginFault(fault_kind::abi_breach, metric.site("finish", 0),
                    fmt::format("wrote its answer into the memory that it shares with the host: {}", why), true);
}

}  // namespace

MetricResult believed(MetricResult given, const PluginInfo& metric, std::uint32_t robots, std::uint32_t index) {
  MetricAnswer answer(metric, robots, index);
  for (MetricValue& value : given.values)
    if (const std::string breach = answer.add(std::move(value)); !breach.empty())
      throw UnbelievableMessage("a value: " + breach);
  for (MetricEvent& event : given.events)
    if (const std::string breach = answer.add(std::move(event)); !breach.empty())
      throw UnbelievableMessage("an event: " + breach);
  return std::move(answer.result());
}

std::int64_t metric_budget_ns(double step_time_s, const FinishedTrial& trial) {
  constexpr double share_a_robot = 0.05;  // of step_time_s
  constexpr double share_a_robot_second = 0.001;
  return nanoseconds(step_time_s * (1.0 + trial.robots * (share_a_robot + share_a_robot_second * trial.sim_time_s)));
}

MetricResult ask_metric(Guests& guests, const PluginUse& use, std::uint32_t index, const FinishedTrial& trial,
                        double step_time_s) {
  const GuestInstance& metric = guests.get(use, DMRP_NO_ROBOT);
  Guest& guest = *metric.guest;
  MeasureInput input{};
  const SentWorld* world = nullptr;
  const VariantWorld* const shared = trial.variant ? &trial.variant->shared() : nullptr;
  if (shared) world = &guest.shared_world(shared->view.world(), grids_of(*shared, DMRP_KIND_METRIC));
  if (!trial.records.empty()) input.trace = guest.trace(trial.records);
  Arena& arena = guest.begin();
  if (world) input.scene = guest.scene(*world, shared->walking_grids->known());
  input.trace_bytes = trial.records.size();
  input.seed = trial.seed;
  input.index = index;
  const std::string_view text =
      guest.call({GuestTask::measure, metric.number, 0, metric_budget_ns(step_time_s, trial), arena.copy(input)});
  try {
    return believed(nlohmann::json::parse(text).get<MetricResult>(), use.info, trial.robots, index);
  } catch (const nlohmann::json::exception&) {
    throw_unbelievable(metric, "it cannot be read");
  } catch (const UnbelievableMessage& why) {
    throw_unbelievable(metric, why.what());
  }
}

}  // namespace dmrp::host
