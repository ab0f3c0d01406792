// SPDX-License-Identifier: MIT
// oracle.hpp: model predictive control that is told where people will be: the upper bound of prediction.
//
// The trajectories are those of mpc/. A person's predicted way is not straight on at its velocity, but as recorded in
// the same crowd without robots.
#pragma once

#include <dmrp/draft/people_future.h>

#include <cstdint>
#include <dmrp/plugin.hpp>
#include <vector>

#include "controllers/mpc/mpc.hpp"

template <>
struct dmrp::ExtensionId<dmrp_people_future> {
  DMRP_LOCAL static constexpr const char* value = DMRP_DRAFT_PEOPLE_FUTURE;
};

namespace dmrp::controllers {

class Oracle final : public Mpc {
 public:
  static Descriptor describe();

  Param<double> told_within = param("told_within", 0.5)
                                  .unit("m")
                                  .range(0.0, 100.0)
                                  .doc("a person farther than this from its recorded place goes on at its velocity");

  Status start(const Start& start) override;

 private:
  void foresee(const Observation& now, std::vector<Obstacle>& obstacles) override;
  bool has_strayed(std::uint64_t person) const;
  void follow_record(const Agent& person, double period_s, Obstacle& obstacle);
  void add_unseen(const Observation& now, std::vector<Obstacle>& obstacles);

  const dmrp_people_future* future_ = nullptr;
  std::vector<std::uint64_t> strayed_;  // people who have left their record, by robots; ascending

  // buffers, filled anew in every cycle
  std::vector<Vec2> ways_;
  std::vector<std::uint64_t> seen_;
};

}  // namespace dmrp::controllers
