// SPDX-License-Identifier: MIT
// What people do when they see a robot, besides evading it: the behaviours of HuNavSim (Perez-Higueras, Otero, Caballero,
// Merino: HuNavSim: A ROS 2 human navigation simulator for benchmarking human-aware robot navigation, RA-L 2023,
// section III).
//
//   surprised    stops and looks at it
//   curious      walks up to it
//   scared       walks away from it
//   threatening  gets in its way
//
// Each ends after some seconds, drawn from the seed; then the person walks on, and answers anew once all robots have
// been far away for some time. Distances and times are ours: we know of no measurement.
#pragma once

#include <cstdint>
#include <dmrp/cpp/pedestrian_model.hpp>
#include <dmrp/toolkit/grid_view.hpp>
#include <optional>

#include "pedestrians/crowd/encounters.hpp"

namespace dmrp::pedestrians {

// Shares of the people; the others react as the model has it.
struct ReactionShares {
  double surprised = 0.0;
  double curious = 0.0;
  double scared = 0.0;
  double threatening = 0.0;
};

// What a person wants in this step.
struct Wish {
  Vec2 way;                   // a unit vector; zero on the target
  double speed;               // m/s
  double robot_weight = 1.0;  // of the influence of robots
};

// Whether DMRP_REACTION_* is a behaviour of these.
inline bool is_answer(std::uint32_t reaction) {
  return reaction >= DMRP_REACTION_SURPRISED && reaction <= DMRP_REACTION_THREATENING;
}

class RobotReactions {
 public:
  // The grid's arrays must outlive this object. Throws std::invalid_argument if the shares add up to more than 1.
  void start(std::uint64_t seed, const toolkit::GridView& grid, const ReactionShares& shares);

  bool any_share() const { return any_share_; }

  // DMRP_REACTION_*: the person's own, or one drawn by the shares.
  std::uint32_t of(const Person& person) const;

  // Call begin_step() at every step, then answer() once for each person, with of(person): nothing if the person walks
  // on along `way`.
  void begin_step() { forget_unseen(encounters_); }
  std::optional<Wish> answer(std::uint32_t reaction, const Person& person, Vec2 way, const Span<Agent>& robots,
                             double step_s);

 private:
  // Of a person who has seen a robot.
  struct Encounter {
    double remaining_s = 0.0;  // of the reaction
    double away_s = 0.0;       // since a robot was near
    bool is_seen = true;       // in this step
  };

  bool sees(const Person& person, Vec2 way, const Agent& robot) const;

  std::uint64_t seed_ = 0;
  toolkit::GridView grid_;
  ReactionShares shares_;
  bool any_share_ = false;
  Encounters<Encounter> encounters_;
};

}  // namespace dmrp::pedestrians
