// SPDX-License-Identifier: MIT
// trial_picture.hpp: pictures of a trial: its map, and frames of it as a video.
#pragma once

#include <dmrp/sample.h>
#include <dmrp/world.h>

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/picture/world_picture.hpp"

namespace dmrp::core {

// The world, the first plans, and the ways that robots drove and people walked. Robots stand where they were last.
class TrialMap {
 public:
  // `world` must outlive the map, as it must a video.
  explicit TrialMap(const dmrp_world& world);

  // Samples in the order of time.
  void observe(const dmrp_sample& sample);

  // `title`: may be empty.
  std::string document(PictureFormat format, std::string_view title) const;

 private:
  using Way = std::vector<dmrp_vec2>;
  struct Robot {
    Way planned;
    Way driven;
    dmrp_robot_sample last;
  };

  const dmrp_world& world_;
  std::vector<Robot> robots_;
  std::map<std::uint64_t, Way> walks_;  // by the person's id
  std::vector<dmrp_vec2> contacts_;
};

class TrialFrames {
 public:
  TrialFrames(const dmrp_world& world, int width, int height, std::string_view title);

  // Samples in the order of time: ways grow with them.
  void observe(const dmrp_sample& sample);

  // The moment of the last observed sample; `clock` says which. As Painter::frame(), valid until the next call.
  std::span<const std::uint8_t> frame(const dmrp_sample& sample, std::string_view clock);

 private:
  const dmrp_world& world_;
  WorldPicture still_;  // the world, and the ways so far
  WorldPicture frame_;
  std::vector<dmrp_vec2> places_;  // by robot: where its drawn way ends
};

}  // namespace dmrp::core
