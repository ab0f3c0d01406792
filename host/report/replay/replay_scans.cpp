// SPDX-License-Identifier: MIT
#include "host/report/replay/replay_scans.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "host/report/replay/replay_numbers.hpp"

namespace dmrp::host {
namespace {

constexpr std::size_t most_beams = 180;

std::int64_t microradians(double angle) {
  return std::llround(angle * 1e6);
}

// Differences between beams in centimetres; 0 for a beam without a hit.
void write_ranges(const core::TraceScan& scan, std::size_t every, std::vector<std::int64_t>& to) {
  std::int64_t last = 0;
  for (std::size_t i = 0; i < scan.ranges.size(); i += every) {
    const std::int64_t range = std::isfinite(scan.ranges[i]) ? std::llround(100.0 * scan.ranges[i]) : 0;
    to.push_back(range - last);
    last = range;
  }
}

}  // namespace

nlohmann::json replay_scans(const std::vector<core::TraceScan>& scans, std::uint32_t robot,
                            std::span<const std::int64_t> times_ms) {
  const core::TraceScan* first = nullptr;
  std::size_t every = 1;
  Deltas samples;
  std::vector<std::int64_t> ranges;
  for (const core::TraceScan& scan : scans) {
    const auto sample = std::lower_bound(times_ms.begin(), times_ms.end(), milliseconds(scan.t_ns));
    const bool is_kept = sample != times_ms.end() && *sample == milliseconds(scan.t_ns);
    if (scan.robot != robot || scan.ranges.empty() || !is_kept) continue;
    if (!first) {
      first = &scan;
      every = (scan.ranges.size() + most_beams - 1) / most_beams;
    }
    if (scan.ranges.size() != first->ranges.size()) continue;
    samples.add(sample - times_ms.begin());
    write_ranges(scan, every, ranges);
  }
  if (!first) return nullptr;
  return {{"first", microradians(first->angle_min)},
          {"step", microradians(first->angle_increment * static_cast<double>(every))},
          {"beams", (first->ranges.size() + every - 1) / every},
          {"samples", std::move(samples).json()},
          {"ranges", std::move(ranges)}};
}

}  // namespace dmrp::host
