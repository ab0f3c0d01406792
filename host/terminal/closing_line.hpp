// SPDX-License-Identifier: MIT
// closing_line.hpp: the last lines that a run prints below its table, without indent and line end.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "host/results/manifest.hpp"
#include "host/results/summary_layout.hpp"
#include "host/results/trial_record.hpp"

namespace dmrp::host {

// "drawn tasks: office with 2, 4, 8, 16 robots; mall with 8 robots"; empty if all tasks are listed.
std::string drawn_tasks_line(std::span<const ScenarioFacts> scenarios);

// "12 of 12 robots arrived; 2 of them are excluded for oscillation · 0 contacts · 0 faults · repeatable"
std::string closing_line(const SummaryLayout& layout, std::span<const TrialRecord> trials);

// "runs/quickstart   report.html  results.sqlite  traces/"
std::string files_line(const std::filesystem::path& run_directory, std::span<const std::string> files);

}  // namespace dmrp::host
