// SPDX-License-Identifier: MIT
#include "host/ranking/best_marks.hpp"

#include <catch2/catch.hpp>

#include "tests/unit/host/ranking/ranking_example.hpp"

namespace best_marks_test {

using namespace dmrp::host;
using namespace dmrp::test;

// A controller's trials with this length, give or take.
void add_lengths(std::vector<TrialRecord>& trials, const std::string& controller, double length_m, double spread_m,
                 std::optional<std::uint32_t> failing = {}) {
  for (std::uint32_t i = 0; i < 10; ++i) {
    const double length = length_m + spread_m * (i % 2 == 0 ? 1.0 : -1.0);
    const RobotResult second = i == failing ? RobotResult{std::nullopt, true, 10.0} : RobotResult{};
    trials.push_back(ranking_trial("P", controller, i, {{}, second}, length, length));
  }
}

std::vector<std::string> marks_of(const std::vector<TrialRecord>& trials,
                                  Contestants contestants = Contestants::planners_and_controllers) {
  std::vector<std::string> names;
  for (const BestMark& mark : best_marks(ranking_layout(), ranking_metrics(), trials, contestants))
    names.push_back(mark.metric + " of " + mark.labels.global_planner + " " + mark.labels.local_controller);
  return names;
}

using Names = std::vector<std::string>;

TEST_CASE("the best is marked where it can be told apart from all others", "[ranking]") {
  std::vector<TrialRecord> trials;
  add_lengths(trials, "short", 20.0, 0.5);
  add_lengths(trials, "long", 30.0, 0.2);
  CHECK(marks_of(trials) == Names{"length of P short", "planned of P short"});  // no mark of a wall clock's times

  SECTION("not if the second is as good") {
    add_lengths(trials, "as short", 20.01, 0.6);
    CHECK(marks_of(trials).empty());
  }
  SECTION("values of driving not where success differs, those of plans and of success itself in any case") {
    add_lengths(trials, "fails once", 40.0, 0.1, 4);
    CHECK(marks_of(trials) == Names{"planned of P short"});
  }
  SECTION("swapped labels swap the marks") {
    for (TrialRecord& trial : trials) trial.local_controller = trial.local_controller == "short" ? "long" : "short";
    CHECK(marks_of(trials) == Names{"length of P long", "planned of P long"});
  }
  SECTION("only within a scenario and pedestrian model") {
    for (TrialRecord& trial : trials)
      if (trial.local_controller == "long") trial.pedestrian_model = "others";
    CHECK(marks_of(trials).empty());
  }
}

TEST_CASE("five tasks are too few to mark anything", "[ranking]") {
  std::vector<TrialRecord> trials;
  add_lengths(trials, "short", 20.0, 0.5);
  add_lengths(trials, "long", 30.0, 0.2);
  std::erase_if(trials, [](const TrialRecord& trial) { return trial.repetition >= 5; });
  CHECK(marks_of(trials).empty());
}

TEST_CASE("planners are compared over their controllers", "[ranking]") {
  std::vector<TrialRecord> trials;
  add_lengths(trials, "a", 20.0, 0.5);
  add_lengths(trials, "b", 30.0, 0.5);
  const auto count = trials.size();
  for (std::size_t i = 0; i < count; ++i) {
    TrialRecord other = trials[i];
    other.global_planner = "Q";
    for (MetricValue& value : other.values)
      if (value.metric == "planned") *value.value += 3.0;
    trials.push_back(other);
  }
  CHECK(marks_of(trials, Contestants::planners) == Names{"planned of P "});
}

}  // namespace best_marks_test
