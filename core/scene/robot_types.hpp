// SPDX-License-Identifier: MIT
// robot_types.hpp: the types of robot of a world.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "core/scene/scenario.hpp"
#include "core/scene/settings.hpp"

namespace dmrp::core {

// The first type is the default one.
class RobotTypes {
 public:
  RobotTypes(RobotSettings standard = {}) : types_{std::move(standard)} { types_[0].type.clear(); }

  // Adds a type, or replaces the one of its name.
  void put(RobotSettings type);

  std::span<const RobotSettings> all() const { return types_; }
  const RobotSettings& standard() const { return types_[0]; }

  // nullptr if there is none. "" is the default type.
  const RobotSettings* find(std::string_view name) const;

  // Throws std::invalid_argument if its type is unknown.
  const RobotSettings& of(const RobotTask& task) const;

 private:
  std::vector<RobotSettings> types_;
};

}  // namespace dmrp::core
