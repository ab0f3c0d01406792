// SPDX-License-Identifier: MIT
// failure_causes.hpp: why robots failed their tasks.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/findings/summary.hpp"
#include "host/results/summary_layout.hpp"
#include "host/results/trial_record.hpp"

namespace dmrp::host {

struct FailureCause {
  std::string cause;  // as the event of the failure says, "fault" for robots of a trial that ended in one
  std::uint32_t robots = 0;
  std::vector<std::uint64_t> trials{};  // ids
  std::uint32_t after_contact = 0;      // of these robots: touched somebody or something by their own fault
  std::uint32_t roots = 0;              // robots that hold or block these: those that the events name second
};

struct CombinationFailures {
  CombinationLabels combination;
  std::uint32_t robots = 0;          // of all trials that ran
  std::vector<FailureCause> causes;  // of robots that did not arrive, or are excluded, the most frequent first
  FailureCause contact;              // robots that arrived, but touched somebody or something by their own fault
};

// Of each combination with robots, in order of first appearance.
std::vector<CombinationFailures> failure_causes(const SummaryLayout& layout, std::span<const TrialRecord> trials);

// A robot with this cause arrived, but does not count as arrived: "excluded for oscillation".
bool is_exclusion(std::string_view cause);

// Robots that a trial excludes, by their events of `arrived`.
std::uint32_t excluded_robots(const std::string& arrived, const TrialRecord& trial);

// Adds the robots of a cause to a list.
void add_cause(std::vector<FailureCause>& causes, const FailureCause& cause);

// "9 held behind another robot (by 2 robots), 3 stuck (1 after a contact)", the most frequent first; "" without robots.
std::string cause_words(std::vector<FailureCause> causes);

// "12 did not arrive: 9 held behind another robot (by 2 robots), 3 stuck"; "" if all arrived.
// Without exclusions: these robots arrived.
std::string failures_line(std::span<const CombinationFailures> failures);

// "Of 6 robots at standstills that ran on to the time limit, 1 arrived after all"; "" without such robots.
std::string standstills_line(const SummaryLayout& layout, std::span<const TrialRecord> trials);

}  // namespace dmrp::host
