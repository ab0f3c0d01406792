// SPDX-License-Identifier: MIT
#include "host/trial/measure.hpp"

#include <dmrp/metric.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/random.hpp>
#include <set>
#include <stdexcept>
#include <tuple>

namespace dmrp::host {

namespace {

// The key of a value: the declared name, the subject, the coordinate.
using Key = std::tuple<std::size_t, std::uint32_t, std::optional<std::uint64_t>, std::optional<double>>;

struct Collected {
  const PluginInfo& info;
  std::uint32_t robot_count;
  MetricResult result;
  std::set<Key> given;
};

std::optional<double> or_none(double value) {
  return std::isnan(value) ? std::nullopt : std::optional<double>(value);
}

std::int32_t collect_value(dmrp_metric_sink* sink, const char* name, std::uint32_t subject_kind, std::uint64_t subject,
                           double coordinate, double value) {
  auto& collected = *static_cast<Collected*>(sink->context);
  const auto& specs = collected.info.values;
  const auto spec = std::find_if(specs.begin(), specs.end(), [&](const auto& s) { return name && s.name == name; });
  if (spec == specs.end() || subject_kind > DMRP_SUBJECT_PEDESTRIAN || !(spec->subjects & (1u << subject_kind)))
    return DMRP_ERROR;
  if (subject_kind == DMRP_SUBJECT_ROBOT && subject >= collected.robot_count) return DMRP_ERROR;
  if (std::isinf(value) || std::isinf(coordinate) || (!spec->curve && !std::isnan(coordinate))) return DMRP_ERROR;
  const auto subject_id = subject_kind == DMRP_SUBJECT_SYSTEM ? std::nullopt : std::optional<std::uint64_t>(subject);
  const auto index = static_cast<std::size_t>(spec - specs.begin());
  if (!collected.given.emplace(index, subject_kind, subject_id, or_none(coordinate)).second) return DMRP_ERROR;
  collected.result.values.push_back({spec->name, subject_kind, subject_id, or_none(coordinate), or_none(value)});
  return DMRP_OK;
}

std::int32_t collect_event(dmrp_metric_sink* sink, const char* name, std::int64_t from_ns, std::int64_t to_ns,
                           const std::uint32_t* robots, std::uint32_t robot_count, const char* text) {
  auto& collected = *static_cast<Collected*>(sink->context);
  if (!name || to_ns < from_ns) return DMRP_ERROR;
  if (std::any_of(robots, robots + robot_count, [&](std::uint32_t r) { return r >= collected.robot_count; }))
    return DMRP_ERROR;
  collected.result.events.push_back(
      {name, from_ns, to_ns, std::vector<std::uint32_t>(robots, robots + robot_count), text ? text : ""});
  return DMRP_OK;
}

// A missing value would look as if the metric had crashed.
void check_complete(const Collected& collected, const CallSite& site) {
  for (const MetricValueSpec& spec : collected.info.values) {
    const auto& values = collected.result.values;
    const bool given = std::any_of(values.begin(), values.end(), [&](const MetricValue& v) {
      return v.metric == spec.name && v.subject_kind == DMRP_SUBJECT_SYSTEM;
    });
    if (!given) throw PluginFault(fault_kind::bad_output, site, fmt::format("gave no system value of {}", spec.name));
  }
}

}  // namespace

MetricResult measure(core::TraceReader& trace, Instance& metric, const PluginInfo& info, std::uint32_t index,
                     std::uint64_t seed, std::int64_t call_budget_ns) {
  if (!trace.end()) throw std::invalid_argument("the trace was cut short: it has no end");
  const auto table = metric.table<dmrp_metric>();
  metric.start(trace.world(), toolkit::Stream(seed, "metric", info.id).next_u64(), call_budget_ns);

  const dmrp_metric_trial trial = {sizeof(trial), 0, trace.first_plan()};
  metric.call("begin", 0, call_budget_ns, [&] { return table.begin(metric.self(), &trial); });

  // without a plan nothing moved: the only sample records the planner's call
  const bool shown = trace.end()->ending != DMRP_ENDING_NO_PLAN || (info.channels & DMRP_CHANNEL_CALLS) != 0;
  trace.rewind();
  std::int64_t step = 0;
  while (const dmrp_sample* sample = shown ? trace.next_sample() : nullptr)
    metric.call("observe", step++, call_budget_ns, [&] { return table.observe(metric.self(), sample); });

  Collected collected = {info, trace.world().robot_count, {index, {}, {}}, {}};
  dmrp_metric_sink sink = {sizeof(sink), 0, &collected, &collect_value, &collect_event};
  metric.call("finish", step, call_budget_ns, [&] { return table.finish(metric.self(), trace.end(), &sink); });
  check_complete(collected, metric.site("finish", step));
  return std::move(collected.result);
}

}  // namespace dmrp::host
