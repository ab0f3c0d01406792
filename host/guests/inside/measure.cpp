// SPDX-License-Identifier: MIT
#include "host/guests/inside/measure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/random.hpp>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "host/errors/escaped_text.hpp"
#include "host/guests/exchange/breach.hpp"
#include "host/plugins/calls/host_callback.hpp"
#include "host/plugins/v1_sizes.hpp"

namespace dmrp::host {

namespace {

struct CollectedValues {
  MetricAnswer answer;
  std::string refused{};  // why the last value or event was
};

std::int32_t refuse(CollectedValues& collected, const char* what, const char* name, const std::string& why) {
  collected.refused = fmt::format(" (the host refused the {} '{}': {})", what, escaped(name), why);
  return DMRP_ERROR;
}

template <class Given>
std::int32_t take(CollectedValues& collected, const char* what, const char* name, Given&& given) {
  const std::string breach = collected.answer.add(std::forward<Given>(given));
  return breach.empty() ? DMRP_OK : refuse(collected, what, name, breach);
}

std::optional<double> or_none(double value) {
  return std::isnan(value) ? std::nullopt : std::optional<double>(value);
}

CollectedValues& collected_by(dmrp_metric_sink* sink) {
  return *static_cast<CollectedValues*>(sink->context);
}

std::int32_t collect_value(CollectedValues& collected, const dmrp_metric_result& theirs) {
  if (!has_v1_0<dmrp_metric_result>(theirs.struct_size))
    return refuse(collected, "value", "", fmt::format("its struct_size is {}", theirs.struct_size));
  const dmrp_metric_result c = copy_struct(theirs);
  const auto subject = c.subject_kind == DMRP_SUBJECT_SYSTEM ? std::nullopt : std::optional(c.subject);
  MetricValue value = {c.name ? c.name : "", c.subject_kind, subject, or_none(c.coordinate), or_none(c.value)};
  return take(collected, "value", c.name, std::move(value));
}

std::int32_t collect_event(CollectedValues& collected, const dmrp_event& theirs) {
  if (!has_v1_0<dmrp_event>(theirs.struct_size))
    return refuse(collected, "event", "", fmt::format("its struct_size is {}", theirs.struct_size));
  const dmrp_event c = copy_struct(theirs);
  if (!c.name) return refuse(collected, "event", "", "it has no name");
  if (c.subject_count > 0 && (!c.subjects || !has_stride_v1_0<dmrp_subject>(c.subject_stride)))
    return refuse(collected, "event", c.name, "its subjects cannot be read");
  MetricEvent event = {escaped(c.name), c.from_ns, c.to_ns, {}, {}, escaped(c.text), c.severity, std::nullopt};
  for (std::uint32_t i = 0; i < c.subject_count; ++i) {
    const dmrp_subject subject = copy_element(c.subjects, c.subject_stride, i);
    if (subject.reserved != 0)
      return refuse(collected, "event", c.name,
                    fmt::format("a reserved field of its subjects is {}, not 0", subject.reserved));
    constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
    if (subject.kind == DMRP_SUBJECT_ROBOT)
      event.robots.push_back(static_cast<std::uint32_t>(std::min(subject.id, most)));
    if (subject.kind == DMRP_SUBJECT_PEDESTRIAN) event.people.push_back(subject.id);
  }
  if (event.severity > DMRP_SEVERITY_SERIOUS) event.severity = DMRP_SEVERITY_INFO;
  if (std::isfinite(c.place.x) && std::isfinite(c.place.y)) event.place = c.place;
  return take(collected, "event", c.name, std::move(event));
}

dmrp_metric_sink sink_into(CollectedValues& collected) {
  dmrp_metric_sink sink{};
  sink.struct_size = sizeof(sink);
  sink.context = &collected;
  sink.value = [](dmrp_metric_sink* self, const dmrp_metric_result* result) noexcept -> std::int32_t {
    return result ? or_out_of_memory([&] { return collect_value(collected_by(self), *result); }) : DMRP_ERROR;
  };
  sink.event = [](dmrp_metric_sink* self, const dmrp_event* event) noexcept -> std::int32_t {
    return event ? or_out_of_memory([&] { return collect_event(collected_by(self), *event); }) : DMRP_ERROR;
  };
  return sink;
}

// What robots do without their controllers: the events of DMRP_CHANNEL_RECOVERIES.
bool is_of_recoveries(const dmrp_robot_event& event) {
  return event.kind == DMRP_ROBOT_EVENT_RECOVERY || event.kind == DMRP_ROBOT_EVENT_MONITOR ||
         event.kind == DMRP_ROBOT_EVENT_ROUTE;
}

}  // namespace

Measurement::Measurement(Instance& metric, const PluginInfo& info, std::uint32_t index, std::uint32_t robot_count,
                         std::int64_t call_budget_ns)
    : metric_(metric),
      info_(info),
      index_(index),
      robot_count_(robot_count),
      call_budget_ns_(call_budget_ns),
      table_(metric.table<dmrp_metric>()) {}

void Measurement::begin(const dmrp_metric_trial& trial) {
  metric_.call("begin", 0, call_budget_ns_, Answers::unsupported, [&] { return table_.begin(metric_.self(), &trial); });
}

void Measurement::observe(const dmrp_sample& sample) {
  const auto* const bytes = reinterpret_cast<const std::byte*>(&sample);
  shown_.assign(bytes, bytes + sample.struct_size);  // with what a newer sample has more
  auto& shown = *reinterpret_cast<dmrp_sample*>(shown_.data());
  if (!(info_.channels & DMRP_CHANNEL_PEOPLE)) shown.people = nullptr, shown.person_count = 0;
  if (!(info_.channels & DMRP_CHANNEL_CALLS)) shown.calls = nullptr, shown.call_count = 0;
  if (!(info_.channels & DMRP_CHANNEL_ROUTES)) shown.routes = nullptr, shown.route_count = 0;
  if (!(info_.channels & DMRP_CHANNEL_RECOVERIES)) leave_out_recoveries(shown);
  metric_.call("observe", step_++, call_budget_ns_, Answers::no_other,
               [&] { return table_.observe(metric_.self(), &shown); });
}

void Measurement::leave_out_recoveries(dmrp_sample& sample) {
  events_.clear();
  for (std::uint32_t i = 0; i < sample.event_count; ++i) {
    const dmrp_robot_event* const event = DMRP_AT(dmrp_robot_event, sample.events, sample.event_stride, i);
    if (is_of_recoveries(*event)) continue;
    const auto* const bytes = reinterpret_cast<const std::byte*>(event);
    events_.insert(events_.end(), bytes, bytes + sample.event_stride);
  }
  sample.event_count = static_cast<std::uint32_t>(events_.size() / std::max(1u, sample.event_stride));
  sample.events = reinterpret_cast<const dmrp_robot_event*>(events_.data());
}

MetricResult Measurement::finish(const dmrp_trial_end& end) {
  CollectedValues collected = {MetricAnswer(info_, robot_count_, index_)};
  GrownStruct<dmrp_metric_sink> sink(sink_into(collected), metric_.grown_bytes());
  const auto call = [&] {
    return metric_.call("finish", step_, call_budget_ns_, Answers::no_other,
                        [&] { return table_.finish(metric_.self(), &end, &sink.c); });
  };
  with_reason(call, collected.refused);
  if (const std::string breach = collected.answer.breach(collected.refused); !breach.empty())
    throw PluginFault(fault_kind::bad_output, metric_.site("finish", step_), breach);
  return std::move(collected.answer.result());
}

namespace {

// What a metric has of a trial that is not for it.
MetricResult without_values(const PluginInfo& info, std::uint32_t index) {
  MetricResult result = {index, {}, {}};
  for (const MetricValueSpec& spec : info.values)
    result.values.push_back({spec.name, DMRP_SUBJECT_SYSTEM, std::nullopt, std::nullopt, std::nullopt});
  return result;
}

}  // namespace

MetricResult measure(core::TraceReader& trace, const std::shared_ptr<WalkingGrids>& walking_grids, Instance& metric,
                     const PluginInfo& info, std::uint32_t index, std::uint64_t seed, std::int64_t call_budget_ns) {
  if (!trace.end()) throw std::invalid_argument("the trace was cut short: it has no end");
  metric.offer([grids = std::weak_ptr(walking_grids), &guard = metric.guard()](std::string_view id) -> const void* {
    const auto here = grids.lock();
    return here && id == DMRP_EXT_WALKING_GRID ? here->extension(&guard) : nullptr;
  });
  Measurement measurement(metric, info, index, trace.world().robot_count, call_budget_ns);
  try {
    metric.start(trace.world(), toolkit::Stream(seed, "metric", info.id).next_u64(), call_budget_ns);
    measurement.begin({sizeof(dmrp_metric_trial), 0, trace.first_plan()});
  } catch (const PluginFault& fault) {
    if (fault.kind() == std::string_view(fault_kind::unsupported)) return without_values(info, index);
    throw;
  }
  // without a plan nothing moved: the only sample records the planner's call
  const bool shown = trace.end()->ending != DMRP_ENDING_NO_PLAN || (info.channels & DMRP_CHANNEL_CALLS) != 0;
  trace.rewind();
  while (const dmrp_sample* sample = shown ? trace.next_sample() : nullptr) measurement.observe(*sample);
  return measurement.finish(*trace.end());
}

}  // namespace dmrp::host
