// SPDX-License-Identifier: MIT
#include "core/scene/robot_types.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace dmrp::core {

void RobotTypes::put(RobotSettings type) {
  for (RobotSettings& known : types_)
    if (known.type == type.type) {
      known = std::move(type);
      return;
    }
  types_.push_back(std::move(type));
}

const RobotSettings* RobotTypes::find(std::string_view name) const {
  const auto found = std::find_if(types_.begin(), types_.end(), [&](const auto& type) { return type.type == name; });
  return found == types_.end() ? nullptr : &*found;
}

const RobotSettings& RobotTypes::of(const RobotTask& task) const {
  if (const RobotSettings* found = find(task.type)) return *found;
  throw std::invalid_argument("robot '" + task.name + "' has the unknown type '" + task.type + "'");
}

}  // namespace dmrp::core
