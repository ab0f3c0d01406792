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

MetricResult ask_metric(Guests& guests, const PluginUse& use, std::uint32_t index, const FinishedTrial& trial,
                        std::int64_t call_budget_ns) {
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
  const std::string_view text = guest.call({GuestTask::measure, metric.number, 0, call_budget_ns, arena.copy(input)});
  try {
    return believed(nlohmann::json::parse(text).get<MetricResult>(), use.info, trial.robots, index);
  } catch (const nlohmann::json::exception&) {
    throw_unbelievable(metric, "it cannot be read");
  } catch (const UnbelievableMessage& why) {
    throw_unbelievable(metric, why.what());
  }
}

}  // namespace dmrp::host
