// SPDX-License-Identifier: MIT
// stop_signal.hpp: polls the host's request to stop, cheaply enough for innermost loops.
#pragma once

#include <cstdint>
#include <functional>
#include <utility>

namespace dmrp::planners {

class StopSignal {
 public:
  explicit StopSignal(std::function<bool()> should_stop) : should_stop_(std::move(should_stop)) {}

  // Call it once for each unit of work of less than a microsecond: it asks the host every 256th time. Once raised, the
  // signal stays raised.
  bool poll() { return ++polls_ % 256 == 0 ? poll_now() : raised_; }

  // Asks the host each time.
  bool poll_now() { return raised_ = raised_ || should_stop_(); }

  bool raised() const { return raised_; }

 private:
  std::function<bool()> should_stop_;
  std::uint32_t polls_ = 0;
  bool raised_ = false;
};

}  // namespace dmrp::planners
