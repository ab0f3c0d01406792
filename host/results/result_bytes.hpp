// SPDX-License-Identifier: MIT
// result_bytes.hpp: how much room the result of a metric takes. It has a limit, so that the memory of the supervisor has
// one, whatever plugins give.
#pragma once

#include <cstddef>

#include "host/results/trial_record.hpp"

namespace dmrp::host {

// For one metric in one trial: about 150,000 events.
inline constexpr std::size_t most_result_bytes = std::size_t{32} << 20;

// For one event: about 50,000 subjects. A message has a limit, too.
inline constexpr std::size_t most_event_bytes = std::size_t{1} << 20;

// About what it takes in memory, and no less than as JSON without escapes.
std::size_t bytes_of(const MetricValue& value);
std::size_t bytes_of(const MetricEvent& event);

}  // namespace dmrp::host
