// SPDX-License-Identifier: MIT
#include "host/ranking/answer_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/ranking/paired_test.hpp"

namespace dmrp::host {
namespace {

constexpr std::size_t most_names = 3;  // in one sentence

std::string counted(std::uint64_t count, const std::string& noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string observed(const Answer& answer, std::uint64_t count) {
  return counted(count, answer.in_general ? "task" : "crowd seed");
}

std::string value_words(const Criterion& criterion, double value) {
  return criterion.share ? fmt::format("{} {:.2f}", criterion.name, value)
                         : fmt::format("{:.2f} s per metre of its shortest way", value);
}

std::string means_words(const Answer& answer, const RankedCombination& one) {
  std::string words;
  for (std::size_t i = 0; i < answer.criteria.size(); ++i)
    if (!std::isnan(one.means[i])) words += (words.empty() ? "" : ", ") + value_words(answer.criteria[i], one.means[i]);
  return words;
}

std::string p_words(double p) {
  return p < 0.001 ? "p < 0.001" : fmt::format("p = {:.3f}", p);
}

// "A, B, C and 4 more"
std::string list_words(const std::vector<std::string>& names) {
  std::string words;
  const std::size_t shown = names.size() <= most_names + 1 ? names.size() : most_names;
  for (std::size_t i = 0; i < shown; ++i) {
    const bool last = i + 1 == names.size();
    words += (i == 0 ? "" : last ? " and " : ", ") + names[i];
  }
  return shown < names.size() ? fmt::format("{} and {} more", words, names.size() - shown) : words;
}

std::vector<const RankedCombination*> with_standing(const Answer& answer, Standing standing) {
  std::vector<const RankedCombination*> found;
  for (const RankedCombination& one : answer.ranking)
    if (one.standing == standing) found.push_back(&one);
  return found;
}

bool is_equal_to_first(const RankedCombination& one) {
  return std::all_of(one.against.begin(), one.against.end(), [](const AgainstFirst& against) {
    return against.observations > 0 && std::fabs(against.mean) < 1e-9 && std::isnan(against.p);
  });
}

std::string beside_words(const Answer& answer, const RankedCombination& one) {
  if (is_equal_to_first(one)) return combination_name(one) + " (the same in every trial)";
  if (one.decided) return fmt::format("{} ({})", combination_name(one), difference_words(answer, one, *one.decided));
  return combination_name(one);
}

std::string best_line(const Answer& answer) {
  const RankedCombination& first = answer.ranking.front();
  const auto beside = with_standing(answer, Standing::not_told_apart);
  std::string line = fmt::format("{}: {}.", combination_name(first), means_words(answer, first));
  if (beside.empty()) return "Best: " + line + " It can be told apart from every other combination.";
  std::vector<std::string> names;
  for (const RankedCombination* one : beside) names.push_back(beside_words(answer, *one));
  return "First: " + line + " Not told apart from it: " + list_words(names) + ".";
}

// The last of the order first.
std::string worse_line(const Answer& answer) {
  auto worse = with_standing(answer, Standing::worse);
  std::reverse(worse.begin(), worse.end());
  std::vector<std::string> names;
  for (const RankedCombination* one : worse)
    names.push_back(fmt::format("{} ({}, {})", combination_name(*one), difference_words(answer, *one, *one->decided),
                                p_words(one->against[*one->decided].p_holm)));
  return "Worse: " + list_words(names) + ".";
}

// "Of the 240 robots of SIPP + E3MoP, 20 did not arrive safely: 14 deadlock, 6 after a contact at fault." "" if none did.
std::string cause_line(const Answer& answer, const RankedCombination& one,
                       std::span<const CombinationFailures> failures) {
  std::uint32_t robots = 0;
  std::vector<FailureCause> causes;
  for (const CombinationFailures& other : failures) {
    CombinationLabels cell = other.combination;
    if (cell.global_planner != one.global_planner || cell.local_controller != one.local_controller) continue;
    cell.global_planner = cell.local_controller = "";
    if (std::find(answer.cells.begin(), answer.cells.end(), cell) == answer.cells.end()) continue;
    robots += other.robots;
    for (const FailureCause& cause : other.causes) add_cause(causes, cause);
    add_cause(causes, {"after a contact at fault", other.contact.robots, other.contact.trials, 0});
  }
  std::uint32_t unsafe = 0;
  for (const FailureCause& cause : causes) unsafe += cause.robots;
  return unsafe == 0 ? ""
                     : fmt::format("Of the {} of {}, {} did not arrive safely: {}.", counted(robots, "robot"),
                                   combination_name(one), unsafe, cause_words(causes));
}

// Pairs of combinations whose order a sibling of the first criterion turns round.
std::string flip_line(const Answer& answer) {
  const std::string& first = answer.criteria.front().name;
  std::vector<std::string> pairs;
  for (const OrderFlip& flip : answer.flips) {
    const auto words = [&](const RankedCombination& one) {
      return fmt::format("{} ({:.2f}; {} {:.2f})", combination_name(one), one.sibling_means[flip.sibling], first,
                         one.means[0]);
    };
    pairs.push_back(fmt::format("by {}, {} is before {}", answer.siblings[flip.sibling].name,
                                words(answer.ranking[flip.behind]), words(answer.ranking[flip.before])));
  }
  return fmt::format("The order depends on whose fault contacts are: {}.", list_words(pairs));
}

// Whether these tasks can tell the combinations apart; "" where too few tasks were met.
std::string tasks_line(const Answer& answer) {
  if (answer.pairs.pairs == 0) return "";
  double mean = 0.0;
  for (const RankedCombination& one : answer.ranking) mean += one.means[0] / static_cast<double>(answer.ranking.size());
  if (mean < least_mean_share || mean > most_mean_share)
    return fmt::format("The tasks are too {} to tell combinations apart by {}: its mean is {:.2f}.",
                       mean < least_mean_share ? "hard" : "easy", answer.criteria.front().name, mean);
  if (answer.pairs.pairs == 1) return "";  // the line about the first tells
  return fmt::format("The tasks tell {} of {} pairs of combinations apart.", answer.pairs.apart, answer.pairs.pairs);
}

// With n pairs no p is below 2^(1 - n), and Holm multiplies the least one by the number of tests.
std::uint64_t least_observations(const Answer& answer) {
  double tests = 0.0;
  for (const RankedCombination& one : answer.ranking)
    for (const AgainstFirst& against : one.against)
      if (!std::isnan(against.p)) tests += 1.0;
  return tests == 0.0 ? 0 : static_cast<std::uint64_t>(std::floor(std::log2(tests / significant) + 1.0)) + 1;
}

}  // namespace

std::string combination_name(const RankedCombination& one) {
  return one.global_planner + " + " + one.local_controller;
}

std::string difference_words(const Answer& answer, const RankedCombination& one, std::size_t criterion) {
  const double mean = one.against[criterion].mean;
  const bool below = mean < 0.0;
  return answer.criteria[criterion].share
             ? fmt::format("{} {:.2f} {}", answer.criteria[criterion].name, std::fabs(mean), below ? "lower" : "higher")
             : fmt::format("{:.2f} s/m {}", std::fabs(mean), below ? "faster" : "slower");
}

std::string answer_heading(const Answer& answer) {
  const std::string seeds = observed(answer, answer.observations);
  if (answer.in_general) return fmt::format("In general, over {}", seeds);
  if (!answer.tasks_known) return fmt::format("Under these {}", seeds);
  if (answer.tasks == 1) return fmt::format("On this task, over {}", seeds);
  return fmt::format("On these {} tasks, over {}", answer.tasks, seeds);
}

std::vector<std::string> answer_lines(const Answer& answer, std::span<const CombinationFailures> failures) {
  std::vector<std::string> lines = {best_line(answer)};
  if (const auto worse = with_standing(answer, Standing::worse); !worse.empty()) {
    lines.push_back(worse_line(answer));
    if (const std::string causes = cause_line(answer, *worse.back(), failures); !causes.empty())
      lines.push_back(causes);
  }
  if (!answer.flips.empty()) lines.push_back(flip_line(answer));
  if (const std::string tasks = tasks_line(answer); !tasks.empty()) lines.push_back(tasks);
  if (const std::uint64_t least = least_observations(answer); answer.observations < least)
    lines.push_back(fmt::format("{} cannot tell so many combinations apart: it takes at least {}.",
                                observed(answer, answer.observations), least));
  if (answer.needed)
    lines.push_back(fmt::format("A difference of 5 points in {} would show with about {} (from how the pairs deviate).",
                                answer.criteria.front().name, observed(answer, *answer.needed)));
  return lines;
}

}  // namespace dmrp::host
