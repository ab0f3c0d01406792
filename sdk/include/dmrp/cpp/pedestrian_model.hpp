// SPDX-License-Identifier: MIT
// cpp/pedestrian_model.hpp: the base class of pedestrian models; the contract is in ../pedestrian_model.h.
#pragma once

#include <cstdint>

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

// The motion of each person: zero until it is written. Valid until step() returns.
class Motions {
 public:
  explicit Motions(dmrp_motions& c) : c_(&c) {}

  std::size_t size() const { return c_->count; }
  dmrp_motion& operator[](std::size_t person) { return *DMRP_AT_OUT(dmrp_motion, c_->motions, c_->stride, person); }

 private:
  dmrp_motions* c_;
};

class PedestrianModel : public Plugin {
 public:
  // Writes the motion of crowd.people[i] to motions[i].
  virtual Status step(const Crowd& crowd, Motions& motions) = 0;

  DMRP_LOCAL static constexpr std::uint32_t interface_kind = DMRP_KIND_PEDESTRIAN_MODEL;
  static constexpr dmrp_pedestrian_model interface_table() { return {sizeof(dmrp_pedestrian_model), 0, &call_step}; }

 private:
  static std::int32_t call_step(dmrp_instance* self, const dmrp_crowd* crowd, dmrp_motions* motions) {
    auto& model = detail::from_instance<PedestrianModel>(self);
    return PluginAccess::guarded(model, [&] {
      Motions out(*motions);
      return model.step(Crowd(*crowd), out);
    });
  }
};

}  // namespace dmrp
