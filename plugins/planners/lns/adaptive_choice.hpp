// SPDX-License-Identifier: MIT
// adaptive_choice.hpp: which of a few ways to go on with.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <dmrp/toolkit/random.hpp>

namespace dmrp::planners {

// Chooses one of a few ways at random and shares the work, not the draws, by the gain that each way brought for its work
// lately (after Li et al. 2021: adaptive LNS): a way whose sets take ten times the work is drawn a tenth as often.
template <std::size_t count>
class AdaptiveChoice {
 public:
  std::size_t draw(toolkit::Stream& random) {
    double sum_of_gains = 0;
    for (const Past& past : pasts_) sum_of_gains += past.gain / past.work;
    std::array<double, count> weights{};
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const Past& past = pasts_[i];
      const double share = least_share + (sum_of_gains > 0 ? past.gain / past.work / sum_of_gains : 0.0);
      sum += weights[i] = share * past.draws / past.work;
    }
    double at = random.uniform() * sum;
    for (drawn_ = 0; drawn_ + 1 < count && (at -= weights[drawn_]) >= 0;) ++drawn_;
    return drawn_;
  }

  std::size_t drawn() const { return drawn_; }

  // What the way that was drawn last brought.
  void learn(std::int64_t gain, std::int64_t work) {
    Past& past = pasts_[drawn_];
    past.gain = memory * past.gain + static_cast<double>(gain);
    past.work = memory * past.work + static_cast<double>(std::max<std::int64_t>(work, 1));
    past.draws = memory * past.draws + 1.0;
  }

 private:
  struct Past {
    double gain = 1.0;
    double work = 1.0;
    double draws = 1.0;
  };
  static constexpr double memory = 0.99;      // what is left of a result at the next draw
  static constexpr double least_share = 0.2;  // of the work for each way, so that none dies out

  std::array<Past, count> pasts_{};
  std::size_t drawn_ = 0;
};

}  // namespace dmrp::planners
