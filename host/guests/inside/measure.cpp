// SPDX-License-Identifier: MIT
#include "host/guests/inside/measure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/random.hpp>
#include <set>
#include <stdexcept>
#include <string_view>
#include <tuple>

#include "host/errors/escaped_text.hpp"
#include "host/plugins/calls/host_callback.hpp"
#include "host/plugins/v1_sizes.hpp"
#include "host/results/result_bytes.hpp"

namespace dmrp::host {

namespace {

// The key of a value: the declared name, the subject, the coordinate.
using Key = std::tuple<std::size_t, std::uint32_t, std::optional<std::uint64_t>, std::optional<double>>;

struct CollectedValues {
  const PluginInfo& info;
  std::uint32_t robot_count;
  MetricResult result;
  std::set<Key> given;
  std::string refused{};  // why the last value or event was
  std::size_t bytes = 0;  // of the result
};

std::int32_t refuse(CollectedValues& collected, const char* what, const char* name, const std::string& why) {
  collected.refused = fmt::format(" (the host refused the {} '{}': {})", what, escaped(name), why);
  return DMRP_ERROR;
}

// Whether the result has room for it.
template <class Given>
bool has_room(CollectedValues& collected, const Given& given) {
  collected.bytes += bytes_of(given);
  return collected.bytes <= most_result_bytes;
}
constexpr const char* no_room = "the values and events of a metric in one trial take more than 32 MB";

std::optional<double> or_none(double value) {
  return std::isnan(value) ? std::nullopt : std::optional<double>(value);
}

CollectedValues& collected_by(dmrp_metric_sink* sink) {
  return *static_cast<CollectedValues*>(sink->context);
}

// Why a value cannot be taken; "" if it can.
std::string mistake_in(const dmrp_metric_result& c, const MetricValueSpec& spec, std::uint32_t robot_count) {
  if (c.subject_kind > DMRP_SUBJECT_PEDESTRIAN || !(spec.subjects & (1u << c.subject_kind)))
    return fmt::format("its descriptor declares no subject {}", c.subject_kind);
  if (c.subject_kind == DMRP_SUBJECT_ROBOT && c.subject >= robot_count)
    return fmt::format("robot {}, but there are {}", c.subject, robot_count);
  if (std::isinf(c.value) || std::isinf(c.coordinate)) return "it is infinite (NaN is undefined)";
  if (!spec.curve && !std::isnan(c.coordinate)) return "it has a coordinate, but is no curve";
  return "";
}

std::int32_t collect_value(CollectedValues& collected, const dmrp_metric_result& theirs) {
  if (!has_v1_0<dmrp_metric_result>(theirs.struct_size))
    return refuse(collected, "value", "", fmt::format("its struct_size is {}", theirs.struct_size));
  const dmrp_metric_result c = copy_struct(theirs);
  const auto& specs = collected.info.values;
  const auto spec = std::find_if(specs.begin(), specs.end(), [&](const auto& s) { return c.name && s.name == c.name; });
  if (spec == specs.end()) return refuse(collected, "value", c.name, "its descriptor does not declare it");
  if (const std::string mistake = mistake_in(c, *spec, collected.robot_count); !mistake.empty())
    return refuse(collected, "value", c.name, mistake);
  const auto subject = c.subject_kind == DMRP_SUBJECT_SYSTEM ? std::nullopt : std::optional(c.subject);
  const auto index = static_cast<std::size_t>(spec - specs.begin());
  if (!collected.given.emplace(index, c.subject_kind, subject, or_none(c.coordinate)).second)
    return refuse(collected, "value", c.name, "it was given before");
  MetricValue value = {spec->name, c.subject_kind, subject, or_none(c.coordinate), or_none(c.value)};
  if (!has_room(collected, value)) return refuse(collected, "value", c.name, no_room);
  collected.result.values.push_back(std::move(value));
  return DMRP_OK;
}

std::int32_t collect_event(CollectedValues& collected, const dmrp_event& theirs) {
  if (!has_v1_0<dmrp_event>(theirs.struct_size))
    return refuse(collected, "event", "", fmt::format("its struct_size is {}", theirs.struct_size));
  const dmrp_event c = copy_struct(theirs);
  if (!c.name) return refuse(collected, "event", "", "it has no name");
  if (c.to_ns < c.from_ns) return refuse(collected, "event", c.name, "it ends before it begins");
  if (c.subject_count > 0 && (!c.subjects || !has_stride_v1_0<dmrp_subject>(c.subject_stride)))
    return refuse(collected, "event", c.name, "its subjects cannot be read");
  MetricEvent event = {escaped(c.name), c.from_ns, c.to_ns, {}, {}, escaped(c.text), c.severity, std::nullopt};
  for (std::uint32_t i = 0; i < c.subject_count; ++i) {
    const dmrp_subject subject = copy_element(c.subjects, c.subject_stride, i);
    if (subject.reserved != 0)
      return refuse(collected, "event", c.name,
                    fmt::format("a reserved field of its subjects is {}, not 0", subject.reserved));
    if (subject.kind == DMRP_SUBJECT_ROBOT && subject.id >= collected.robot_count)
      return refuse(collected, "event", c.name,
                    fmt::format("robot {}, but there are {}", subject.id, collected.robot_count));
    if (subject.kind == DMRP_SUBJECT_ROBOT) event.robots.push_back(static_cast<std::uint32_t>(subject.id));
    if (subject.kind == DMRP_SUBJECT_PEDESTRIAN) event.people.push_back(subject.id);
  }
  if (event.severity > DMRP_SEVERITY_SERIOUS) event.severity = DMRP_SEVERITY_INFO;
  if (std::isfinite(c.place.x) && std::isfinite(c.place.y)) event.place = c.place;
  if (bytes_of(event) > most_event_bytes) return refuse(collected, "event", c.name, "it takes more than 1 MB");
  if (!has_room(collected, event)) return refuse(collected, "event", c.name, no_room);
  collected.result.events.push_back(std::move(event));
  return DMRP_OK;
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

// A missing value would look as if the metric had crashed. A metric need not look at what the host answers.
void check_complete(const CollectedValues& collected, const CallSite& site) {
  if (collected.bytes > most_result_bytes) throw PluginFault(fault_kind::bad_output, site, no_room);
  for (const MetricValueSpec& spec : collected.info.values) {
    const auto& values = collected.result.values;
    const bool given = std::any_of(values.begin(), values.end(), [&](const MetricValue& v) {
      return v.metric == spec.name && v.subject_kind == DMRP_SUBJECT_SYSTEM;
    });
    if (!given)
      throw PluginFault(fault_kind::bad_output, site,
                        fmt::format("gave no system value of {}{}", spec.name, collected.refused));
  }
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
  metric_.call("observe", step_++, call_budget_ns_, Answers::no_other,
               [&] { return table_.observe(metric_.self(), &sample); });
}

MetricResult Measurement::finish(const dmrp_trial_end& end) {
  CollectedValues collected = {info_, robot_count_, {index_, {}, {}}, {}};
  GrownStruct<dmrp_metric_sink> sink(sink_into(collected), metric_.grown_bytes());
  const auto call = [&] {
    return metric_.call("finish", step_, call_budget_ns_, Answers::no_other,
                        [&] { return table_.finish(metric_.self(), &end, &sink.c); });
  };
  with_reason(call, collected.refused);
  check_complete(collected, metric_.site("finish", step_));
  return std::move(collected.result);
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
  metric.offer([grids = std::weak_ptr(walking_grids)](std::string_view id) -> const void* {
    const auto here = grids.lock();
    return here && id == DMRP_EXT_WALKING_GRID ? here->extension() : nullptr;
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
