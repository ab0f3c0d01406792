// SPDX-License-Identifier: MIT
// given_walking_grid.hpp: dmrp.walking_grid/1 with the same grid for every request.
#pragma once

#include <dmrp/ext/walking_grid.h>

#include "tests/unit/plugin_under_test.hpp"

namespace dmrp::test {

// Never moves: plugins keep its address.
class GivenWalkingGrid {
 public:
  explicit GivenWalkingGrid(const dmrp_grid& grid) : grid_(&grid) {
    c_ = {sizeof(c_), 0, this,
          [](const dmrp_walking_grid* extension, const dmrp_walking_grid_request* request) -> const dmrp_grid* {
            auto& given = *static_cast<GivenWalkingGrid*>(extension->context);
            given.asked = *request;
            return given.grid_;
          }};
  }
  GivenWalkingGrid(const GivenWalkingGrid&) = delete;
  GivenWalkingGrid& operator=(const GivenWalkingGrid&) = delete;

  void offer(FakeHost& host) const { host.extensions[DMRP_EXT_WALKING_GRID] = &c_; }

  dmrp_walking_grid_request asked{};  // the last request

 private:
  const dmrp_grid* grid_;
  dmrp_walking_grid c_{};
};

}  // namespace dmrp::test
