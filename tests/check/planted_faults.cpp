// SPDX-License-Identifier: MIT
// libdmrp_planted_faults.so: a plugin of each kind that keeps its contract, but for the one fault that the environment
// variable DMRP_TEST_FAULT names.
#include <fenv.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <dmrp/plugin.hpp>
#include <map>
#include <thread>

extern "C" const dmrp_entry dmrp_entry_v1;

namespace {

using dmrp::Status;

bool has(const char* fault) {
  static const std::string planted = std::getenv("DMRP_TEST_FAULT") ? std::getenv("DMRP_TEST_FAULT") : "";
  return planted == fault;
}

[[noreturn]] void crash() {
  std::abort();
}

__attribute__((constructor)) void at_load() {
  if (has("rounds upward")) fesetround(FE_UPWARD);
  if (has("sets the environment")) setenv("DMRP_TEST_SET", "1", 1);
  if (has("starts a thread")) std::thread([] { std::this_thread::sleep_for(std::chrono::seconds(60)); }).detach();
  if (has("prints")) std::puts("hello");
  if (has("loads slowly")) std::this_thread::sleep_for(std::chrono::milliseconds(2'200));
  if (has("crashes at load")) crash();
  if (has("exits at load")) std::exit(0);
  if (has("forks at load")) fork();
  if (has("hangs at load")) std::this_thread::sleep_for(std::chrono::hours(1));
}

int inits = 0;
int created = 0;
std::atomic<int> instances = 0;
std::atomic<int> running = 0;
std::uint64_t calls_of_all = 0;
std::uint64_t starts_of_all = 0;
thread_local std::uint64_t calls_of_thread = 0;

// How often a loop turns that time ends, at most three times.
int turns_in_time() {
  const auto begin = std::chrono::steady_clock::now();
  int turns = 0;
  while (turns < 3 && std::chrono::steady_clock::now() - begin < std::chrono::milliseconds(120)) ++turns;
  return turns;
}

// Processor time.
void compute_for(std::clock_t time) {
  const std::clock_t begin = std::clock();
  while (std::clock() - begin < time) {
  }
}

// What all four do alike.
template <class Kind>
class Planted : public Kind {
 public:
  // Its value is in the outputs.
  dmrp::Param<double> level = this->param("level", 1.0).range(0.0, 10.0).doc(has("no doc") ? "" : "how much");

  dmrp::Param<std::string> mode = this->param("mode", "plain").choices({"plain", "odd"}).doc("nothing");

  Planted() {
    if (has("is one at a time")) ++instances;
    if (has("leaks")) leaked_ = new char[4096];
    if (has("crashes at the 50th") && ++created > 50) crash();
  }
  ~Planted() override {
    if (has("is one at a time")) --instances;
    if (has("uses the world in destroy") && started_) crash();
  }

  static void load(const dmrp::Host&) {
    if (has("init fails")) throw std::runtime_error("no weights");
    if (has("second init fails") && ++inits > 4) throw std::runtime_error("already loaded");
  }

  Status start(const dmrp::Start& start) override {
    started_ = true;
    if (has("refuses the minimum") && *level == 0.0) return this->set_error("level is zero"), Status::error;
    if (has("refuses the maximum") && *level == 10.0) return this->set_error("level is ten"), Status::error;
    if (has("refuses the default") && *level == 1.0) return this->set_error("level is one"), Status::error;
    if (has("refuses a choice") && *mode == "odd") return this->set_error("mode is odd"), Status::error;
    if (has("wants a shape") && start.world.shapes().size() == 0) return this->set_error("no shape"), Status::error;
    if (has("refuses other values") && *level != 0.0 && *level != 1.0 && *level != 10.0) return Status::error;
    if (has("wants no agent") && start.world.robots().size() == 0) return Status::error;
    if (has("compares struct_size") && start.world->struct_size != sizeof(dmrp_world))
      return this->set_error("another world"), Status::error;
    if (has("changes its descriptor"))
      for (std::uint32_t i = 0; i < dmrp_entry_v1.plugin_count(&dmrp_entry_v1); ++i)
        const_cast<dmrp_descriptor*>(dmrp_entry_v1.descriptor(&dmrp_entry_v1, i))->name = "Other";
    if (has("tires")) ++starts_of_all;
    if (has("keeps the first world") && !first_world_) first_world_ = start.world.operator->();
    if (has("writes to the world")) const_cast<dmrp::Limits&>(*start.world.robots()[0].limits).v_max = 3.0;
    if (!has("keeps the last trial")) calls_ = 0;
    far_ = start.world->lower.x > 1e5;
    headed_ = start.world.robots().size() > 0 && !std::isnan(start.world.robots()[0].goals()[0].pose.theta);
    if (has("asks for the undeclared")) this->template find_extension<dmrp_lidar>();
    if (has("needs the optional") && !this->template find_extension<dmrp_annotate>()) crash();
    if (has("compares the host") && this->host().c()->struct_size != sizeof(dmrp_host)) return Status::error;
    if (has("says that it draws in a thread")) {
      const auto* const timing = this->template find_extension<dmrp_timing>();
      timing->not_repeatable(timing, "draws in a thread");
    }
    return Status::ok;
  }

  const void* offered_extension(const char*) override { return has("offers anything") ? this : nullptr; }

 protected:
  // A number for the outputs, which depends on what it may not where that is the fault.
  double number() {
    ++calls_;
    if (has("shares a variable") || has("says that it draws in a thread") || has("slips rarely")) ++calls_of_all;
    ++calls_of_thread;
    if (has("exits in a call")) std::exit(0);
    if (has("prints garbage"))
      for (int i = 0; i < 1'000'000; ++i) std::fputs("{\"result\": 9}\xff\n", stdout);
    if (has("changes the folder") && chdir("/") != 0) crash();
    if (has("logs")) this->log(dmrp::LogLevel::info, "hello");
    if (has("asks for ever"))
      for (int i = 0; i < 50'000; ++i) this->should_stop();
    if (has("is one at a time")) {
      if (++running > 1) crash();
      wait_for_the_other_instance();
      --running;
    }
    if (has("keeps more and more")) kept_.emplace_back(10'000, 'x');
    if (has("sleeps")) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    if (has("never asks") && calls_ == 1) compute_for(CLOCKS_PER_SEC / 2);
    if (has("works long at the maximum") && *level == 10.0) crash();
    if (has("computes in silence")) compute_for(CLOCKS_PER_SEC / 15);
    if (has("tires") && starts_of_all > 40) return 1e-3;
    if (has("slips rarely") && calls_of_all % 397 == 0) return 1e-3;
    if (has("works by day")) return 1e-3 * static_cast<double>(std::time(nullptr) / 3600 % 24);
    if (has("reads its home")) return 1e-3 * static_cast<double>(std::strlen(std::getenv("HOME")));
    if (has("keeps the first world")) return 1e-3 * first_world_->robot_count;
    if (has("stops by the clock")) return 1e-3 * turns_in_time();
    if (has("keeps the last trial")) return 1e-3 * static_cast<double>(calls_);
    if (has("shares a variable") || has("says that it draws in a thread"))
      return 1e-6 * static_cast<double>(calls_of_all);
    if (has("is bound to its thread")) return 1e-3 * static_cast<double>(calls_of_thread);
    if (has("reads its address"))
      return 1e-12 * static_cast<double>(reinterpret_cast<std::uintptr_t>(this) >> 4 & 0xffff);
    if (has("reads what it never set")) return unset_[0] > 0.0 ? 1e-3 : 0.0;
    if (has("fears distance") && far_) return std::nan("");
    if (has("fears headings") && headed_) return std::nan("");
    return 0.0;
  }

 private:
  // Until another instance is in a call too: however late its thread gets a processor, both calls overlap.
  static void wait_for_the_other_instance() {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (instances > 1 && running < 2 && std::chrono::steady_clock::now() < deadline) std::this_thread::yield();
  }

  std::unique_ptr<double[]> unset_{new double[1]};
  char* leaked_ = nullptr;
  const dmrp_world* first_world_ = nullptr;
  std::vector<std::string> kept_;
  bool started_ = false;
  bool far_ = false;
  bool headed_ = false;
  std::uint64_t calls_ = 0;
};

dmrp::Descriptor descriptor_of(const char* kind) {
  if (has("crashes in its descriptor")) crash();
  dmrp::Descriptor descriptor(has("short id") ? kind : std::string("test.check.") + kind, "Planted",
                              has("odd version") ? "one" : "1.0.0");
  descriptor.license(has("odd licence") ? "GPL" : "MIT")
      .summary(has("no summary") ? "" : "Keeps its contract, but for one fault");
  if (has("needs the optional")) descriptor.uses(DMRP_EXT_ANNOTATE);
  if (has("says that it draws in a thread")) descriptor.uses(DMRP_EXT_TIMING);
  if (has("misspelt extension")) descriptor.uses("dmrp.anotate/1");
  if (has("unknown flag")) descriptor.flags(1u << 14);
  return descriptor;
}

class Planner final : public Planted<dmrp::GlobalPlanner> {
 public:
  static dmrp::Descriptor describe() {
    return descriptor_of("planner").connectivity(DMRP_CONNECTIVITY_ANY).flags(DMRP_FLAG_WINDOWED).uncoordinated();
  }

  Status plan(const dmrp::PlanningProblem& problem, dmrp::PlanSink& sink) override {
    const double shift = number();
    if (has("odd status")) return static_cast<Status>(99);
    for (std::uint32_t i = 0; i < problem.robots.size(); ++i) {
      const dmrp::PlanningRobot& robot = problem.robots[i];
      const dmrp::Pose goal = robot.goals()[0].pose;
      const double middle = 0.5 * (robot.start.x + goal.x);
      // a walled hall: the wall is in the middle
      const dmrp::Grid& grid = problem.grid;
      const auto column = static_cast<std::uint32_t>((middle - grid.origin.x) / grid.resolution_m);
      const auto row = static_cast<std::uint32_t>((robot.start.y - grid.origin.y) / grid.resolution_m);
      if (!grid.free[row * grid.width + column]) return has("calls it an error") ? Status::error : Status::no_solution;
      std::vector<dmrp::Waypoint> path = {
          {robot.start.x, robot.start.y, std::nan(""), problem.effective_from_ns, robot.first_goal_index, 0}};
      for (std::uint32_t g = 0; g < robot.goal_count; ++g) {
        if (robot.state != DMRP_ROBOT_ACTIVE && !has("moves the dead")) break;
        const dmrp::Pose at = robot.goals()[g].pose;
        const double length_m = std::hypot(at.x - path.back().x, at.y - path.back().y);
        if (length_m == 0.0 && !has("divides by the length")) continue;
        const double duration_s = has("divides by the length") ? 20.0 / length_m * length_m : 20.0 + shift;
        path.push_back({at.x, at.y, std::nan(""),
                        path.back().t_ns + static_cast<std::int64_t>(std::isnan(duration_s) ? -1.0 : duration_s * 1e9),
                        has("counts goals from 0") ? g : robot.first_goal_index + g, 0});
      }
      const bool is_partial = problem.window_steps > 0 && cut(path, problem);
      sink.path(i, path, is_partial && !has("calls every path whole"));
    }
    if (has("gives a path twice")) sink.path(0, std::vector<dmrp::Waypoint>());
    if (has("gives a path to nobody")) sink.path(99, std::vector<dmrp::Waypoint>());
    return Status::ok;
  }

 private:
  // Ends the path where the window ends. False if it ends before.
  static bool cut(std::vector<dmrp::Waypoint>& path, const dmrp::PlanningProblem& problem) {
    const std::int64_t end_ns = problem.effective_from_ns + problem.window_steps * problem.step_duration_ns;
    bool is_cut = false;
    while (path.size() > 1 && path.back().t_ns > end_ns) {
      dmrp::Waypoint last = path.back();
      path.pop_back();
      const dmrp::Waypoint& from = path.back();
      if (from.t_ns < end_ns) {
        const double part = static_cast<double>(end_ns - from.t_ns) / static_cast<double>(last.t_ns - from.t_ns);
        last.x = from.x + part * (last.x - from.x);
        last.y = from.y + part * (last.y - from.y);
        last.t_ns = end_ns;
        path.push_back(last);
      }
      is_cut = true;
    }
    return is_cut;
  }
};

class Controller final : public Planted<dmrp::LocalController> {
 public:
  static dmrp::Descriptor describe() {
    return descriptor_of("controller").kinematics(1u << DMRP_KINEMATICS_DIFFERENTIAL | 1u << DMRP_KINEMATICS_HOLONOMIC);
  }

  Status start(const dmrp::Start& start) override {
    length_m_ = 0.0;
    const auto drive = start.world.robots().size() > 0 ? start.world.robots()[0].kinematics : 0;
    if (has("cannot drive sideways") && drive == DMRP_KINEMATICS_HOLONOMIC) return Status::error;
    return Planted::start(start);
  }

  void set_path(dmrp::Path path, std::uint64_t) override {
    if (has("wants two waypoints") && path.size() < 2) throw std::runtime_error("a path has two waypoints");
    if (has("keeps its first path") && length_m_ > 0.0) return;
    length_m_ = std::hypot(path.back().x - path[0].x, path.back().y - path[0].y);
  }
  Status step(const dmrp::Observation& now, dmrp::Command& command) override {
    command.v_x = 0.4 * *level * std::clamp(length_m_ - now.progress_m, 0.0, 1.0) + number();
    if (has("drives to the east") && std::abs(now.pose.theta) > 1.0) command.v_x = 0.0;
    if (has("takes a root of speeds")) command.omega = 0.0 * std::sqrt(now.limits.v_max + 0.1 - now.velocity.v_x);
    if (has("divides by the distance of two") && now.agents.size() > 1)
      command.omega = 1e-9 / (now.agents[1].pose.x - now.agents[0].pose.x) * 0.0;
    if (has("looks its goal up")) command.omega = 0.0 * start_goals(now)[now.goal_index].tolerance_m;
    if (has("divides by the agents") && now.agents.size() == 0) command.v_x = std::nan("");
    if (has("has room for 100") && now.agents.size() > 100) crash();
    for (int i = 0; i < 10; ++i)
      if (should_stop() && has("times out")) return Status::timeout;
    if (has("divides by the gap") && now.agents.size() > 0) {
      const double apart_m = std::hypot(now.agents[0].pose.x - now.pose.x, now.agents[0].pose.y - now.pose.y);
      command.omega = std::log(apart_m - now.agents[0].radius_m - now.footprint.radius_m - 0.1);
    }
    if (has("commands degrees")) command.omega = 90.0;
    if (has("reads beyond the agents")) command.omega = 0.0 * now.agents[now.agents.size()].radius_m;
    if (has("keeps an agent")) command.omega = kept_ ? 0.0 * kept_->radius_m : 0.0;
    kept_ = &now.agents[0];
    if (has("writes to its input")) const_cast<dmrp::Limits&>(now.limits).v_max = 9.0;
    return has("odd status") ? static_cast<Status>(99) : Status::ok;
  }

 private:
  const dmrp_goal* start_goals(const dmrp::Observation& now) const {
    const dmrp_robot& robot = world().robots()[now.robot];
    return robot.goals;
  }

  const dmrp_agent* kept_ = nullptr;
  double length_m_ = 0.0;
};

class People final : public Planted<dmrp::PedestrianModel> {
 public:
  static dmrp::Descriptor describe() { return descriptor_of("people"); }

  Status step(const dmrp::Crowd& crowd, dmrp::Motions& motions) override {
    if (has("has room for 100") && crowd.people.size() > 100) crash();
    if (has("writes too far")) motions[crowd.people.size()].velocity = {1.0, 0.0};
    const double speed = std::min(0.1 * *level, 1.0) + number();
    for (std::size_t i = 0; i < crowd.people.size(); ++i)
      motions[i].velocity = {speed + of(crowd, crowd.people[i]), 0.0};
    return Status::ok;
  }

 private:
  // What a fault adds to a person's speed.
  double of(const dmrp::Crowd& crowd, const dmrp::Person& person) {
    std::size_t mates = 0, near = 0;
    for (const dmrp::Person& other : crowd.people) {
      mates += other.group == person.group;
      near += std::hypot(other.position.x - person.position.x, other.position.y - person.position.y) < 0.6;
    }
    if (has("takes group 0 for a group")) return 1e-3 * static_cast<double>(mates);
    if (has("counts reactions")) return person.reaction > DMRP_REACTION_THREATENING ? 1e-3 : 0.0;
    if (has("flees from a crowd")) return near > 10 ? 9.0 : 0.0;
    if (has("remembers whom it met"))
      for (const dmrp::Agent& robot : crowd.robots)
        if (std::hypot(robot.pose.x - person.position.x, robot.pose.y - person.position.y) < 2.0)
          return 1e-12 * static_cast<double>(crowd.t_ns - met_.try_emplace(person.id, crowd.t_ns).first->second);
    return 0.0;
  }

  std::map<std::uint64_t, std::int64_t> met_;
};

class Metric final : public Planted<dmrp::Metric> {
 public:
  static dmrp::Descriptor describe() {
    return descriptor_of("metric").value("test_check", has("no unit") ? "" : "1", dmrp::Direction::none,
                                         dmrp::Subjects::system, "a number");
  }

  void begin(const dmrp::MetricTrial& trial) override {
    calls_ = 0;
    classes_.assign(DMRP_CLASS_STUCK + 1, 0);
    has_plan_ = static_cast<bool>(trial.plan);
  }
  void observe(const dmrp::Sample& sample) override {
    if (has("has room for 100") && sample.people.size() > 100) crash();
    if (has("reads calls")) calls_ += sample.calls.size();
    if (has("counts by class"))
      for (const dmrp::RobotEvent& event : sample.events)
        if (event.kind == DMRP_ROBOT_EVENT_CLASS) ++classes_[event.detail];
    if (has("takes every contact"))
      for (const dmrp::Contact& contact : sample.contacts) deepest_m_ = std::max(deepest_m_, contact.depth_m);
  }
  void finish(const dmrp::TrialEnd&, dmrp::MetricSink& sink) override {
    if (has("wants a plan") && !has_plan_) return;
    if (has("gives the undeclared")) sink.system("test_other", 0.0);
    if (has("gives infinity")) sink.system("test_check", 1.0 / number());
    sink.system("test_check", *level + deepest_m_ + static_cast<double>(calls_) + number());
  }

 private:
  std::size_t calls_ = 0;
  std::vector<int> classes_;
  bool has_plan_ = false;
  double deepest_m_ = 0.0;
};

}  // namespace

#ifdef DMRP_TEST_EXPORTS
extern "C" DMRP_EXPORT int planted_export() {
  return 1;
}
#endif

DMRP_PLUGINS(Planner, Controller, People, Metric)
