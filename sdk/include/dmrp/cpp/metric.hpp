// SPDX-License-Identifier: MIT
// cpp/metric.hpp: the base class of metrics; the contract is in ../metric.h.
#pragma once

#include <cstdint>
#include <limits>
#include <stdexcept>

#include "../metric.h"
#include "path.hpp"
#include "plugin_base.hpp"

namespace dmrp {

using Person = dmrp_person;
using RobotSample = dmrp_robot_sample;
using Contact = dmrp_contact;
using Call = dmrp_call;
using RobotEvent = dmrp_robot_event;
using Statistic = dmrp_statistic;
using Subject = dmrp_subject;

// dmrp_route with its path as a view.
struct Route : dmrp_route {
  Path path() const { return Path(*dmrp_route::path, flags); }
};

// A value that is undefined for this trial: NULL in the results.
constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

// A plan with spans, if there is one. It is valid until finish() returns; an object of this class is a cheap view.
class Plan {
 public:
  Plan() = default;
  explicit Plan(const dmrp_plan* c) : c_(c) {}

  explicit operator bool() const { return c_ != nullptr; }
  std::size_t size() const { return c_ ? c_->path_count : 0; }  // paths, one per robot
  Path path(std::size_t robot) const { return Path(*DMRP_AT(dmrp_path, c_->paths, c_->path_stride, robot)); }
  Span<Statistic> statistics() const { return {c_->statistics, c_->statistic_count, c_->statistic_stride}; }
  const dmrp_plan* operator->() const { return c_; }  // revision, from_ns, step_duration_ns, planning_ns, status

 private:
  const dmrp_plan* c_ = nullptr;
};

// What is known before the first sample.
struct MetricTrial {
  explicit MetricTrial(const dmrp_metric_trial& c) : plan(c.plan) {}

  Plan plan;  // the first; none if planning failed or there are no robots
};

// dmrp_sample with spans. Valid until observe() returns.
struct Sample {
  explicit Sample(const dmrp_sample& c)
      : t_ns(c.t_ns),
        dt_ns(c.dt_ns),
        control_tick(c.control_tick != 0),
        plan(c.plan),
        robots(c.robots, c.robot_count, c.robot_stride),
        people(c.people, c.person_count, c.person_stride),
        contacts(c.contacts, c.contact_count, c.contact_stride),
        calls(c.calls, c.call_count, c.call_stride),
        events(c.events, c.event_count, c.event_stride),
        routes(c.routes, c.route_count, c.route_stride) {}

  std::int64_t t_ns;
  std::int64_t dt_ns;
  bool control_tick;
  Plan plan;  // in force, if there is one
  Span<RobotSample> robots;
  Span<Person> people;
  Span<Contact> contacts;
  Span<Call> calls;
  Span<RobotEvent> events;
  Span<Route> routes;
};

enum class Severity : std::uint32_t {
  info = DMRP_SEVERITY_INFO,
  warning = DMRP_SEVERITY_WARNING,
  serious = DMRP_SEVERITY_SERIOUS
};

// An event for the time line; name and text live until event() returns.
struct Event {
  const char* name;
  std::int64_t from_ns;
  std::int64_t to_ns;
  std::vector<Subject> subjects;
  std::string text;
  Vec2 place = {undefined, undefined};
  Severity severity = Severity::info;
};

inline Subject robot_subject(std::uint64_t index) {
  return {DMRP_SUBJECT_ROBOT, 0, index};
}
inline Subject person_subject(std::uint64_t id) {
  return {DMRP_SUBJECT_PEDESTRIAN, 0, id};
}

class MetricSink {
 public:
  explicit MetricSink(dmrp_metric_sink* c) : c_(c) {}

  void system(const char* name, double value) { give(name, DMRP_SUBJECT_SYSTEM, 0, undefined, value); }
  void robot(const char* name, std::size_t robot, double value) {
    give(name, DMRP_SUBJECT_ROBOT, robot, undefined, value);
  }
  void pedestrian(const char* name, std::uint64_t id, double value) {
    give(name, DMRP_SUBJECT_PEDESTRIAN, id, undefined, value);
  }
  // One point of a curve whose subject is the system.
  void curve(const char* name, double coordinate, double value) {
    give(name, DMRP_SUBJECT_SYSTEM, 0, coordinate, value);
  }
  void event(const Event& event) {
    const dmrp_event c = {sizeof(c),
                          static_cast<std::uint32_t>(event.severity),
                          event.name,
                          event.from_ns,
                          event.to_ns,
                          event.subjects.data(),
                          static_cast<std::uint32_t>(event.subjects.size()),
                          sizeof(Subject),
                          event.place,
                          event.text.c_str()};
    check(c_->event(c_, &c), "an event", event.name);
  }

 private:
  void give(const char* name, std::uint32_t subject_kind, std::uint64_t subject, double coordinate, double value) {
    const dmrp_metric_result result = {sizeof(result), subject_kind, name, subject, coordinate, value};
    check(c_->value(c_, &result), "a value", name);
  }
  static void check(std::int32_t status, const char* what, const char* name) {
    if (status == DMRP_OUT_OF_MEMORY) throw std::bad_alloc();
    if (status != DMRP_OK) throw std::logic_error(std::string("the host refused ") + what + " of " + name);
  }
  dmrp_metric_sink* c_;
};

class Metric : public Plugin {
 public:
  // Throw to report an error, or Unsupported if the metric has no values for this trial.
  virtual void begin(const MetricTrial& trial) = 0;
  virtual void observe(const Sample& sample) = 0;
  virtual void finish(const TrialEnd& end, MetricSink& sink) = 0;

  DMRP_LOCAL static constexpr std::uint32_t interface_kind = DMRP_KIND_METRIC;
  static constexpr dmrp_metric interface_table() {
    return {sizeof(dmrp_metric), 0, &call_begin, &call_observe, &call_finish};
  }

 private:
  template <class Body>
  static std::int32_t call(dmrp_instance* self, Body&& body) {
    auto& metric = detail::from_instance<Metric>(self);
    return PluginAccess::guarded(metric, [&] { return body(metric), Status::ok; });
  }
  static std::int32_t call_begin(dmrp_instance* self, const dmrp_metric_trial* trial) {
    return call(self, [&](Metric& metric) { metric.begin(MetricTrial(*trial)); });
  }
  static std::int32_t call_observe(dmrp_instance* self, const dmrp_sample* sample) {
    return call(self, [&](Metric& metric) { metric.observe(Sample(*sample)); });
  }
  static std::int32_t call_finish(dmrp_instance* self, const dmrp_trial_end* end, dmrp_metric_sink* sink) {
    return call(self, [&](Metric& metric) {
      MetricSink out(sink);
      metric.finish(TrialEnd(*end), out);
    });
  }
};

}  // namespace dmrp
