// SPDX-License-Identifier: MIT
// driver.hpp: drives the plugins of this folder through the C structs, as a host of a later minor version would: array
// elements are longer than the plugins know, goals come between calls.
#pragma once

#include <dmrp/dmrp.h>

#include <map>
#include <string>
#include <vector>

#include "tests/support/newer_host.hpp"

namespace dmrp::test {

// A dmrp_host that stores what it is told, and offers the extensions that `offers` has.
class Host {
 public:
  explicit Host(std::string library_path);
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;

  dmrp_host c{};
  std::vector<std::string> log;
  std::string error;
  std::map<std::string, const void*> offers;

 private:
  std::string library_path_;
};

// A plugin library, loaded as a host does. `initialised` is the status of init().
class Library {
 public:
  explicit Library(const std::string& path);
  ~Library();
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;

  const dmrp_entry& entry() const { return *entry_; }
  const dmrp_descriptor& descriptor() const { return *entry_->descriptor(entry_, 0); }
  const std::string& path() const { return path_; }

  Host host;
  std::int32_t initialised = DMRP_ERROR;

 private:
  std::string path_;
  void* handle_ = nullptr;
  const dmrp_entry* entry_ = nullptr;
};

// The world of a trial from a map, a character a cell of one metre, first line at the top: '#' is not free. Every robot
// has the same limits and a disc of 0.3 m unless a test changes them.
class World {
 public:
  World(const std::vector<std::string>& map, std::size_t robots);
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  dmrp_vec2 center(int column, int row) const { return {column + 0.5, row + 0.5}; }
  std::uint32_t cell(double x, double y) const;
  bool is_free(std::uint32_t cell) const { return free_[cell] != 0; }
  const dmrp_grid* grid() const { return &grid_; }
  const dmrp_world& c();

  struct RobotData {
    dmrp_limits limits{};
    dmrp_footprint footprint{};
    std::vector<Longer<dmrp_goal>> goals;
  };
  std::vector<RobotData> robot_data;
  std::vector<Longer<dmrp_robot>> robots;

 private:
  std::vector<std::uint8_t> free_, edges_;
  std::vector<float> clearance_;
  dmrp_grid grid_{};
  dmrp_world world_{};
};

dmrp_goal goal_at(dmrp_vec2 place);

// An instance of a library's first plugin with its default parameters, changed by `numbers`. It is destroyed with this
// object.
class Instance {
 public:
  explicit Instance(Library& library, const std::map<std::string, double>& numbers = {});
  ~Instance();
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  template <class Interface>
  const Interface& as() const {
    return *static_cast<const Interface*>(c.table);
  }
  std::int32_t start(World& world, std::int32_t robot = DMRP_NO_ROBOT) const;
  // Gives a path through these points, each to be reached a second after the one before.
  std::int32_t set_path(std::uint32_t robot, const std::vector<dmrp_vec2>& points, std::uint32_t goal_index = 0);

  Host host;
  dmrp_plugin c{};

 private:
  std::uint64_t revision_ = 0;
};

// An observation and what it points to.
struct Scene {
  explicit Scene(const World::RobotData& robot);
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;
  const dmrp_observation* c();

  dmrp_limits limits;
  dmrp_footprint footprint;
  dmrp_goal goal{};
  std::vector<Longer<dmrp_agent>> agents;
  Longer<dmrp_observation> observation{};
};

}  // namespace dmrp::test
