// SPDX-License-Identifier: MIT
// cpp/pedestrian_model.hpp: the base class of pedestrian models; the contract is in ../pedestrian_model.h.
#pragma once

#include "../pedestrian_model.h"
#include "plugin_base.hpp"

namespace dmrp {

using Agent = dmrp_agent;
using Person = dmrp_person;

// dmrp_crowd with spans. Valid until step() returns.
struct Crowd {
  explicit Crowd(const dmrp_crowd& c)
      : t_ns(c.t_ns),
        dt_ns(c.dt_ns),
        people(c.people, c.person_count, c.person_stride),
        robots(c.robots, c.robot_count, c.robot_stride) {}

  std::int64_t t_ns;
  std::int64_t dt_ns;
  Span<Person> people;
  Span<Agent> robots;
};

class PedestrianModel : public Plugin {
 public:
  // Writes crowd.people.size() velocities.
  virtual Status step(const Crowd& crowd, Vec2* velocities) = 0;

  static constexpr std::uint32_t kind = DMRP_KIND_PEDESTRIAN_MODEL;
  static const void* interface_table() {
    static const dmrp_pedestrian_model table = {
        sizeof(table), 0, [](dmrp_instance* self, const dmrp_crowd* crowd, dmrp_vec2* velocities) {
          auto& model = detail::from_instance<PedestrianModel>(self);
          return PluginAccess::guarded(model, [&] { return model.step(Crowd(*crowd), velocities); });
        }};
    return &table;
  }
};

}  // namespace dmrp
