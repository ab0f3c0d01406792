// SPDX-License-Identifier: MIT
#include "tests/conformance/sample_library.hpp"

#include <dmrp/plugin.hpp>
#include <new>
#include <stdexcept>

template <>
struct dmrp::ExtensionId<sample_extension> {
  static constexpr const char* value = SAMPLE_EXTENSION;
};

namespace dmrp::test {

Seen& seen() {
  static Seen it;
  return it;
}

namespace {

// Returns from a call as `does` says.
dmrp::Status leave(const std::string& does) {
  if (does == "throw") throw std::runtime_error("thrown on purpose");
  if (does == "throw unsupported") throw dmrp::Unsupported("not for it");
  if (does == "throw bad_alloc") throw std::bad_alloc();
  if (does == "throw number") throw 42;
  if (does == "warning") return dmrp::Status::warning;
  if (does == "no solution") return dmrp::Status::no_solution;
  if (does == "unsupported") return dmrp::Status::unsupported;
  return dmrp::Status::ok;
}

class SampleController final : public dmrp::LocalController {
 public:
  SampleController() { ++seen().alive; }
  ~SampleController() override { --seen().alive; }

  static dmrp::Descriptor describe() {
    return dmrp::Descriptor("sample.controller", "Sample controller", "1.2.3")
        .vendor("Somebody")
        .license("MIT")
        .summary("what it does")
        .source("a paper, section 4")
        .kinematics(1u << DMRP_KINEMATICS_HOLONOMIC)
        .flags(DMRP_FLAG_BACKWARDS)
        .flags(DMRP_FLAG_PROCESSES)
        .needs(DMRP_EXT_LIDAR)
        .uses("dmrp.local_costmap/1")
        .uses(DMRP_EXT_ANNOTATE);
  }

  static void load(const dmrp::Host& host) {
    seen().loaded.push_back("sample.controller from " + host.library_path());
    leave(seen().load_does);
  }
  static void unload() {
    seen().unloaded.push_back("sample.controller");
    leave(seen().unload_does);
  }

  dmrp::Param<std::string> does = param("does", "nothing");
  dmrp::Param<bool> flag = param("flag", true).doc("a flag");
  dmrp::Param<std::int64_t> integer = param("integer", 7).range(1, 9).unit("1");
  dmrp::Param<std::int64_t> large = param("large", std::int64_t{1} << 60);
  dmrp::Param<int> small = param("small", -3).range(-5.0, 5.0);
  dmrp::Param<double> number = param("number", 0.25).unit("m").range(0.0, 0.5).doc("a number");
  dmrp::Param<double> whole = param("whole", 1);
  dmrp::Param<std::string> text = param("text", "as it is");
  dmrp::Param<std::string> choice = param("choice", "red").choices({"red", "green", "blue"});
  dmrp::Param<std::string> file = param("file", "data.csv").path();
  dmrp::Param<std::vector<double>> numbers = param("numbers", std::vector<double>{1.5, -2.0});
  dmrp::Param<std::vector<std::string>> texts = param("texts", std::vector<std::string>{"a", "b", "c"});

  dmrp::Status start(const dmrp::Start& start) override {
    // the values of create()
    seen().numbers = {
        flag ? 1.0 : 0.0, static_cast<double>(integer), static_cast<double>(large), 1.0 * small, number, whole};
    seen().numbers.insert(seen().numbers.end(), numbers->begin(), numbers->end());
    seen().texts = {text, choice, file};
    seen().texts.insert(seen().texts.end(), texts->begin(), texts->end());
    // the values of start()
    seen().numbers.push_back(static_cast<double>(start.seed));
    seen().numbers.push_back(start.robot);
    seen().numbers.push_back(static_cast<double>(start.world.robots().size()));
    seen().numbers.push_back(world()->time_limit_ns == start.world->time_limit_ns ? 1.0 : 0.0);
    if (does == "compare texts") compare_texts();
    if (does == "ask") ask();
    if (does == "ask in vain") extension<dmrp_lidar>();
    return leave(does);
  }

  void set_path(dmrp::Path path, std::uint64_t revision) override {
    seen().numbers = {static_cast<double>(revision)};
    for (const dmrp::Waypoint& waypoint : path) seen().numbers.push_back(waypoint.x);
    seen().texts = {path.is_partial() ? "partial" : "whole", path.continues() ? "continues" : "is another"};
    leave(does);
  }

  dmrp::Status step(const dmrp::Observation& now, dmrp::Command& command) override {
    seen().numbers = {now.pose.x,      now.limits.v_max,  now.footprint.radius_m, dmrp::seconds(now.t_ns),
                      now.goal.pose.x, now.steering_angle};
    for (const dmrp::Agent& agent : now.agents) seen().numbers.push_back(static_cast<double>(agent.id));
    for (const dmrp::Polygon& part : dmrp::parts(now.footprint)) seen().numbers.push_back(part.vertices[0].x);
    command.v_x = 0.5;
    command.omega = -0.25;
    if (should_stop()) log(dmrp::LogLevel::warning, "asked to stop");
    return leave(does);
  }

  void trial_end(const dmrp::TrialEnd& end) override {
    seen().numbers = {1.0 * end.ending, dmrp::seconds(end.t_ns), 1.0 * static_cast<double>(end.robots.size())};
    leave(does);
  }

  const void* offered_extension(const char* id) override {
    static const int offered = 5;
    return std::string(id) == "sample/1" ? &offered : nullptr;
  }

 private:
  void ask() const {
    const auto* missing = find_extension<dmrp_annotate>();
    log(dmrp::LogLevel::debug, missing ? "annotations" : "no annotations");
    log(dmrp::LogLevel::info, "the lidar has " + std::to_string(extension<dmrp_lidar>().struct_size));
    log(dmrp::LogLevel::info, "the number is " + std::to_string(find_extension<sample_extension>()->number));
  }

  // Each comparison that a plugin may write, with its result.
  void compare_texts() const {
    const std::string red = "red";
    seen().numbers = {choice == "red" ? 1.0 : 0.0, choice == red ? 1.0 : 0.0,    "red" == choice ? 1.0 : 0.0,
                      red == choice ? 1.0 : 0.0,   choice == choice ? 1.0 : 0.0, choice == text ? 1.0 : 0.0,
                      choice != "red" ? 1.0 : 0.0, choice != red ? 1.0 : 0.0,    "red" != choice ? 1.0 : 0.0,
                      red != choice ? 1.0 : 0.0,   choice != text ? 1.0 : 0.0};
  }
};

// Drives every second robot and brakes the others.
class SampleCentral final : public dmrp::CentralController {
 public:
  static dmrp::Descriptor describe() { return dmrp::Descriptor("sample.central", "Sample central", "1.0.0"); }
  static void load(const dmrp::Host&) { seen().loaded.push_back("sample.central"); }
  static void unload() { seen().unloaded.push_back("sample.central"); }
  dmrp::Param<std::string> does = param("does", "nothing");

  void set_path(std::uint32_t robot, dmrp::Path path, std::uint64_t revision) override {
    seen().numbers = {1.0 * robot, static_cast<double>(revision), path.back().x};
    seen().texts = {path.is_partial() ? "partial" : "whole", path.continues() ? "continues" : "is another"};
    leave(does);
  }
  dmrp::Status step(dmrp::Fleet& fleet) override {
    seen().numbers = {};
    for (std::size_t i = 0; i < fleet.size(); ++i) {
      const dmrp::Observation now = fleet[i];
      seen().numbers.push_back(1.0 * now.robot);
      if (i % 2 == 0)
        fleet.command(i, {now.pose.x, 0.25, -1.0});
      else
        fleet.brake(i);
    }
    return leave(does);
  }
};

// Its constructor throws if `seen().texts` says so: it has no parameters yet.
class SampleThatCannotBeMade final : public dmrp::LocalController {
 public:
  SampleThatCannotBeMade() {
    if (!seen().texts.empty()) leave(seen().texts.front());
  }
  static dmrp::Descriptor describe() { return dmrp::Descriptor("sample.unmakeable", "Unmakeable", "1.0.0"); }
  void set_path(dmrp::Path, std::uint64_t) override {}
  dmrp::Status step(const dmrp::Observation&, dmrp::Command&) override { return dmrp::Status::ok; }
};

class SamplePlanner final : public dmrp::GlobalPlanner {
 public:
  static dmrp::Descriptor describe() {
    return dmrp::Descriptor("sample.planner", "Sample planner", "1.0.0")
        .connectivity(DMRP_CONNECTIVITY_8)
        .uncoordinated();
  }
  dmrp::Param<std::string> does = param("does", "nothing");

  dmrp::Status plan(const dmrp::PlanningProblem& problem, dmrp::PlanSink& sink) override {
    seen().numbers = {static_cast<double>(problem.grid.width), static_cast<double>(problem.in_force.size())};
    for (const dmrp::Path& path : problem.in_force) seen().numbers.push_back(path.back().x);
    for (std::size_t i = 0; i < problem.in_force.size(); ++i)
      seen().numbers.push_back(problem.in_force[i].is_partial() ? 1.0 : 0.0);
    for (std::uint32_t i = 0; i < problem.robots.size(); ++i) {
      std::vector<dmrp::Waypoint> path = {{problem.robots[i].start.x, problem.robots[i].start.y, 0.0, 0, 0, 0}};
      for (const dmrp::Goal& goal : problem.robots[i].goals()) path.push_back({goal.pose.x, goal.pose.y, 0.0, 1, 0, 0});
      sink.path(i, path, does == "give partial paths");
    }
    sink.statistic("cost", 3.0);
    return leave(does);
  }
};

class SampleWindowed final : public dmrp::GlobalPlanner {
 public:
  static dmrp::Descriptor describe() {
    return dmrp::Descriptor("sample.windowed", "Sample windowed", "1.0.0")
        .connectivity(DMRP_CONNECTIVITY_4)
        .flags(DMRP_FLAG_WINDOWED);
  }
  dmrp::Param<std::string> does = param("does", "nothing");

  dmrp::Status plan(const dmrp::PlanningProblem& problem, dmrp::PlanSink&) override {
    seen().numbers = {1.0 * problem.window_steps, dmrp::seconds(host().budget_left_ns())};
    return leave(does);
  }
};

class SamplePedestrians final : public dmrp::PedestrianModel {
 public:
  static dmrp::Descriptor describe() { return dmrp::Descriptor("sample.pedestrian", "Sample pedestrians", "1.0.0"); }
  dmrp::Param<std::string> does = param("does", "nothing");

  dmrp::Status step(const dmrp::Crowd& crowd, dmrp::Motions& motions) override {
    for (std::size_t i = 0; i < motions.size(); ++i)
      motions[i].velocity = {static_cast<double>(crowd.people[i].id), static_cast<double>(crowd.robots.size())};
    return leave(does);
  }
};

class SampleMetric final : public dmrp::Metric {
 public:
  static dmrp::Descriptor describe() {
    return dmrp::Descriptor("sample.metric", "Sample metric", "1.0.0")
        .channels(DMRP_CHANNEL_PEOPLE | DMRP_CHANNEL_CALLS)
        .value("plain", "m", dmrp::Direction::lower_is_better, dmrp::Subjects::system, "one number")
        .value("timed", "s", dmrp::Direction::none, dmrp::Subjects::system_and_robots, "a time")
        .wall_clock()
        .value("curved", "1", dmrp::Direction::higher_is_better, dmrp::Subjects::system_and_pedestrians, "a curve")
        .curve();
  }
  dmrp::Param<std::string> does = param("does", "nothing");

  void begin(const dmrp::MetricTrial& trial) override {
    seen().numbers = {trial.plan ? static_cast<double>(trial.plan.path(1).size()) : -1.0};
    leave(does);
  }
  void observe(const dmrp::Sample& sample) override {
    seen().numbers = {sample.control_tick ? 1.0 : 0.0};
    for (const dmrp::RobotSample& robot : sample.robots) seen().numbers.push_back(robot.pose.x);
    for (const dmrp::Person& person : sample.people) seen().numbers.push_back(person.position.x);
    for (const dmrp::Contact& contact : sample.contacts) seen().numbers.push_back(contact.depth_m);
    for (const dmrp::Call& call : sample.calls) seen().numbers.push_back(static_cast<double>(call.duration_ns));
    for (const dmrp::RobotEvent& event : sample.events) seen().numbers.push_back(1.0 * event.detail);
    for (const dmrp::Route& route : sample.routes) {
      for (const dmrp::Waypoint& waypoint : route.path()) seen().numbers.push_back(waypoint.x);
      seen().numbers.push_back(route.path().continues() ? 1.0 : 0.0);
    }
    seen().numbers.push_back(static_cast<double>(sample.plan.size()));
    leave(does);
  }
  void finish(const dmrp::TrialEnd& end, dmrp::MetricSink& sink) override {
    sink.system("plain", dmrp::seconds(end.t_ns));
    sink.robot("timed", end.robots.size() - 1, dmrp::undefined);
    sink.pedestrian("curved", 12, 1.0);
    sink.curve("curved", 0.5, 2.0);
    sink.event({"plain", 1, 2, {dmrp::robot_subject(3), dmrp::person_subject(40)}, "an event"});
    sink.event({"other", 3, 3, {}, "", {1.0, 2.0}, dmrp::Severity::serious});
    leave(does);
  }
};

}  // namespace

RecordingHost::RecordingHost() {
  c.struct_size = sizeof(c);
  c.context = this;
  c.name = "recording-host";
  c.version = "0.0.0";
  c.log = [](const dmrp_host* host, std::int32_t level, const char* text) {
    static_cast<RecordingHost*>(host->context)->log.push_back(std::to_string(level) + " " + text);
  };
  c.set_error = [](const dmrp_host* host, const char* text) {
    static_cast<RecordingHost*>(host->context)->error = text;
  };
  c.should_stop = [](const dmrp_host* host) { return static_cast<RecordingHost*>(host->context)->stop; };
  c.budget_left_ns = [](const dmrp_host* host) { return static_cast<RecordingHost*>(host->context)->budget_left_ns; };
  c.library_path = "/plugins/libsample.so";
  c.get_extension = [](const dmrp_host* host, const char* id) -> const void* {
    const auto& offered = static_cast<RecordingHost*>(host->context)->offers;
    const auto found = offered.find(id);
    return found == offered.end() ? nullptr : found->second;
  };
}

ParamList::ParamList(std::vector<dmrp_param_value> values) {
  for (const dmrp_param_value& value : values) values_.push_back({value, 0xAAAAAAAAAAAAAAAAu});
  c_.struct_size = sizeof(c_);
  c_.count = static_cast<std::uint32_t>(values_.size());
  c_.stride = sizeof(Longer);
  c_.values = &values_.front().known;
}

dmrp_param_value text_value(const char* key, const char* text) {
  dmrp_param_value value{};
  value.key = key;
  value.type = DMRP_PARAM_STRING;
  value.text = text;
  return value;
}

Sample::Sample(const char* id, const char* does) {
  const ParamList params({text_value("does", does)});
  c.struct_size = sizeof(c);
  if (dmrp_entry_v1.create(&dmrp_entry_v1, &host.c, id, params.c(), &c) != DMRP_OK)
    throw std::runtime_error(host.error);
}

std::int32_t Sample::start(std::uint64_t seed, std::int32_t robot) const {
  dmrp_world world{};
  world.struct_size = sizeof(world);
  world.time_limit_ns = 5;
  world.robot_count = 3;
  const dmrp_start begin = {sizeof(begin), robot, seed, &world};
  return c.start(c.self, &begin);
}

}  // namespace dmrp::test

using namespace dmrp::test;

DMRP_PLUGINS(SampleController, SampleCentral, SamplePlanner, SamplePedestrians, SampleMetric, SampleThatCannotBeMade,
             SampleWindowed)
