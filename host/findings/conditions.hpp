// SPDX-License-Identifier: MIT
// conditions.hpp: what helped the controllers of a run, and under which rules they drove, in words: results under other
// conditions are not theirs.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace dmrp::host {

// "local routes, collision monitor, no recoveries, no replanning, tracking visible, tuned parameters, robot awareness 1";
// of a swept key "swept". `experiment_toml`: as the user wrote it, for the names of the parameter sets.
std::string conditions_words(std::string_view effective_toml, std::string_view experiment_toml);
std::string conditions_of_run(const std::filesystem::path& run_directory);

}  // namespace dmrp::host
