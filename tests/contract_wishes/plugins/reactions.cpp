// SPDX-License-Identifier: MIT
// A pedestrian model in which people answer to robots as their `reaction` says. Whoever has no reaction, or one that this
// model does not know, does as the parameter says.
#include <algorithm>
#include <dmrp/plugin.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <string>

namespace {

namespace toolkit = dmrp::toolkit;

class Reactions final : public dmrp::PedestrianModel {
 public:
  static dmrp::Descriptor describe() { return dmrp::Descriptor("org.example.reactions", "Reactions", "0.1.0"); }
  dmrp::Param<double> notice_m = param("notice", 3).unit("m").range(0.0, 50.0).doc("how far a robot is noticed");
  dmrp::Param<std::string> unspecified = param("unspecified", "regular")
                                             .choices({"regular", "impassive"})
                                             .doc("what a person does whose reaction is not known");

  dmrp::Status step(const dmrp::Crowd& crowd, dmrp::Motions& motions) override {
    for (std::size_t i = 0; i < crowd.people.size(); ++i) {
      const dmrp::Person& person = crowd.people[i];
      const dmrp::Vec2 wanted = person.desired_speed * toolkit::normalized(person.target - person.position);
      const dmrp::Agent* robot = nearest(crowd.robots, person.position);
      motions[i].velocity = robot ? react(person, toolkit::position(robot->pose), wanted) : wanted;
    }
    return dmrp::Status::ok;
  }

 private:
  const dmrp::Agent* nearest(dmrp::Span<dmrp::Agent> robots, dmrp::Vec2 place) const {
    const dmrp::Agent* found = nullptr;
    double distance_m = notice_m;
    for (const dmrp::Agent& robot : robots) {
      const double to_m = toolkit::distance(place, toolkit::position(robot.pose));
      if (to_m < distance_m) {
        distance_m = to_m;
        found = &robot;
      }
    }
    return found;
  }

  dmrp::Vec2 react(const dmrp::Person& person, dmrp::Vec2 robot, dmrp::Vec2 wanted) const {
    const dmrp::Vec2 towards = toolkit::normalized(robot - person.position);
    switch (person.reaction) {
      case DMRP_REACTION_REGULAR:
        return around(wanted, towards);
      case DMRP_REACTION_IMPASSIVE:
        return wanted;
      case DMRP_REACTION_SURPRISED:
        return {0.0, 0.0};
      case DMRP_REACTION_CURIOUS:
      case DMRP_REACTION_THREATENING:
        return person.desired_speed * towards;
      case DMRP_REACTION_SCARED:
        return -person.desired_speed * towards;
      default:
        return unspecified == "impassive" ? wanted : around(wanted, towards);
    }
  }

  // Past the robot, on its right, when it is in the way.
  static dmrp::Vec2 around(dmrp::Vec2 wanted, dmrp::Vec2 towards) {
    if (toolkit::dot(wanted, towards) <= 0.0) return wanted;
    const dmrp::Vec2 sidestep =
        wanted - toolkit::dot(wanted, towards) * towards - 0.5 * toolkit::perpendicular(towards);
    return toolkit::norm(wanted) * toolkit::normalized(sidestep);
  }
};

}  // namespace

DMRP_PLUGINS(Reactions)
