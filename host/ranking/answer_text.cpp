// SPDX-License-Identifier: MIT
#include "host/ranking/answer_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace dmrp::host {
namespace {

constexpr std::size_t most_names = 3;  // in one sentence

std::string counted(std::uint64_t count, const std::string& noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string value_words(const Criterion& criterion, double value) {
  return criterion.share()                          ? fmt::format("{} {:.2f}", criterion.name, value)
         : criterion.kind == Criterion::Kind::delay ? fmt::format("{} {:.2f} s", criterion.name, value)
                                                    : fmt::format("{:.2f} s per metre of shortest path", value);
}

// "safe success 0.91 [0.83, 0.96], 1.20 s per metre of shortest path"
std::string means_words(const Answer& answer, const RankedCombination& one) {
  std::string words;
  for (std::size_t i = 0; i < answer.criteria.size(); ++i) {
    if (std::isnan(one.means[i])) continue;
    words += (words.empty() ? "" : ", ") + value_words(answer.criteria[i], one.means[i]);
    if (answer.criteria[i].share() && !std::isnan(one.intervals[i].low))
      words += fmt::format(" [{:.2f}, {:.2f}]", one.intervals[i].low, one.intervals[i].high);
  }
  return words;
}

// "DWA 0.11 [0.05, 0.17] below the others"; of two levels "TEB 0.11 [0.05, 0.17] above DWA".
std::string effect_words(const FactorEffects& factor, std::size_t level) {
  const core::LevelEffect& effect = factor.effects[level];
  const bool below = effect.mean < 0.0;
  const double low = below ? -effect.interval.high : effect.interval.low;
  const double high = below ? -effect.interval.low : effect.interval.high;
  return fmt::format("{} {:.2f} [{:.2f}, {:.2f}] {} {}", factor.levels[level], std::fabs(effect.mean), low, high,
                     below ? "below" : "above", factor.levels.size() == 2 ? factor.levels[1 - level] : "the others");
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

bool is_equal_to_first(const RankedCombination& one) {
  return std::all_of(one.against.begin(), one.against.end(),
                     [](const auto& against) { return against.over_tasks.n > 0 && against.equal; });
}

// With the planners that did the same in every trial.
std::string shown_name(const RankedCombination& one) {
  return one.same_as.empty()
             ? combination_name(one)
             : fmt::format("{} (and {}, the same in every trial)", combination_name(one), list_words(one.same_as));
}

std::vector<std::string> names_of(const Answer& answer, bool (*holds)(const RankedCombination&)) {
  std::vector<std::string> names;
  for (const RankedCombination& one : answer.ranking)
    if (holds(one)) names.push_back(shown_name(one));
  return names;
}

bool may_be_best(const RankedCombination& one) {
  return one.standing != Standing::worse;
}

// "Controllers, each with all 4 planners: in safe success, DWA 0.11 [0.05, 0.17] below the others."
std::string factor_line(const Answer& answer, const FactorEffects& factor) {
  const std::string heading =
      fmt::format("{}{}s, each with {} {}s: ", static_cast<char>(std::toupper(*factor.factor)), factor.factor + 1,
                  factor.others == 2 ? "both" : fmt::format("all {}", factor.others), factor.other);
  const std::string& by = answer.criteria.front().name;
  const auto& effects = factor.effects;
  const auto largest = static_cast<std::size_t>(
      std::max_element(effects.begin(), effects.end(),
                       [](const auto& a, const auto& b) { return std::fabs(a.mean) < std::fabs(b.mean); }) -
      effects.begin());
  std::vector<std::string> words;
  for (std::size_t i = 0; i < effects.size(); ++i) {
    const bool repeats = effects.size() == 2 && effects[i].mean < 0.0;  // two levels differ from each other alone
    if (!repeats && (effects[i].interval.low > 0.0 || effects[i].interval.high < 0.0))
      words.push_back(effect_words(factor, i));
  }
  if (!words.empty()) return fmt::format("{}in {}, {}.", heading, by, list_words(words));
  if (effects[largest].mean == 0.0) return heading + "the same " + by + " in every trial.";
  return fmt::format("{}no significant difference in {} (the largest: {}).", heading, by,
                     effect_words(factor, largest));
}

// "A difference of 5 points in safe success"
std::string tolerated_words(const Answer& answer) {
  return fmt::format("a difference of 5 points in {}", answer.criteria.front().name);
}

// Where plans are compared on one task, twenty crowds meet one plan of each.
std::string one_task_words(const Answer& answer) {
  const bool one_planner = std::all_of(answer.ranking.begin(), answer.ranking.end(), [&](const RankedCombination& one) {
    return one.global_planner == answer.ranking.front().global_planner;
  });
  return answer.met.tasks == 1 && !one_planner ? " These trials cannot compare planners: all have the same task." : "";
}

std::string best_line(const Answer& answer) {
  const RankedCombination& first = answer.ranking.front();
  const std::string means = means_words(answer, first);
  const std::string unit = observation_name(answer.met);
  const std::string leads = fmt::format("Best so far: {}: {}.", shown_name(first), means);
  if (answer.n < fewest_observations)
    return fmt::format("{} {} too few to rank anything. {}", counted(answer.n, unit), answer.n == 1 ? "is" : "are",
                       leads);
  const std::vector<std::string> best = names_of(answer, may_be_best);
  if (best.size() == 1) return fmt::format("With 95 % confidence {} is the best of these: {}.", best.front(), means);
  if (best.size() < answer.ranking.size())
    return fmt::format("With 95 % confidence the best of these is among {}. {}", list_words(best), leads);
  if (std::all_of(answer.ranking.begin(), answer.ranking.end(), is_equal_to_first))
    return fmt::format("All {} are equal in every trial: {}.", best.size(), means);
  const auto needed = observations_needed(answer, tolerated_share);
  const std::string more =
      needed ? fmt::format(" For {} about {} are needed.", tolerated_words(answer), counted(*needed, unit)) : "";
  return fmt::format("{} exclude none of the {}.{} {}", counted(answer.n, unit), best.size(), more, leads);
}

// Over worlds, where there are enough of them for a claim about others.
std::string general_line(const Answer& answer) {
  const auto best = names_of(answer, [](const RankedCombination& one) { return one.best_in_general; });
  return fmt::format("In general, with each of {} as one observation, it is among {}.", counted(answer.worlds, "world"),
                     list_words(best));
}

// The last of the order first.
std::string worse_line(const Answer& answer) {
  std::vector<std::string> names;
  for (auto one = answer.ranking.rbegin(); one != answer.ranking.rend(); ++one)
    if (!may_be_best(*one))
      names.push_back(fmt::format("{} ({})", combination_name(*one), difference_words(answer, *one, *one->decided)));
  return names.empty() ? "" : "Not the best: " + list_words(names) + ".";
}

// Who may be the best with each kind of people, where that differs: in how they notice robots, for example.
std::string people_line(const Answer& answer) {
  const auto& all = answer.with_people;
  if (std::all_of(all.begin(), all.end(), [&](const auto& one) { return one.best == all.front().best; })) return "";
  std::vector<std::string> words;
  for (const Answer::WithPeople& one : all)
    words.push_back(fmt::format("with {} it is among {}",
                                one.pedestrian_model.empty() ? "no people" : one.pedestrian_model,
                                list_words(one.best)));
  return fmt::format("It depends on the people: {}.", fmt::join(words, "; "));
}

// The combinations that no other beats in everything, where people or safety have a price.
std::string pareto_line(const Answer& answer) {
  const auto names = names_of(answer, [](const RankedCombination& one) { return one.pareto; });
  std::vector<std::string> criteria;
  for (const Criterion& criterion : answer.criteria) criteria.push_back(criterion.name);
  return names.size() < 2 || criteria.size() < 2
             ? ""
             : fmt::format("In {}, none is beaten by another in all of: {}.", list_words(criteria), list_words(names));
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
    for (const FailureCause& cause : other.causes)
      if (!is_exclusion(cause.cause)) add_cause(causes, cause);
    FailureCause contact = other.contact;
    contact.cause = "after a contact at fault";
    add_cause(causes, contact);
  }
  std::uint32_t unsafe = 0;
  for (const FailureCause& cause : causes) unsafe += cause.robots;
  return unsafe == 0 ? ""
                     : fmt::format("Of the {} of {}, {} did not arrive safely: {}.", counted(robots, "robot"),
                                   combination_name(one), unsafe, cause_words(causes));
}

// Pairs of combinations whose order in safety a sibling of it turns round.
std::string flip_line(const Answer& answer) {
  const std::string& safe = answer.criteria[answer.safe].name;
  std::vector<std::string> pairs;
  for (const OrderFlip& flip : answer.flips) {
    const auto words = [&](const RankedCombination& one) {
      return fmt::format("{} ({:.2f}; {} {:.2f})", combination_name(one), one.sibling_means[flip.sibling], safe,
                         one.means[answer.safe]);
    };
    pairs.push_back(fmt::format("by {}, {} is before {}", answer.siblings[flip.sibling].name,
                                words(answer.ranking[flip.behind]), words(answer.ranking[flip.before])));
  }
  return fmt::format("The order depends on whose fault contacts are: {}.", list_words(pairs));
}

}  // namespace

std::string difference_words(const Answer& answer, const RankedCombination& one, std::size_t criterion) {
  const Criterion& by = answer.criteria[criterion];
  const double mean = one.against[criterion].over_tasks.mean;
  const bool below = mean < 0.0;
  if (by.kind == Criterion::Kind::time)
    return fmt::format("{:.2f} s/m {}", std::fabs(mean), below ? "faster" : "slower");
  return fmt::format("{} {:.2f}{} {}", by.name, std::fabs(mean), by.share() ? "" : " s", below ? "lower" : "higher");
}

std::string answer_heading(const Answer& answer) {
  std::string words = met_words(answer.met);
  words.front() = static_cast<char>(std::toupper(words.front()));
  if (answer.met.tasks == 1) return words + " (the same starts and goals in every trial)";
  return words + (answer.worlds == 1 ? " in this world" : fmt::format(" in these {} worlds", answer.worlds));
}

std::vector<std::string> answer_lines(const Answer& answer, std::span<const CombinationFailures> failures) {
  std::vector<std::string> lines;
  const auto add = [&](std::string line) {
    if (!line.empty()) lines.push_back(std::move(line));
  };
  add(best_line(answer) + one_task_words(answer));
  for (const FactorEffects& factor : answer.factors) add(factor_line(answer, factor));
  if (answer.in_general) add(general_line(answer));
  add(people_line(answer));
  add(worse_line(answer));
  const auto worse = std::find_if(answer.ranking.rbegin(), answer.ranking.rend(),
                                  [](const RankedCombination& one) { return !may_be_best(one); });
  if (worse != answer.ranking.rend()) add(cause_line(answer, *worse, failures));
  add(pareto_line(answer));
  if (!answer.flips.empty()) add(flip_line(answer));
  const bool all_may = std::all_of(answer.ranking.begin(), answer.ranking.end(), may_be_best);
  if (const auto needed = observations_needed(answer, tolerated_share); needed && !all_may)
    add(fmt::format("For {} about {} are needed.", tolerated_words(answer),
                    counted(*needed, observation_name(answer.met))));
  return lines;
}

}  // namespace dmrp::host
