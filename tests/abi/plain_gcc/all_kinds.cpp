// SPDX-License-Identifier: MIT
// A library with a plugin of every kind that uses all of the C++ layer and of the toolkit. Its classes have external
// linkage: nobody told the author to hide them.
#include <dmrp/plugin.hpp>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/disc_sweep.hpp>
#include <dmrp/toolkit/distance_transform.hpp>
#include <dmrp/toolkit/grid_line.hpp>
#include <dmrp/toolkit/grid_view.hpp>
#include <dmrp/toolkit/navigation_field.hpp>
#include <dmrp/toolkit/neighbour_grid.hpp>
#include <dmrp/toolkit/polygon.hpp>
#include <dmrp/toolkit/polyline.hpp>
#include <dmrp/toolkit/random.hpp>
#include <dmrp/toolkit/ray_cast.hpp>
#include <dmrp/toolkit/rectangle.hpp>
#include <dmrp/toolkit/segment.hpp>
#include <dmrp/toolkit/shape_distance.hpp>
#include <dmrp/toolkit/snap.hpp>
#include <dmrp/toolkit/svg.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <map>
#include <string>
#include <vector>

namespace example {

namespace toolkit = dmrp::toolkit;

// Constants passed by reference, and so needed in memory.
template <class Value>
double value_of(const Value& value) {
  return static_cast<double>(value);
}
double constants() {
  double sum = value_of(toolkit::pi) + value_of(toolkit::direction_count) + value_of(toolkit::no_cell) +
               value_of(toolkit::ray_misses) + value_of(dmrp::undefined) +
               value_of(toolkit::NavigationField::unreachable) + value_of(dmrp::LocalController::interface_kind);
  const std::vector<std::string> ids = {dmrp::ExtensionId<dmrp_lidar>::value, dmrp::ExtensionId<dmrp_annotate>::value};
  std::vector<std::string> emplaced;
  emplaced.emplace_back(dmrp::ExtensionId<dmrp_local_costmap>::value);
  for (std::size_t i = 0; i < 8; ++i)
    sum += toolkit::direction_dx[i] + toolkit::direction_dy[i] + toolkit::direction_length[i];
  return sum + static_cast<double>(ids.size() + emplaced.size());
}

class Controller final : public dmrp::LocalController {
 public:
  static dmrp::Descriptor describe() {
    return dmrp::Descriptor("org.example.controller", "Controller", "1.0.0").uses(DMRP_EXT_LIDAR);
  }
  static void load(const dmrp::Host& host) { host.log(dmrp::LogLevel::info, host.library_path()); }
  static void unload() {}

  dmrp::Param<bool> flag = param("flag", true);
  dmrp::Param<int> integer = param("integer", 7).range(1, 9);
  dmrp::Param<std::int64_t> large = param("large", 8);
  dmrp::Param<double> number = param("number", 2).unit("m").range(0.0, 5.0);
  dmrp::Param<std::string> text = param("text", "a").choices({"a", "b"});
  dmrp::Param<std::vector<double>> numbers = param("numbers", std::vector<double>{1.0});
  dmrp::Param<std::vector<std::string>> texts = param("texts", std::vector<std::string>{"x"});

  dmrp::Status start(const dmrp::Start& start) override {
    random_ = toolkit::Stream(start.seed, "controller", start.robot, "text");
    if (const auto* lidar = find_extension<dmrp_lidar>()) lidar->scan(lidar, static_cast<std::uint32_t>(start.robot));
    clearance_ = toolkit::clearance(world().shapes(), {world()->lower, world()->upper}, {0.0, 0.0});
    return text == "b" ? dmrp::Status::warning : dmrp::Status::ok;
  }
  void set_path(dmrp::Path path, std::uint64_t) override {
    path_.assign(path.begin(), path.end());
    toolkit::arc_lengths(path_, arcs_);
  }
  dmrp::Status step(const dmrp::Observation& now, dmrp::Command& command) override {
    const auto place = toolkit::project(path_, arcs_, toolkit::position(now.pose));
    command.v_x = number + clearance_ + toolkit::heading_at(path_, arcs_, place.arc_m, 0.0);
    command.omega = random_.truncated_normal(0.0, 1.0, -1.0, 1.0) + constants();
    for (const dmrp::Agent& agent : now.agents) command.v_x += toolkit::bearing(now.pose, agent.pose);
    for (const dmrp::Polygon& part : dmrp::parts(now.footprint)) command.v_x += part.vertices[0].x;
    random_.shuffle(arcs_);
    return dmrp::Status::ok;
  }

 private:
  std::vector<dmrp::Waypoint> path_;
  std::vector<double> arcs_;
  double clearance_ = 0.0;
  toolkit::Stream random_{0, "controller"};
};

class Central final : public dmrp::CentralController {
 public:
  static dmrp::Descriptor describe() { return dmrp::Descriptor("org.example.central", "Central", "1.0.0"); }
  void set_path(std::uint32_t robot, dmrp::Path path, std::uint64_t) override { ends_[robot] = path.back().x; }
  dmrp::Status step(dmrp::Fleet& fleet) override {
    for (std::size_t i = 0; i < fleet.size(); ++i) fleet.command(i, {ends_[fleet[i].robot], 0.0, 0.0});
    return dmrp::Status::ok;
  }

 private:
  std::map<std::uint32_t, double> ends_;
};

class Planner final : public dmrp::GlobalPlanner {
 public:
  static dmrp::Descriptor describe() { return dmrp::Descriptor("org.example.planner", "Planner", "1.0.0"); }
  dmrp::Status plan(const dmrp::PlanningProblem& problem, dmrp::PlanSink& sink) override {
    const toolkit::GridView grid(problem.grid);
    const toolkit::Rectangle border = {world()->lower, world()->upper};
    field_.compute(grid, border);
    sink.statistic("cost", field_.value(dmrp::Vec2{0.0, 0.0}) + field_.direction(dmrp::Vec2{0.0, 0.0}).x);
    const auto cells = toolkit::snap_to_cells(grid, {}, 1.0, 0.3, world().shapes(), border);
    toolkit::for_each_cell_on_line(grid, {0.0, 0.0}, {1.0, 1.0}, [](auto&&...) { return true; });
    if (toolkit::line_is_free(grid, {0.0, 0.0}, {1.0, 1.0}) && cells)
      for (std::uint32_t i = 0; i < problem.robots.size(); ++i) sink.path(i, std::vector<dmrp::Waypoint>{});
    return dmrp::Status::ok;
  }

 private:
  toolkit::NavigationField field_;
};

class Pedestrians final : public dmrp::PedestrianModel {
 public:
  static dmrp::Descriptor describe() { return dmrp::Descriptor("org.example.pedestrians", "Pedestrians", "1.0.0"); }
  dmrp::Status step(const dmrp::Crowd& crowd, dmrp::Motions& motions) override {
    for (std::size_t i = 0; i < motions.size(); ++i) motions[i].velocity = crowd.people[i].velocity;
    return dmrp::Status::ok;
  }
};

class Measure final : public dmrp::Metric {
 public:
  static dmrp::Descriptor describe() {
    return dmrp::Descriptor("org.example.metric", "Metric", "1.0.0")
        .value("length", "m", dmrp::Direction::lower_is_better, dmrp::Subjects::system_and_robots, "a length");
  }
  void begin(const dmrp::MetricTrial& trial) override {
    length_ = trial.plan ? toolkit::length(trial.plan.path(0)) : 0.0;
  }
  void observe(const dmrp::Sample& sample) override { robots_ = sample.robots.size(); }
  void finish(const dmrp::TrialEnd& end, dmrp::MetricSink& sink) override {
    sink.system("length", length_ + static_cast<double>(end.t_ns));
    for (std::size_t i = 0; i < robots_; ++i) sink.robot("length", i, dmrp::undefined);
    sink.event({"length", 0, 1, {dmrp::robot_subject(0)}, std::string(toolkit::series_color(3))});
  }

 private:
  double length_ = 0.0;
  std::size_t robots_ = 0;
};

}  // namespace example

DMRP_PLUGINS(example::Controller, example::Central, example::Planner, example::Pedestrians, example::Measure)
