// SPDX-License-Identifier: MIT
// synthetic_trial.hpp: a trial written by hand, and the values that a metric of libdmrp_metrics.so measures in it:
//
//   SyntheticTrial trial(2);
//   trial.plan({{{0, 0}, {1, 0}}, {{5, 0}}});                 // a path a robot, one waypoint a second
//   trial.sample(0.0, {at(0, 0), at(5, 0)});                  // the latest plan is the current one
//   trial.sample(1.0, {at(1, 0, 1.0), at(5, 0)});             // the first robot drives 1 m/s
//   trial.end(1.0, {1.0, never});                             // it arrives; the second does not
//   const Measurement m = measure("dmrp.metric.path_length", trial);
//   m.system("path_length"), m.robot("path_length", 0), m.events
#pragma once

#include <dmrp/dmrp.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <deque>
#include <limits>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "tests/unit/plugin_under_test.hpp"

namespace dmrp::test {

constexpr double never = -1.0;  // as a time of arrival
constexpr std::uint32_t parked = DMRP_ROBOT_FINISHED;

// Of contacts.
constexpr std::uint32_t begins = DMRP_CONTACT_BEGINS;
constexpr std::uint32_t fault_a = DMRP_CONTACT_FAULT_A;
constexpr std::uint32_t fault_b = DMRP_CONTACT_FAULT_B;

inline std::int64_t nanoseconds(double seconds) {
  return std::llround(seconds * 1e9);
}

// A robot at a sample: its position, its measured forward speed, its state.
inline dmrp_robot_sample at(double x, double y, double speed = 0.0, std::uint32_t state = DMRP_ROBOT_ACTIVE) {
  dmrp_robot_sample robot{};
  robot.pose = {x, y, 0.0};
  robot.velocity.v_x = speed;
  robot.state = state;
  return robot;
}

inline dmrp_robot_sample facing(double x, double y, double theta, std::uint32_t state = DMRP_ROBOT_ACTIVE) {
  dmrp_robot_sample robot = at(x, y, 0.0, state);
  robot.pose.theta = theta;
  return robot;
}

inline dmrp_waypoint waypoint(double x, double y, double t_s) {
  return {x, y, std::nan(""), nanoseconds(t_s), 0, 0};
}

inline dmrp_contact contact(std::uint32_t kind, std::uint32_t a, std::uint32_t b, std::uint32_t flags) {
  return {kind, flags, a, b, 0.01, {0.0, 0.0}, std::nan("")};
}

// The referee's change of a robot's class, for events().
inline dmrp_robot_event becomes(std::uint32_t robot, std::uint32_t detail, std::uint32_t other = DMRP_NOBODY) {
  return {DMRP_ROBOT_EVENT_CLASS, robot, 0, detail, other};
}

// An array element as in a later version of the contract: metrics must use the stride.
template <class Element>
struct Longer {
  Element element;
  double later_field = -1.0;
};

template <class Element>
std::vector<Longer<Element>> longer(const std::vector<Element>& elements) {
  std::vector<Longer<Element>> out;
  for (const Element& element : elements) out.push_back({element});
  return out;
}

using Points = std::vector<dmrp_vec2>;

class SyntheticTrial {
 public:
  // Robots are discs of 0.25 m, brake by 1 m/s^2 and have one goal each at the origin; the world reaches from (-1000, -1000) to (1000, 1000)
  // and has one shape, a square of 2 m about (900, 900).
  explicit SyntheticTrial(std::size_t robot_count) : robots_(robot_count) {
    footprint_->radius_m = footprint_->inscribed_radius_m = 0.25;
    for (dmrp_robot& robot : robots_) {
      robot.footprint = footprint_.get();
      robot.limits = limits_.get();
    }
    for (std::size_t robot = 0; robot < robot_count; ++robot) route(robot, {0, 0, 0}, {{0, 0, std::nan("")}});
    box("shelf B", {899, 899}, {901, 901});
  }
  SyntheticTrial(SyntheticTrial&&) =
      default;  // the targets of plans' pointers keep their addresses; a copy would point into the original

  SyntheticTrial& route(std::size_t robot, dmrp_pose start, const std::vector<dmrp_pose>& goals) {
    goals_.emplace_back();
    for (const dmrp_pose& pose : goals) goals_.back().push_back({{pose, 0.2, 0.1, 0.1, 500'000'000}});
    robots_[robot].start = start;
    robots_[robot].goals = &goals_.back().front().element;
    robots_[robot].goal_count = static_cast<std::uint32_t>(goals.size());
    robots_[robot].goal_stride = sizeof(Longer<dmrp_goal>);
    return *this;
  }
  SyntheticTrial& robot_radius(double radius_m) {
    footprint_->radius_m = footprint_->inscribed_radius_m = radius_m;
    return *this;
  }
  // All robots are rectangles about their origin.
  SyntheticTrial& robot_rectangle(double half_length_m, double half_width_m) {
    outlines_.push_back({{-half_length_m, -half_width_m},
                         {half_length_m, -half_width_m},
                         {half_length_m, half_width_m},
                         {-half_length_m, half_width_m}});
    part_->element = {outlines_.back().data(), 4, 0};
    footprint_->part_count = 1;
    footprint_->parts = &part_->element;
    footprint_->part_stride = sizeof(*part_);
    footprint_->radius_m = std::hypot(half_length_m, half_width_m);
    footprint_->inscribed_radius_m = std::min(half_length_m, half_width_m);
    return *this;
  }
  SyntheticTrial& bounds(dmrp_vec2 lower, dmrp_vec2 upper) {
    lower_ = lower;
    upper_ = upper;
    return *this;
  }
  SyntheticTrial& box(const char* name, dmrp_vec2 lower, dmrp_vec2 upper) {
    outlines_.push_back({lower, {upper.x, lower.y}, upper, {lower.x, upper.y}});
    dmrp_shape shape{};
    shape.name = name;
    shape.kind = DMRP_SHAPE_POLYGON;
    shape.vertex_count = 4;
    shape.vertices = outlines_.back().data();
    shapes_.push_back(shape);
    return *this;
  }
  SyntheticTrial& circle(const char* name, dmrp_vec2 center, double radius_m) {
    dmrp_shape shape{};
    shape.name = name;
    shape.kind = DMRP_SHAPE_CIRCLE;
    shape.center = center;
    shape.radius_m = radius_m;
    shapes_.push_back(shape);
    return *this;
  }
  // The planning grid: free cells of 1 m from (0, 0) on, with all moves between them. Without it there are no cells.
  SyntheticTrial& planning_grid(std::uint32_t columns, std::uint32_t rows) {
    free_.assign(static_cast<std::size_t>(columns) * rows, 1);
    edges_.assign(free_.size(), 0xFF);
    for (std::uint32_t row = 0; row < rows; ++row)
      for (std::uint32_t column = 0; column < columns; ++column) {
        std::uint8_t& edges = edges_[static_cast<std::size_t>(row) * columns + column];
        if (column == 0) edges &= static_cast<std::uint8_t>(~(DMRP_EDGE_W | DMRP_EDGE_NW | DMRP_EDGE_SW));
        if (column + 1 == columns) edges &= static_cast<std::uint8_t>(~(DMRP_EDGE_E | DMRP_EDGE_NE | DMRP_EDGE_SE));
        if (row == 0) edges &= static_cast<std::uint8_t>(~(DMRP_EDGE_S | DMRP_EDGE_SW | DMRP_EDGE_SE));
        if (row + 1 == rows) edges &= static_cast<std::uint8_t>(~(DMRP_EDGE_N | DMRP_EDGE_NW | DMRP_EDGE_NE));
      }
    planning_grid_->width = columns;
    planning_grid_->height = rows;
    planning_grid_->free = free_.data();
    planning_grid_->edges = edges_.data();
    return *this;
  }

  // A path a robot, one waypoint a second from t = 0.
  SyntheticTrial& plan(const std::vector<Points>& paths, std::int64_t planning_ns = 0, std::int64_t processor_ns = -1) {
    std::vector<std::vector<dmrp_waypoint>> timed;
    for (const Points& path : paths) {
      timed.emplace_back();
      for (const dmrp_vec2& point : path) {
        const auto second = static_cast<std::int64_t>(timed.back().size());
        timed.back().push_back({point.x, point.y, std::nan(""), second * 1'000'000'000, 0, 0});
      }
    }
    return timed_plan(timed, planning_ns, processor_ns);
  }

  SyntheticTrial& timed_plan(const std::vector<std::vector<dmrp_waypoint>>& paths, std::int64_t planning_ns = 0,
                             std::int64_t processor_ns = -1) {
    plans_.emplace_back();
    StoredPlan& stored = plans_.back();
    for (const std::vector<dmrp_waypoint>& path : paths) stored.waypoints.push_back(longer(path));
    for (const auto& path : stored.waypoints) {
      stored.paths.push_back({{sizeof(dmrp_path), static_cast<std::uint32_t>(path.size()),
                               sizeof(Longer<dmrp_waypoint>), 0, &path.front().element}});
    }
    stored.c.struct_size = sizeof(dmrp_plan);
    stored.c.path_count = static_cast<std::uint32_t>(paths.size());
    stored.c.paths = &stored.paths.front().element;
    stored.c.path_stride = sizeof(Longer<dmrp_path>);
    stored.c.revision = plans_.size();
    stored.c.step_duration_ns = 1'000'000'000;
    stored.c.planning_ns = planning_ns;
    stored.c.processor_ns = processor_ns;
    return *this;
  }

  // The latest plan is the current one. Controllers were called in every step unless without_control() follows.
  SyntheticTrial& sample(double t_s, const std::vector<dmrp_robot_sample>& robots) {
    const std::int64_t t_ns = nanoseconds(t_s);
    const std::int64_t dt_ns = samples_.empty() ? 0 : t_ns - samples_.back().c.t_ns;
    samples_.emplace_back();
    StoredSample& stored = samples_.back();
    stored.robots = longer(robots);
    stored.c.struct_size = sizeof(dmrp_sample);
    stored.c.control_tick = 1;
    stored.c.t_ns = t_ns;
    stored.c.dt_ns = dt_ns;
    stored.c.plan = plans_.empty() ? nullptr : &plans_.back().c;
    return *this;
  }

  // The following functions change the latest sample.
  SyntheticTrial& without_control() {
    samples_.back().c.control_tick = 0;
    return *this;
  }
  SyntheticTrial& contacts(const std::vector<dmrp_contact>& contacts) {
    samples_.back().contacts = longer(contacts);
    return *this;
  }
  SyntheticTrial& people(const std::vector<std::uint64_t>& ids) {
    for (const std::uint64_t id : ids) {
      samples_.back().people.push_back({});
      samples_.back().people.back().element.id = id;
    }
    return *this;
  }

  SyntheticTrial& crowd(const std::vector<dmrp_person>& people) {
    samples_.back().people = longer(people);
    return *this;
  }
  SyntheticTrial& calls(const std::vector<dmrp_call>& calls) {
    samples_.back().calls = longer(calls);
    return *this;
  }

  // What the controller of a robot was handed to follow at the last sample.
  SyntheticTrial& handed(std::uint32_t robot, const Points& points) {
    std::vector<dmrp_waypoint>& course = courses_.emplace_back();
    for (const dmrp_vec2 point : points) course.push_back(waypoint(point.x, point.y, 0.0));
    paths_.push_back(
        {sizeof(dmrp_path), static_cast<std::uint32_t>(course.size()), sizeof(dmrp_waypoint), 0, course.data()});
    samples_.back().routes.push_back({{robot, 0, &paths_.back()}});
    return *this;
  }

  // Of the control tick of the sample, which was at the one before.
  SyntheticTrial& events(const std::vector<dmrp_robot_event>& events) {
    samples_.back().events = longer(events);
    const std::int64_t tick_ns = samples_.back().c.t_ns - samples_.back().c.dt_ns;
    for (auto& each : samples_.back().events) each.element.t_ns = tick_ns;
    return *this;
  }

  SyntheticTrial& people_at(const std::vector<dmrp_vec2>& positions) {
    for (std::size_t i = 0; i < positions.size(); ++i) {
      samples_.back().people.push_back({});
      samples_.back().people.back().element.id = i;
      samples_.back().people.back().element.position = positions[i];
    }
    return *this;
  }

  // Times of arrival, `never` for a robot that did not arrive; without any, all robots arrive at the end.
  SyntheticTrial& end(double t_s, const std::vector<double>& arrivals_s = {}) {
    end_ns_ = nanoseconds(t_s);
    ends_.assign(robots_.size(), {});
    for (std::size_t robot = 0; robot < robots_.size(); ++robot) {
      const double arrival_s = arrivals_s.empty() ? t_s : arrivals_s[robot];
      const bool arrived = arrival_s >= 0.0;
      ends_[robot].element.state = arrived ? DMRP_ROBOT_FINISHED : DMRP_ROBOT_ACTIVE;
      ends_[robot].element.failure = arrived ? DMRP_FAILURE_NONE : DMRP_FAILURE_TIMEOUT;
      ends_[robot].element.arrival_ns = arrived ? nanoseconds(arrival_s) : -1;
      ends_[robot].element.culprit = DMRP_NOBODY;
    }
    return *this;
  }
  SyntheticTrial& failure(std::size_t robot, std::uint32_t reason, std::uint32_t culprit = DMRP_NOBODY) {
    ends_[robot].element.failure = reason;
    ends_[robot].element.culprit = culprit;
    return *this;
  }

  // Has pointers into this trial.
  dmrp_world world() const {
    dmrp_world world{};
    world.struct_size = sizeof(world);
    world.robots = robots_.data();
    world.robot_count = static_cast<std::uint32_t>(robots_.size());
    world.robot_stride = sizeof(dmrp_robot);
    world.shapes = shapes_.data();
    world.shape_count = static_cast<std::uint32_t>(shapes_.size());
    world.shape_stride = sizeof(dmrp_shape);
    world.lower = lower_;
    world.upper = upper_;
    world.step_ns = 20'000'000;
    world.control_period_ns = 100'000'000;
    world.planning_grid = planning_grid_.get();
    return world;
  }
  std::size_t robot_count() const { return robots_.size(); }
  const dmrp_plan* first_plan() const { return plans_.empty() ? nullptr : &plans_.front().c; }

  // Calls `use` with every sample in order of time.
  template <class Use>
  void for_each_sample(Use&& use) const {
    for (const StoredSample& stored : samples_) {
      dmrp_sample c = stored.c;
      c.robots = stored.robots.empty() ? nullptr : &stored.robots.front().element;
      c.robot_count = static_cast<std::uint32_t>(stored.robots.size());
      c.robot_stride = sizeof(Longer<dmrp_robot_sample>);
      c.contacts = stored.contacts.empty() ? nullptr : &stored.contacts.front().element;
      c.contact_count = static_cast<std::uint32_t>(stored.contacts.size());
      c.contact_stride = sizeof(Longer<dmrp_contact>);
      c.people = stored.people.empty() ? nullptr : &stored.people.front().element;
      c.person_count = static_cast<std::uint32_t>(stored.people.size());
      c.person_stride = sizeof(Longer<dmrp_person>);
      c.calls = stored.calls.empty() ? nullptr : &stored.calls.front().element;
      c.call_count = static_cast<std::uint32_t>(stored.calls.size());
      c.call_stride = sizeof(Longer<dmrp_call>);
      c.events = stored.events.empty() ? nullptr : &stored.events.front().element;
      c.event_count = static_cast<std::uint32_t>(stored.events.size());
      c.routes = stored.routes.empty() ? nullptr : &stored.routes.front().element;
      c.route_count = static_cast<std::uint32_t>(stored.routes.size());
      c.route_stride = sizeof(Longer<dmrp_route>);
      c.event_stride = sizeof(Longer<dmrp_robot_event>);
      use(c);
    }
  }

  dmrp_trial_end trial_end() const {
    dmrp_trial_end end{};
    end.struct_size = sizeof(end);
    end.ending = plans_.empty() ? DMRP_ENDING_NO_PLAN : DMRP_ENDING_TIME_LIMIT;
    end.t_ns = end_ns_;
    end.robots = ends_.empty() ? nullptr : &ends_.front().element;
    end.robot_count = static_cast<std::uint32_t>(ends_.size());
    end.robot_stride = sizeof(Longer<dmrp_robot_end>);
    return end;
  }

 private:
  struct StoredPlan {
    dmrp_plan c{};
    std::deque<std::vector<Longer<dmrp_waypoint>>> waypoints;
    std::vector<Longer<dmrp_path>> paths;
  };
  struct StoredSample {
    dmrp_sample c{};
    std::vector<Longer<dmrp_robot_sample>> robots;
    std::vector<Longer<dmrp_contact>> contacts;
    std::vector<Longer<dmrp_person>> people;
    std::vector<Longer<dmrp_call>> calls;
    std::vector<Longer<dmrp_robot_event>> events;
    std::vector<Longer<dmrp_route>> routes;
  };

  // addresses stay when the trial is moved
  std::unique_ptr<dmrp_footprint> footprint_ = std::make_unique<dmrp_footprint>();
  std::unique_ptr<dmrp_limits> limits_ =
      std::make_unique<dmrp_limits>(dmrp_limits{sizeof(dmrp_limits), 0, 0.0, 0.8, 0.0, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0});
  std::unique_ptr<Longer<dmrp_polygon>> part_ = std::make_unique<Longer<dmrp_polygon>>();
  std::unique_ptr<dmrp_grid> planning_grid_ =
      std::make_unique<dmrp_grid>(dmrp_grid{sizeof(dmrp_grid), 0, 0, 0, 1.0, {0, 0}, nullptr, nullptr, nullptr});
  std::deque<std::vector<Longer<dmrp_goal>>> goals_;
  std::deque<std::vector<dmrp_waypoint>> courses_;  // that controllers were handed
  std::deque<dmrp_path> paths_;
  std::deque<std::vector<dmrp_vec2>> outlines_;
  std::vector<std::uint8_t> free_, edges_;  // of the planning grid
  std::vector<dmrp_robot> robots_;
  std::vector<dmrp_shape> shapes_;
  dmrp_vec2 lower_ = {-1000.0, -1000.0};
  dmrp_vec2 upper_ = {1000.0, 1000.0};
  std::deque<StoredPlan> plans_;  // addresses stay
  std::vector<StoredSample> samples_;
  std::int64_t end_ns_ = 0;
  std::vector<Longer<dmrp_robot_end>> ends_;
};

struct MeasuredEvent {
  std::string name;
  double from_s, to_s;
  std::vector<std::uint32_t> robots;
  std::string text;
};

// The values of a metric. As by a host, values that are undeclared, infinite or repeated are refused.
struct Measurement {
  using Key = std::tuple<std::string, std::uint32_t, std::uint64_t>;  // name, kind of subject, subject
  std::map<Key, double> values;                                       // for a curve: its last point
  std::map<std::string, std::map<double, double>> curves;             // of the system: name, coordinate
  std::vector<MeasuredEvent> events;

  double system(const std::string& name) const { return values.at({name, DMRP_SUBJECT_SYSTEM, 0}); }
  double robot(const std::string& name, std::uint64_t robot) const {
    return values.at({name, DMRP_SUBJECT_ROBOT, robot});
  }
};

class CheckingSink {
 public:
  CheckingSink(const dmrp_metric_traits& traits, std::size_t robot_count, Measurement& into)
      : traits_(traits), robot_count_(robot_count), into_(into) {
    c_.struct_size = sizeof(c_);
    c_.context = this;
    c_.value = [](dmrp_metric_sink* sink, const dmrp_metric_result* result) -> std::int32_t {
      return of(sink).take_value(*result) ? DMRP_OK : DMRP_ERROR;
    };
    c_.event = [](dmrp_metric_sink* sink, const dmrp_event* event) -> std::int32_t {
      return of(sink).take_event(*event) ? DMRP_OK : DMRP_ERROR;
    };
  }
  dmrp_metric_sink* c() { return &c_; }

 private:
  static CheckingSink& of(dmrp_metric_sink* sink) { return *static_cast<CheckingSink*>(sink->context); }

  const dmrp_metric_value_spec* specification(const std::string& name) const {
    for (std::uint32_t i = 0; i < traits_.value_count; ++i) {
      const auto* spec = DMRP_AT(dmrp_metric_value_spec, traits_.values, traits_.value_stride, i);
      if (name == spec->name) return spec;
    }
    return nullptr;
  }

  bool take_value(const dmrp_metric_result& result) {
    const auto& [struct_size, kind, name, subject, coordinate, value] = result;
    const dmrp_metric_value_spec* spec = specification(name);
    if (!spec || (spec->subjects & 1u << kind) == 0 || std::isinf(value)) return false;
    if (kind == DMRP_SUBJECT_ROBOT && subject >= robot_count_) return false;
    if (value < spec->minimum || value > spec->maximum) return false;
    if (!std::isnan(coordinate)) {
      into_.values[{name, kind, kind == DMRP_SUBJECT_SYSTEM ? 0 : subject}] = value;
      return spec->curve && !std::isinf(coordinate) && into_.curves[name].emplace(coordinate, value).second;
    }
    return into_.values.emplace(Measurement::Key{name, kind, kind == DMRP_SUBJECT_SYSTEM ? 0 : subject}, value).second;
  }

  // The events of these metrics are about robots.
  bool take_event(const dmrp_event& event) {
    if (!specification(event.name) || event.to_ns < event.from_ns) return false;
    std::vector<std::uint32_t> robots;
    for (std::uint32_t i = 0; i < event.subject_count; ++i) {
      const auto* subject = DMRP_AT(dmrp_subject, event.subjects, event.subject_stride, i);
      if (subject->kind != DMRP_SUBJECT_ROBOT || subject->id >= robot_count_) return false;
      robots.push_back(static_cast<std::uint32_t>(subject->id));
    }
    into_.events.push_back({event.name, static_cast<double>(event.from_ns) / 1e9,
                            static_cast<double>(event.to_ns) / 1e9, robots, event.text});
    return true;
  }

  const dmrp_metric_traits& traits_;
  std::size_t robot_count_;
  Measurement& into_;
  dmrp_metric_sink c_{};
};

inline Measurement measure_once(PluginUnderTest& plugin, const SyntheticTrial& trial, const dmrp_world& world) {
  const auto ok = [&](std::int32_t status) {
    if (status != DMRP_OK) throw std::runtime_error(plugin.host().errors.empty() ? "?" : plugin.host().errors.back());
  };
  Measurement measurement;
  const dmrp_metric& metric = plugin.as<dmrp_metric>();
  const dmrp_metric_trial beginning = {sizeof(dmrp_metric_trial), 0, trial.first_plan()};
  const dmrp_trial_end end = trial.trial_end();
  CheckingSink sink(traits_of<dmrp_metric_traits>(plugin.descriptor()), trial.robot_count(), measurement);

  ok(plugin.start(world));
  ok(metric.begin(plugin.self(), &beginning));
  trial.for_each_sample([&](const dmrp_sample& sample) { ok(metric.observe(plugin.self(), &sample)); });
  ok(metric.finish(plugin.self(), &end, sink.c()));
  return measurement;
}

inline bool same_bits(const Measurement& a, const Measurement& b) {
  if (a.values.size() != b.values.size() || a.events.size() != b.events.size()) return false;
  if (a.curves.size() != b.curves.size()) return false;
  for (auto i = a.curves.begin(), j = b.curves.begin(); i != a.curves.end(); ++i, ++j) {
    if (i->first != j->first || i->second.size() != j->second.size()) return false;
    for (auto p = i->second.begin(), q = j->second.begin(); p != i->second.end(); ++p, ++q)
      if (p->first != q->first || std::memcmp(&p->second, &q->second, sizeof(double)) != 0) return false;
  }
  for (auto i = a.values.begin(), j = b.values.begin(); i != a.values.end(); ++i, ++j)
    if (i->first != j->first || std::memcmp(&i->second, &j->second, sizeof(double)) != 0) return false;
  return true;
}

// Requires a system value for every declared name, and the same bits from a second trial of the same instance.
inline Measurement measure(const std::string& id, const SyntheticTrial& trial, ParamOverrides overrides = {}) {
  PluginUnderTest plugin("libdmrp_metrics.so", id, std::move(overrides));
  const dmrp_world world = trial.world();
  const Measurement measurement = measure_once(plugin, trial, world);
  if (!same_bits(measurement, measure_once(plugin, trial, world)))
    throw std::runtime_error(id + " remembers the last trial");
  const auto& traits = traits_of<dmrp_metric_traits>(plugin.descriptor());
  for (std::uint32_t i = 0; i < traits.value_count; ++i) {
    const auto* spec = DMRP_AT(dmrp_metric_value_spec, traits.values, traits.value_stride, i);
    if (measurement.values.count({spec->name, DMRP_SUBJECT_SYSTEM, 0}) == 0)
      throw std::runtime_error(std::string("no value for the system: ") + spec->name);
  }
  return measurement;
}

}  // namespace dmrp::test
