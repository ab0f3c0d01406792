// SPDX-License-Identifier: MIT
// The words for what trials have met, for every table and sentence.
#include <fmt/format.h>

#include "host/findings/findings.hpp"

namespace dmrp::host {

std::string observation_name(const Met& met) {
  return met.drawn > 0 ? "task" : met.has_people ? "crowd" : "seed";
}

std::string met_words(const Met& met) {
  const auto counted = [](std::uint32_t count, const std::string& noun) {
    return count == 1 ? "one " + noun : fmt::format("{} {}s", count, noun);
  };
  const std::string crowd = met.has_people ? "crowd" : "seed";
  const bool all_drawn = met.drawn == met.tasks;
  std::string tasks = counted(met.tasks, all_drawn ? "drawn task" : "task");
  if (met.drawn > 0 && !all_drawn) tasks += fmt::format(", {} of them drawn", met.drawn);
  if (met.tasks == 0 || (all_drawn && met.meetings == met.tasks)) return tasks;
  if (met.tasks == 1 || met.meetings % met.tasks != 0 || (met.drawn > 0 && !all_drawn))
    return tasks + ", " + counted(met.crowds, crowd);
  return fmt::format("{} x {}", tasks, counted(met.meetings / met.tasks, crowd));
}

}  // namespace dmrp::host
