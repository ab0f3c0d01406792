// SPDX-License-Identifier: MIT
// watchdog.hpp: waits for children, and finds calls that take too long.
#pragma once

#include <poll.h>

#include <cstdint>
#include <functional>
#include <span>

#include "host/program/monotonic_time.hpp"

namespace dmrp::host {

// Ctrl-Z in a terminal stops parent and children alike: time during which this process was stopped does not count.
class Watchdog {
 public:
  // Waits until one of the descriptors is readable or closed, for 100 ms at most. Whether one is.
  bool wait(std::span<pollfd> watched);

  // Waits until the descriptor is readable or closed. False if `is_late`, called every 100 ms, returned true first.
  bool wait(int descriptor, const std::function<bool()>& is_late);

  // Call it at least once a second while something is watched without wait().
  void look();

  // The time since `start_ns`.
  std::int64_t elapsed_ns(std::int64_t start_ns) const;

 private:
  std::int64_t last_seen_ns_ = monotonic_ns();  // when the last wait returned
  std::int64_t awake_since_ns_ = 0;
};

}  // namespace dmrp::host
