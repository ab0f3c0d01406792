// SPDX-License-Identifier: MIT
#include "tests/contract_wishes/driver.hpp"

#include <dlfcn.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace dmrp::test {

Host::Host(std::string library_path) : library_path_(std::move(library_path)) {
  c.struct_size = sizeof(c);
  c.context = this;
  c.name = "driver";
  c.version = "0.0.0";
  c.library_path = library_path_.c_str();
  c.log = [](const dmrp_host* host, std::int32_t, const char* text) {
    static_cast<Host*>(host->context)->log.emplace_back(text);
  };
  c.set_error = [](const dmrp_host* host, const char* text) { static_cast<Host*>(host->context)->error = text; };
  c.should_stop = [](const dmrp_host*) { return std::int32_t{0}; };
  c.budget_left_ns = [](const dmrp_host*) { return std::int64_t{0}; };
  c.get_extension = [](const dmrp_host* host, const char* id) -> const void* {
    const auto& offered = static_cast<Host*>(host->context)->offers;
    const auto found = offered.find(id);
    return found == offered.end() ? nullptr : found->second;
  };
}

Library::Library(const std::string& path) : host(path), path_(path) {
  handle_ = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!handle_) throw std::runtime_error(dlerror());
  entry_ = static_cast<const dmrp_entry*>(dlsym(handle_, DMRP_ENTRY_SYMBOL));
  if (!entry_ || entry_->abi_draft != DMRP_ABI_DRAFT) throw std::runtime_error(path + " has no entry of this draft");
  initialised = entry_->init(entry_, &host.c);
}

Library::~Library() {
  if (initialised == DMRP_OK) entry_->deinit(entry_);
  dlclose(handle_);
}

World::World(const std::vector<std::string>& map, std::size_t count) : robot_data(count), robots(count) {
  const std::size_t width = map.front().size();
  for (auto line = map.rbegin(); line != map.rend(); ++line)
    for (const char cell : *line) free_.push_back(cell != '#');
  edges_.resize(free_.size());
  clearance_.assign(free_.size(), 1.0f);
  const auto open = [&](std::size_t column, std::size_t row) {
    return column < width && row < map.size() && free_[row * width + column] != 0;
  };
  for (std::size_t i = 0; i < free_.size(); ++i) {
    const std::size_t column = i % width, row = i / width;
    if (!open(column, row)) continue;
    if (open(column + 1, row)) edges_[i] |= DMRP_EDGE_E;
    if (open(column, row + 1)) edges_[i] |= DMRP_EDGE_N;
    if (open(column - 1, row)) edges_[i] |= DMRP_EDGE_W;
    if (open(column, row - 1)) edges_[i] |= DMRP_EDGE_S;
  }
  grid_ = {sizeof(grid_),
           static_cast<std::uint32_t>(width),
           static_cast<std::uint32_t>(map.size()),
           0,
           1.0,
           {0.0, 0.0},
           free_.data(),
           edges_.data(),
           clearance_.data()};
  for (std::size_t i = 0; i < count; ++i) {
    robot_data[i].limits.struct_size = sizeof(dmrp_limits);
    robot_data[i].limits.v_max = 1.0;
    robot_data[i].limits.omega_max = 2.0;
    robot_data[i].limits.a_max = 1.0;
    robot_data[i].limits.alpha_max = 4.0;
    robot_data[i].footprint = {sizeof(dmrp_footprint), 0, 0.3, 0.3, nullptr, 0, 0};
    robots[i].known.kinematics = DMRP_KINEMATICS_DIFFERENTIAL;
  }
}

std::uint32_t World::cell(double x, double y) const {
  return static_cast<std::uint32_t>(y) * grid_.width + static_cast<std::uint32_t>(x);
}

const dmrp_world& World::c() {
  for (std::size_t i = 0; i < robots.size(); ++i) {
    dmrp_robot& robot = robots[i].known;
    robot.name = "robot";
    robot.type = "";
    robot.limits = &robot_data[i].limits;
    robot.footprint = &robot_data[i].footprint;
    robot.goals = robot_data[i].goals.empty() ? nullptr : &robot_data[i].goals.front().known;
    robot.goal_count = count_of(robot_data[i].goals);
    robot.goal_stride = sizeof(Longer<dmrp_goal>);
  }
  world_.struct_size = sizeof(world_);
  world_.upper = {1.0 * grid_.width, 1.0 * grid_.height};
  world_.control_period_ns = 100'000'000;
  world_.robots = robots.empty() ? nullptr : &robots.front().known;
  world_.robot_count = count_of(robots);
  world_.robot_stride = sizeof(Longer<dmrp_robot>);
  world_.planning_grid = &grid_;
  return world_;
}

dmrp_goal goal_at(dmrp_vec2 place) {
  return {{place.x, place.y, std::numeric_limits<double>::quiet_NaN()}, 0.2, 0.2, 0.1, 0};
}

Instance::Instance(Library& library, const std::map<std::string, double>& numbers) : host(library.path()) {
  const dmrp_descriptor& descriptor = library.descriptor();
  std::vector<Longer<dmrp_param_value>> values;
  for (std::uint32_t i = 0; i < descriptor.param_count; ++i) {
    const dmrp_param_spec& spec = *DMRP_AT(dmrp_param_spec, descriptor.params, descriptor.param_stride, i);
    dmrp_param_value value = {spec.key,    spec.type, spec.count,   spec.integer,
                              spec.number, spec.text, spec.numbers, spec.texts};
    if (const auto found = numbers.find(spec.key); found != numbers.end()) {
      value.integer = static_cast<std::int64_t>(found->second);
      value.number = found->second;
    }
    values.push_back({value});
  }
  const dmrp_params params = {sizeof(params), count_of(values), sizeof(Longer<dmrp_param_value>), 0,
                              values.empty() ? nullptr : &values.front().known};
  c.struct_size = sizeof(c);
  if (library.entry().create(&library.entry(), &host.c, descriptor.id, &params, &c) != DMRP_OK)
    throw std::runtime_error(host.error);
}

Instance::~Instance() {
  c.destroy(c.self);
}

std::int32_t Instance::start(World& world, std::int32_t robot) const {
  const dmrp_start start = {sizeof(start), robot, 7, &world.c()};
  return c.start(c.self, &start);
}

std::int32_t Instance::set_path(std::uint32_t robot, const std::vector<dmrp_vec2>& points, std::uint32_t goal_index) {
  std::vector<Longer<dmrp_waypoint>> waypoints;
  for (std::size_t i = 0; i < points.size(); ++i)
    waypoints.push_back({{points[i].x, points[i].y, std::numeric_limits<double>::quiet_NaN(),
                          static_cast<std::int64_t>(i) * 1'000'000'000, goal_index, 0}});
  const dmrp_path path = {sizeof(path), count_of(waypoints), sizeof(waypoints.front()), 0, &waypoints.front().known};
  const dmrp_path_update update = {sizeof(update), robot, ++revision_, &path, 0, 0};
  return as<dmrp_local_controller>().set_path(c.self, &update);
}

Scene::Scene(const World::RobotData& robot) : limits(robot.limits), footprint(robot.footprint) {
  observation.known.struct_size = sizeof(observation);
  observation.known.dt_ns = 100'000'000;
  observation.known.goal_count = 1;
  observation.known.goal_stride = sizeof(dmrp_goal);
}

const dmrp_observation* Scene::c() {
  observation.known.goal = &goal;
  observation.known.limits = &limits;
  observation.known.footprint = &footprint;
  observation.known.agents = agents.empty() ? nullptr : &agents.front().known;
  observation.known.agent_count = count_of(agents);
  observation.known.agent_stride = sizeof(Longer<dmrp_agent>);
  return &observation.known;
}

}  // namespace dmrp::test
