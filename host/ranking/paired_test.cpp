// SPDX-License-Identifier: MIT
#include "host/ranking/paired_test.hpp"

#include "core/statistics/sign_flip.hpp"
#include "core/statistics/signed_rank.hpp"

namespace dmrp::host {

PairedResult paired_test(std::span<const double> differences, PairedTest test) {
  if (test == PairedTest::sign_flip) {
    const core::SignFlipTest result = core::sign_flip_test(differences);
    return {result.p, result.mean};
  }
  const core::SignedRankTest result = core::signed_rank_test(differences);
  return {result.p, result.rank_biserial};
}

}  // namespace dmrp::host
