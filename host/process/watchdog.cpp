// SPDX-License-Identifier: MIT
#include "host/process/watchdog.hpp"

#include <algorithm>

namespace dmrp::host {

namespace {

constexpr int poll_interval_ms = 100;
constexpr std::int64_t longest_gap_ns = 1'000'000'000;  // between waits; a longer one: this process was stopped

}  // namespace

bool Watchdog::wait(std::span<pollfd> watched) {
  const int ready = poll(watched.data(), watched.size(), poll_interval_ms);
  look();
  return ready > 0;
}

void Watchdog::look() {
  const std::int64_t now_ns = monotonic_ns();
  if (now_ns - last_seen_ns_ > longest_gap_ns) awake_since_ns_ = now_ns;
  last_seen_ns_ = now_ns;
}

bool Watchdog::wait(int descriptor, const std::function<bool()>& is_late) {
  pollfd watched = {descriptor, POLLIN, 0};
  while (!wait({&watched, 1}))
    if (is_late()) return false;
  return true;
}

std::int64_t Watchdog::elapsed_ns(std::int64_t start_ns) const {
  return monotonic_ns() - std::max(start_ns, awake_since_ns_);
}

}  // namespace dmrp::host
