// SPDX-License-Identifier: MIT
#include "host/trial/ask_metric.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>
#include <tuple>

#include "host/results/result_bytes.hpp"
#include "host/results/result_json.hpp"
#include "host/trial/trial_plugins.hpp"

namespace dmrp::host {

namespace {

bool may_be_value(const MetricValue& value, const MetricValueSpec& declared, std::uint32_t robots) {
  if (value.subject_kind > DMRP_SUBJECT_PEDESTRIAN || !(declared.subjects & (1u << value.subject_kind))) return false;
  if (value.subject.has_value() == (value.subject_kind == DMRP_SUBJECT_SYSTEM)) return false;
  if (value.subject_kind == DMRP_SUBJECT_ROBOT && *value.subject >= robots) return false;
  if (value.coordinate && !declared.curve) return false;
  return std::isfinite(value.value.value_or(0.0)) && std::isfinite(value.coordinate.value_or(0.0));
}

bool may_be_event(const MetricEvent& event, std::uint32_t robots) {
  return event.from_ns <= event.to_ns && event.severity <= DMRP_SEVERITY_SERIOUS &&
         std::all_of(event.robots.begin(), event.robots.end(), [&](std::uint32_t robot) { return robot < robots; });
}

std::size_t bytes_of_all(const MetricResult& result) {
  std::size_t bytes = 0;
  for (const MetricValue& value : result.values) bytes += bytes_of(value);
  for (const MetricEvent& event : result.events) bytes += bytes_of(event);
  return bytes;
}

[[noreturn]] void throw_unbelievable(const GuestInstance& metric, const char* why) {
  throw PluginFault(fault_kind::abi_breach, metric.site("finish", 0),
                    fmt::format("wrote its answer into the memory that it shares with the host: {}", why), true);
}

}  // namespace

std::optional<std::string> breach_of(const MetricResult& result, const PluginInfo& metric, std::uint32_t robots) {
  std::set<std::tuple<std::string_view, std::uint32_t, std::optional<std::uint64_t>, std::optional<double>>> given;
  for (const MetricValue& value : result.values) {
    const auto declared = std::find_if(metric.values.begin(), metric.values.end(),
                                       [&](const MetricValueSpec& spec) { return spec.name == value.metric; });
    if (declared == metric.values.end()) return fmt::format("{} does not declare this value", metric.id);
    if (!may_be_value(value, *declared, robots)) return fmt::format("no value of {} can be this", value.metric);
    if (!given.emplace(value.metric, value.subject_kind, value.subject, value.coordinate).second)
      return fmt::format("a value of {} twice", value.metric);
  }
  for (const MetricEvent& event : result.events)
    if (!may_be_event(event, robots)) return fmt::format("no event of {} can be this", metric.id);
  if (bytes_of_all(result) > most_result_bytes) return "more than a metric may give";
  return std::nullopt;
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
    MetricResult result = nlohmann::json::parse(text).get<MetricResult>();
    result.index = index;
    const auto breach = breach_of(result, use.info, trial.robots);
    if (!breach) return result;
    throw UnbelievableMessage(*breach);
  } catch (const nlohmann::json::exception&) {
    throw_unbelievable(metric, "it cannot be read");
  } catch (const UnbelievableMessage& why) {
    throw_unbelievable(metric, why.what());
  }
}

}  // namespace dmrp::host
