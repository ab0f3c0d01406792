// SPDX-License-Identifier: MIT
// bench_controllers_tape.hpp: records the input and output of a controller and replays the input.
#pragma once

#include <dmrp/ext/annotate.h>
#include <dmrp/ext/distance_field.h>
#include <dmrp/ext/lidar.h>
#include <dmrp/ext/local_costmap.h>
#include <dmrp/ext/obstacle_clusters.h>
#include <dmrp/local_controller.h>

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace dmrp::bench {

// One call of step(), with the data of those extensions that the controller read.
struct Frame {
  std::vector<dmrp_waypoint> path;  // if not empty: set_path() was called before
  dmrp_observation observation{};   // replaying sets its pointers to the next two
  dmrp_goal goal{};
  std::vector<dmrp_agent> agents;

  dmrp_scan scan{};
  std::vector<float> ranges;
  dmrp_costmap costmap{};
  std::vector<std::uint8_t> costs;
  dmrp_field field{};
  std::vector<float> distances_m;
  dmrp_obstacle_cluster_list clusters{};
  std::vector<std::uint32_t> vertex_counts;  // of clusters
  std::vector<dmrp_vec2> vertices;

  std::int32_t status = 0;
  dmrp_command command{};
};

using Tape = std::vector<Frame>;  // of one robot in one trial

// The extensions offered to a controller; derived classes provide the data.
class Perception {
 public:
  Perception();
  Perception(const Perception&) = delete;
  Perception& operator=(const Perception&) = delete;
  virtual ~Perception() = default;

  // nullptr if it does not offer the extension.
  virtual const void* extension(const std::string& id) = 0;

 protected:
  virtual const dmrp_scan* scan(std::uint32_t robot) = 0;
  virtual const dmrp_costmap* costmap(std::uint32_t robot) = 0;
  virtual const dmrp_field* field(std::uint32_t robot) = 0;
  virtual const dmrp_obstacle_cluster_list* clusters(std::uint32_t robot) = 0;

  // The C struct of an id, nullptr if there is none.
  const void* own(const std::string& id) const;

 private:
  dmrp_lidar lidar_{};
  dmrp_local_costmap local_costmap_{};
  dmrp_distance_field distance_field_{};
  dmrp_obstacle_clusters obstacle_clusters_{};
};

// Forwards the data of a robot's sensors and records it.
class Recorder final : public Perception {
 public:
  // The extension behind an id, as the host offers it.
  using Source = std::function<const void*(const std::string& id)>;
  explicit Recorder(Source source) : source_(std::move(source)) {}

  // Sets the frame into which all data read from now on is recorded.
  void write_to(Frame& frame) { frame_ = &frame; }

  // Records what the controller has not read, too: another one may want it.
  void read_all(std::uint32_t robot);

  const void* extension(const std::string& id) override;

 private:
  const dmrp_scan* scan(std::uint32_t robot) override;
  const dmrp_costmap* costmap(std::uint32_t robot) override;
  const dmrp_field* field(std::uint32_t robot) override;
  const dmrp_obstacle_cluster_list* clusters(std::uint32_t robot) override;

  Source source_;
  Frame* frame_ = nullptr;
};

// Replays recorded data. Also offers dmrp.annotate/1 if `listens`.
class Player final : public Perception {
 public:
  explicit Player(bool listens);

  void read_from(const Frame& frame) { frame_ = &frame; }
  const void* extension(const std::string& id) override;

  // Returns and clears the number of the last note "iterations N"; negative if there was none.
  double take_iterations();

 private:
  const dmrp_scan* scan(std::uint32_t robot) override;
  const dmrp_costmap* costmap(std::uint32_t robot) override;
  const dmrp_field* field(std::uint32_t robot) override;
  const dmrp_obstacle_cluster_list* clusters(std::uint32_t robot) override;

  const Frame* frame_ = nullptr;
  bool listens_;
  double iterations_ = -1.0;
  dmrp_annotate annotate_{};
  dmrp_scan scan_{};
  dmrp_costmap costmap_{};
  dmrp_field field_{};
  dmrp_obstacle_cluster_list clusters_{};
  std::vector<dmrp_obstacle_cluster> cluster_array_;
};

}  // namespace dmrp::bench
