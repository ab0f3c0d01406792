// SPDX-License-Identifier: MIT
// replay_tracks.hpp: the tracks of robots and people in a replay.
#pragma once

#include <dmrp/sample.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "host/report/replay/replay_numbers.hpp"

namespace dmrp::host {

class RobotTrack {
 public:
  // `path`: the current path; may be null.
  void add(std::size_t sample, const dmrp_robot_sample& robot, const dmrp_path* path);

  // Adds the series to the robot's JSON object.
  void write_to(nlohmann::json& robot) &&;

 private:
  Deltas x_;
  Deltas y_;
  Deltas theta_;
  double unwrapped_theta_ = 0.0;
  Runs state_;
  Runs goal_;
  bool active_ = true;
  Deltas speed_;
  Deltas deviation_;  // -1 without a path
};

class PeopleTracks {
 public:
  void add(std::size_t sample, const dmrp_sample& people);
  nlohmann::json json() &&;

 private:
  // One person's presence, from entering to leaving.
  struct Visit {
    std::uint64_t id;
    std::uint32_t group;
    double radius_m;
    std::size_t from_sample;
    Deltas x;
    Deltas y;
  };
  std::vector<Visit> visits_;
  std::map<std::uint64_t, std::size_t> latest_;  // by id: index of the last visit
};

}  // namespace dmrp::host
