// SPDX-License-Identifier: MIT
// result_json.hpp: parts of a trial's result as JSON, for messages between processes. Reading throws
// nlohmann::json::exception or UnbelievableMessage.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <stdexcept>

#include "host/results/trial_record.hpp"

namespace dmrp::host {

// A message is none that its sender's state allows.
class UnbelievableMessage : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

void to_json(nlohmann::json& json, const TimingReason& reason);
void from_json(const nlohmann::json& json, TimingReason& reason);
void to_json(nlohmann::json& json, const MetricValue& value);
void from_json(const nlohmann::json& json, MetricValue& value);
void to_json(nlohmann::json& json, const MetricEvent& event);
void from_json(const nlohmann::json& json, MetricEvent& event);
void to_json(nlohmann::json& json, const MetricResult& result);
void from_json(const nlohmann::json& json, MetricResult& result);
void to_json(nlohmann::json& json, const FaultRecord& fault);
void from_json(const nlohmann::json& json, FaultRecord& fault);

}  // namespace dmrp::host
