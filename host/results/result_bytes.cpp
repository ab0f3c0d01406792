// SPDX-License-Identifier: MIT
#include "host/results/result_bytes.hpp"

namespace dmrp::host {

namespace {

constexpr std::size_t digits_of_subject = 21;  // with the comma

}  // namespace

std::size_t bytes_of(const MetricValue& value) {
  return sizeof(MetricValue) + value.metric.size();
}

std::size_t bytes_of(const MetricEvent& event) {
  return sizeof(MetricEvent) + event.metric.size() + event.text.size() +
         digits_of_subject * (event.robots.size() + event.people.size());
}

}  // namespace dmrp::host
