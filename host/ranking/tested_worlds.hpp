// SPDX-License-Identifier: MIT
// tested_worlds.hpp: which worlds have been shown to tell planners or controllers apart, and which are for sanity only.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "host/results/manifest.hpp"
#include "host/results/trial_record.hpp"

namespace dmrp::host {

// A row of docs/discrimination.md, from layouts/discrimination.json, which tests/bench/discrimination.sh writes.
struct TestedWorld {
  std::string scenario;
  std::uint32_t robots = 0;
  std::uint32_t people = 0;
  std::string factor;  // "planners" or "controllers"
  bool passes = false;
};

// Throws std::runtime_error that names the file.
std::vector<TestedWorld> read_tested_worlds(const std::filesystem::path& path);

// One sentence for each factor that varies in these trials, with the worlds that were tested for it and failed, or that
// passed with more robots or more people than here. Nothing is said of worlds that nobody tested.
std::vector<std::string> sanity_only(std::span<const TestedWorld> tested, std::span<const ScenarioFacts> scenarios,
                                     std::span<const TrialRecord> trials);

}  // namespace dmrp::host
