// SPDX-License-Identifier: MIT
// recorded_problems.hpp: the MPC's problems as they come while driving, with the warm starts that it has then.
#pragma once

#include <deque>
#include <memory>
#include <vector>

#include "controllers/mpc/problem.hpp"

namespace dmrp::test {

// Owns what the problem points to.
struct RecordedProblem {
  controllers::mpc::Problem problem;
  controllers::mpc::Trajectory start;  // what the solver begins with
  bool is_warm = false;
  std::shared_ptr<const std::vector<dmrp_vec2>> vertices;
  std::shared_ptr<const std::vector<controllers::Obstacle>> obstacles;
};

// Drives a disc through worlds drawn from the seed, half of them lanes with walls, furniture and walking people as in a
// mall, half of them cluttered with posts and boxes, and records every so many periods. The same numbers give the same
// problems.
std::vector<RecordedProblem> record_problems(std::uint64_t seed, std::size_t count);

}  // namespace dmrp::test
