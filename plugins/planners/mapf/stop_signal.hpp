// SPDX-License-Identifier: MIT
// stop_signal.hpp: asks the host now and then whether to stop, cheaply enough for the innermost loops.
#pragma once

#include <cstdint>
#include <functional>
#include <utility>

namespace dmrp::planners {

class StopSignal {
 public:
  explicit StopSignal(std::function<bool()> should_stop) : should_stop_(std::move(should_stop)) {}

  // Call once a unit of work of well under a microsecond; the host is asked every 256th time. Once raised, stays so.
  bool poll() { return ++polls_ % 256 == 0 ? poll_now() : raised_; }

  // Asks the host.
  bool poll_now() { return raised_ = raised_ || should_stop_(); }

  bool raised() const { return raised_; }

 private:
  std::function<bool()> should_stop_;
  std::uint32_t polls_ = 0;
  bool raised_ = false;
};

}  // namespace dmrp::planners
