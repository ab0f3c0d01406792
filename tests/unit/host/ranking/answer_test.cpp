// SPDX-License-Identifier: MIT
#include "host/ranking/answer.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "host/ranking/answer_text.hpp"
#include "tests/unit/host/ranking/ranking_example.hpp"

namespace answer_test {

using namespace dmrp::host;
using namespace dmrp::test;
using Catch::Matchers::Contains;

const std::vector<RobotResult> both_arrive{{20.0, true, 10.0}, {40.0, true, 20.0}};
const std::vector<RobotResult> one_fails{{20.0, true, 10.0}, {std::nullopt, true, 20.0}};
const std::vector<RobotResult> one_touches{{20.0, true, 10.0}, {40.0, false, 20.0}};

MakeRobots always(const std::vector<RobotResult>& robots) {
  return [robots](std::uint32_t) { return robots; };
}

// Arrive after `s_per_m` for each metre of their ways.
MakeRobots with_pace(double s_per_m) {
  return [=](std::uint32_t i) {
    const double noise = 0.01 * (i % 3);
    return std::vector<RobotResult>{{(s_per_m + noise) * 10.0, true, 10.0}, {(s_per_m + noise) * 20.0, true, 20.0}};
  };
}

// The trials in other worlds: world k has the tasks of repetitions k, k + worlds, ...
void spread_over_worlds(std::vector<TrialRecord>& trials, std::uint32_t worlds) {
  for (TrialRecord& trial : trials) trial.scenario = "world " + std::to_string(trial.repetition % worlds);
}

std::vector<Answer> answers_of(const std::vector<TrialRecord>& trials) {
  return answers(ranking_layout(), ranking_metrics(), trials);
}

Answer answer_of(const std::vector<TrialRecord>& trials) {
  const auto found = answers_of(trials);
  REQUIRE(found.size() == 1);
  return found.front();
}

std::vector<std::string> lines_of(const std::vector<TrialRecord>& trials) {
  return answer_lines(answer_of(trials), failure_causes(ranking_layout(), trials));
}

std::vector<std::string> lines_of_first(const std::vector<TrialRecord>& trials) {
  return answer_lines(answers_of(trials).front(), failure_causes(ranking_layout(), trials));
}

std::vector<std::string> order_of(const Answer& answer) {
  std::vector<std::string> names;
  for (const RankedCombination& one : answer.ranking) names.push_back(one.local_controller);
  return names;
}

using Names = std::vector<std::string>;

TEST_CASE("safety comes before time", "[ranking]") {
  std::vector<TrialRecord> trials;
  add_trials(trials, "fast but unsafe", 20, [](std::uint32_t) {
    return std::vector<RobotResult>{{5.0, false, 10.0}, {5.0, true, 20.0}};
  });
  add_trials(trials, "slow", 20, with_pace(3.0));
  add_trials(trials, "fails", 20, always(one_fails));
  add_trials(trials, "good", 20, with_pace(2.0));
  const Answer answer = answer_of(trials);
  CHECK(order_of(answer) == Names{"good", "slow", "fast but unsafe", "fails"});
  for (std::size_t i = 1; i < 4; ++i) CHECK(answer.ranking[i].standing == Standing::worse);
  REQUIRE(answer.criteria.size() == 2);
  CHECK(answer.ranking[1].decided == 1u);
  CHECK(answer.ranking[1].against[1].over_tasks.mean == Approx(1.0));  // s/m
  CHECK(answer.ranking[2].decided == 0u);
  CHECK(answer.ranking[2].against[0].over_tasks.mean == Approx(-0.5));
  CHECK_THAT(answer_lines(answer, {}).front(),
             Contains("With 95 % confidence P + good is the best of these: safe 1.00 ["));
}

TEST_CASE("the time of each robot counts relative to its own shortest way", "[ranking]") {
  // a: the short way takes 1 s/m longer; b: the long one does. In seconds b is slower, relative to the ways it is equal.
  std::vector<TrialRecord> trials;
  add_trials(trials, "a", 12, always({{30.0, true, 10.0}, {200.0, true, 100.0}}));
  add_trials(trials, "b", 12, always({{20.0, true, 10.0}, {300.0, true, 100.0}}));
  const Answer answer = answer_of(trials);
  CHECK(answer.ranking[0].means[1] == Approx(2.5));
  CHECK(answer.ranking[1].means[1] == Approx(2.5));
  CHECK(answer.ranking[1].standing == Standing::may_be_best);
}

TEST_CASE("two labels for one controller are the same", "[ranking]") {
  std::vector<TrialRecord> trials;
  add_trials(trials, "one", 20, with_pace(2.0));
  add_trials(trials, "two", 20, with_pace(2.0));
  const Answer answer = answer_of(trials);
  CHECK(order_of(answer) == Names{"one", "two"});
  CHECK(answer.ranking[1].standing == Standing::may_be_best);
  CHECK_FALSE(observations_needed(answer, 0.05));  // nothing deviates
  CHECK_THAT(answer_lines(answer, {}).front(), Contains("All 2 are equal in every trial: safe "));
}

TEST_CASE("fewer than five observations are too few to rank, and say so", "[ranking]") {
  std::vector<TrialRecord> trials;
  add_trials(trials, "good", 4, always(both_arrive));
  add_trials(trials, "fails", 4, always(one_fails));
  const Answer answer = answer_of(trials);
  CHECK(order_of(answer) == Names{"good", "fails"});
  CHECK(answer.ranking[1].standing == Standing::may_be_best);
  CHECK(std::isnan(answer.ranking[1].against[0].p));
  CHECK_FALSE(observations_needed(answer, 0.05));  // below ten
  CHECK_THAT(answer_lines(answer, {}).front(), Contains("are too few to rank anything."));
}

TEST_CASE("a rare failure does not make a combination worse", "[ranking]") {
  std::vector<TrialRecord> trials;
  add_trials(trials, "good", 20, always(both_arrive));
  add_trials(trials, "nearly", 20, [](std::uint32_t i) { return i == 3 ? one_fails : both_arrive; });
  const Answer answer = answer_of(trials);
  CHECK(order_of(answer) == Names{"good", "nearly"});
  CHECK(answer.ranking[1].standing == Standing::may_be_best);
  // sd of nineteen 0 and one -0.5: 0.1118, at a level of 0.05 / 2:
  // ((2.241 + 0.842) * 0.1118 / 0.05)^2 + 2.241^2 / 2 = 50.0
  CHECK(observations_needed(answer, 0.05).value() == 51);
  CHECK(observations_needed(answer, 0.1).value() < 20);
  CHECK_THAT(lines_of(trials).front(),
             Contains("20 tasks exclude none of the 2. For a difference of 5 points in safe about 51 tasks are needed. "
                      "Best so far: P + good: "));
}

TEST_CASE("who is faster but not as safe is not the better", "[ranking]") {
  std::vector<TrialRecord> trials;
  add_trials(trials, "safe", 20, with_pace(3.0));
  add_trials(trials, "fast", 20, [](std::uint32_t i) {
    auto robots = with_pace(2.0)(i);
    robots[0].safe = i != 0;
    return robots;
  });
  const Answer answer = answer_of(trials);
  CHECK(order_of(answer) == Names{"safe", "fast"});
  for (const RankedCombination& one : answer.ranking) {
    CHECK(one.standing != Standing::worse);  // 20 tasks do not show that it is not inferior by 5 points
    CHECK(one.pareto);
  }
  CHECK_THAT(lines_of(trials), Catch::VectorContains(std::string(
                                   "In safe and time, none is beaten by another in all of: P + safe and P + fast.")));
}

TEST_CASE("swapped labels swap the answer", "[ranking]") {
  std::vector<TrialRecord> trials;
  add_trials(trials, "A", 20, always(both_arrive));
  add_trials(trials, "B", 20, always(one_touches));
  const auto lines = lines_of(trials);
  for (TrialRecord& trial : trials) trial.local_controller = trial.local_controller == "A" ? "B" : "A";
  const auto swapped = lines_of(trials);
  CHECK_THAT(lines[0], Contains("P + A is the best"));
  CHECK_THAT(lines[1], Contains("Not the best: P + B (safe 0.50 lower)"));
  CHECK_THAT(swapped[0], Contains("P + B is the best"));
  CHECK_THAT(swapped[1], Contains("Not the best: P + A (safe 0.50 lower)"));
  CHECK_THAT(lines[2], Contains("Of the 40 robots of P + B, 20 did not arrive safely: 20 after a contact at fault."));
  CHECK_THAT(swapped[2], Contains("Of the 40 robots of P + A, 20"));
}

TEST_CASE("tasks are the observations, not the crowds that meet them", "[ranking]") {
  std::vector<TrialRecord> trials;
  add_trials(trials, "a", 20, with_pace(2.0));
  add_trials(trials, "b", 20, with_pace(2.5));
  SECTION("a task each") {
    CHECK(answer_heading(answer_of(trials)) == "20 drawn tasks in this world");
    CHECK(answer_of(trials).ranking[1].standing == Standing::worse);
  }
  SECTION("five tasks under four seeds each are five observations") {
    for (TrialRecord& trial : trials) trial.task = std::to_string(trial.repetition % 5);
    const Answer answer = answer_of(trials);
    CHECK(answer_heading(answer) == "5 drawn tasks x 4 crowds in this world");
    CHECK(answer.ranking[1].against[1].over_tasks.n == 5);
    CHECK(answer.ranking[1].standing == Standing::may_be_best);  // 2^-4
  }
  SECTION("listed tasks are met by crowds, which say nothing of planners") {
    for (TrialRecord& trial : trials) {
      trial.task = "listed";
      trial.task_is_drawn = false;
    }
    CHECK(answer_heading(answer_of(trials)) == "One task, 20 crowds (the same starts and goals in every trial)");
    CHECK(answer_of(trials).n == 20);
    CHECK_THAT(lines_of(trials).front(), Contains("With 95 % confidence P + a is the best"));
    for (TrialRecord& trial : trials)
      if (trial.local_controller == "b") trial.global_planner = "Q";
    CHECK_THAT(lines_of(trials).front(),
               Catch::Matchers::EndsWith(". These trials cannot compare planners: all have the same task."));
  }
  SECTION("a world is one task where its tasks are not known") {
    for (TrialRecord& trial : trials) {
      trial.task.clear();
      trial.task_is_drawn = false;
      std::erase_if(trial.values, [](const MetricValue& value) { return value.metric == "way"; });
    }
    const Answer answer = answer_of(trials);
    CHECK(answer_heading(answer) == "One task, 20 crowds (the same starts and goals in every trial)");
    CHECK(answer.criteria.size() == 1);  // no time without ways
  }
  SECTION("a trial that ended in a fault has the task of its seed") {
    trials[3].task.clear();
    CHECK(answer_of(trials).n == 20);
  }
  SECTION("numbers of robots that share a seed are parts of its task") {
    for (std::size_t i = 0; i < 40; ++i) {
      trials.push_back(trials[i]);
      trials.back().robots = 1;
      trials.back().task = "alone " + std::to_string(trials[i].repetition);
    }
    const auto found = answers_of(trials);
    REQUIRE(found.size() == 3);
    CHECK(found.front().n == 20);
  }
}

TEST_CASE("where entries are a product, each factor has its effect", "[ranking]") {
  std::vector<TrialRecord> trials;
  for (const char* planner : {"P", "Q"})
    for (const char* controller : {"good", "fine", "bad"})
      for (std::uint32_t i = 0; i < 20; ++i) {
        const bool fails = *controller == 'b' && i % 3 == 0;
        trials.push_back(ranking_trial(planner, controller, i, fails ? one_fails : both_arrive));
        trials.back().plan_sha256 = planner;
      }
  const Answer answer = answer_of(trials);
  REQUIRE(answer.factors.size() == 2);
  CHECK(std::string(answer.factors[0].factor) == "controller");
  CHECK(answer.factors[0].levels == Names{"good", "fine", "bad"});
  CHECK(answer.factors[0].effects[2].mean == Approx(-7.0 / 20.0 * 0.5));
  CHECK_THAT(lines_of(trials)[1], Contains("Controllers, each with both planners: in safe, good 0.09 [") &&
                                      Contains("bad 0.17 [") && Contains("] below the others."));
  CHECK(lines_of(trials)[2] == "Planners, each with all 3 controllers: the same safe in every trial.");

  SECTION("two levels differ from each other") {
    std::erase_if(trials, [](const TrialRecord& one) { return one.local_controller == "fine"; });
    CHECK_THAT(lines_of(trials)[1], Contains("in safe, good 0.17 [") && Catch::Matchers::EndsWith("] above bad."));
  }
  SECTION("and planners whose trials are the same are one entry") {
    for (TrialRecord& trial : trials) trial.plan_sha256 = "the same";
    CHECK(answer_of(trials).ranking.size() == 3);
    CHECK(answer_of(trials).ranking[0].same_as == Names{"Q"});
    CHECK_THAT(lines_of(trials)[0], Contains("P + good (and Q, the same in every trial)"));
  }
  SECTION("but not where a combination is missing") {
    std::erase_if(trials,
                  [](const TrialRecord& one) { return one.global_planner == "Q" && one.local_controller == "bad"; });
    CHECK(answer_of(trials).factors.empty());
  }
}

TEST_CASE("five worlds allow a statement in general, with each as one observation", "[ranking]") {
  std::vector<TrialRecord> trials;
  add_trials(trials, "a", 40, with_pace(2.0));
  add_trials(trials, "b", 40, with_pace(2.5));
  for (const std::uint32_t worlds : {4u, 8u}) {
    spread_over_worlds(trials, worlds);
    const Answer answer = answers_of(trials).front();
    CHECK(answer_heading(answer) == "40 drawn tasks in these " + std::to_string(worlds) + " worlds");
    CHECK(answer.in_general == (worlds >= 5));
    const std::vector<std::string> lines = answer_lines(answer, {});
    CHECK(std::any_of(lines.begin(), lines.end(), [](const std::string& line) {
            return line == "In general, with each of 8 worlds as one observation, it is among P + a.";
          }) == (worlds == 8));
  }
}

TEST_CASE("people who lose time count before the robots' time", "[ranking]") {
  // the same crowd without robots walks 1 m a second; with a in the way it loses 4 m of 40, with b none
  std::vector<TrialRecord> trials;
  add_trials(trials, "a", 20, with_pace(2.0));
  add_trials(trials, "b", 20, with_pace(3.0));
  for (std::uint32_t i = 0; i < 20; ++i) {
    TrialRecord& alone = trials.emplace_back(ranking_trial("", "", i, both_arrive));
    alone.robots = 0;
    alone.values = {{"desired", DMRP_SUBJECT_SYSTEM, std::nullopt, std::nullopt, 1.0}};
  }
  for (TrialRecord& trial : trials)
    for (int t = 0; t <= 40; ++t)
      trial.values.push_back({"progress", DMRP_SUBJECT_SYSTEM, std::nullopt, t,
                              (trial.local_controller == "a" ? 0.9 - 0.001 * (trial.repetition % 3) : 1.0) * t});
  const Answer answer = answer_of(trials);
  REQUIRE(answer.criteria.size() == 3);
  CHECK(answer.criteria[1].name == "people's delay");
  CHECK(order_of(answer) == Names{"b", "a"});
  CHECK(answer.ranking[1].standing == Standing::worse);
  CHECK(answer.ranking[1].decided == 1u);
  CHECK(answer.ranking[1].means[1] == Approx(4.0).margin(0.1));
  CHECK_THAT(lines_of(trials),
             Catch::VectorContains(std::string("Not the best: P + a (people's delay 4.04 s higher).")));
}

TEST_CASE("several scenarios have an answer each, and one together", "[ranking]") {
  std::vector<TrialRecord> trials;
  add_trials(trials, "a", 10, always(both_arrive));
  add_trials(trials, "b", 10, always(one_fails));
  std::vector<TrialRecord> office = trials;
  for (TrialRecord& trial : office) {
    trial.scenario = "office";
    trial.local_controller = trial.local_controller == "a" ? "b" : "a";  // the other one fails here
  }
  trials.insert(trials.end(), office.begin(), office.end());
  const auto found = answers_of(trials);
  REQUIRE(found.size() == 3);
  CHECK(answer_heading(found[0]) == "20 drawn tasks in these 2 worlds");
  CHECK(found[0].ranking[1].standing == Standing::may_be_best);
  CHECK(order_of(found[1]) == Names{"a", "b"});
  CHECK(order_of(found[2]) == Names{"b", "a"});

  SECTION("only of combinations that ran in all of them") {
    std::vector<TrialRecord> alone;
    add_trials(alone, "only in the mall", 10, always(both_arrive));
    trials.insert(trials.end(), alone.begin(), alone.end());
    CHECK(answers_of(trials)[0].ranking.size() == 2);
    CHECK(answers_of(trials)[1].ranking.size() == 3);
  }
}

TEST_CASE("the answer says where it depends on the people", "[ranking]") {
  std::vector<TrialRecord> trials;
  add_trials(trials, "a", 20, always(both_arrive));
  add_trials(trials, "b", 20, always(one_fails));
  const std::size_t count = trials.size();
  for (std::size_t i = 0; i < count; ++i) {
    trials.push_back(trials[i]);
    trials.back().pedestrian_model = "blind crowd";
  }
  for (const std::string& line : lines_of_first(trials)) CHECK_THAT(line, !Contains("people"));
  for (std::size_t i = count; i < trials.size(); ++i)
    trials[i].local_controller = trials[i].local_controller == "a" ? "b" : "a";
  CHECK_THAT(lines_of_first(trials),
             Catch::VectorContains(std::string(
                 "It depends on the people: with blind crowd it is among P + b; with crowd it is among P + a.")));
  for (std::size_t i = count; i < trials.size(); ++i) trials[i].pedestrian_model.clear();
  CHECK_THAT(lines_of_first(trials),
             Catch::VectorContains(std::string(
                 "It depends on the people: with no people it is among P + b; with crowd it is among P + a.")));
}

TEST_CASE("a trial that ended in a fault counts as a failure", "[ranking]") {
  std::vector<TrialRecord> trials;
  add_trials(trials, "good", 10, always(both_arrive));
  add_trials(trials, "crashes", 10, always(both_arrive));
  for (TrialRecord& trial : trials)
    if (trial.local_controller == "crashes") {
      trial.outcome = trial_outcome::fault;
      trial.values.clear();
    }
  const Answer answer = answer_of(trials);
  CHECK(order_of(answer) == Names{"good", "crashes"});
  CHECK(answer.ranking[1].means[0] == 0.0);
  CHECK(answer.ranking[1].standing == Standing::worse);
}

TEST_CASE("one combination needs no answer", "[ranking]") {
  std::vector<TrialRecord> trials;
  add_trials(trials, "alone", 5, always(both_arrive));
  CHECK(answers_of(trials).empty());
  CHECK(answers_of({}).empty());
}

TEST_CASE("the numbers of people of a sweep have the same tasks", "[ranking]") {
  std::vector<TrialRecord> trials;
  for (const char* people : {"6", "12"}) {
    const std::size_t first = trials.size();
    add_trials(trials, "fast", 6, with_pace(2.0));
    add_trials(trials, "slow", 6, with_pace(3.0));
    for (std::size_t i = first; i < trials.size(); ++i) {
      trials[i].swept = {{"", "people", people}};
      trials[i].scenario = with_swept(trials[i].scenario, trials[i].swept);
    }
  }
  const std::vector<Answer> found = answers_of(trials);
  REQUIRE(found.size() == 3);  // over both, and for each
  CHECK(found[0].cells.size() == 2);
  CHECK(found[0].n == 6);
}

TEST_CASE("orders that a sibling of the safe share turns round are flagged", "[ranking]") {
  const std::vector<RobotResult> one_is_touched{{20.0, true, 10.0, true}, {40.0, true, 20.0}};
  const auto first = [](std::uint32_t count, const std::vector<RobotResult>& robots) {
    return [=](std::uint32_t i) { return i < count ? robots : both_arrive; };
  };
  std::vector<TrialRecord> trials;
  add_trials(trials, "touched", 20, first(10, one_is_touched));  // safe 1, untouched .75
  add_trials(trials, "unsafe", 20, first(4, one_touches));       // safe .9, untouched .9
  add_trials(trials, "worst", 20, first(16, one_fails));         // safe .6, untouched .6
  const Answer answer = answer_of(trials);
  REQUIRE(order_of(answer) == Names{"touched", "unsafe", "worst"});
  REQUIRE(answer.flips.size() == 1);
  CHECK(answer.flips[0].before == 0);
  CHECK(answer.flips[0].behind == 1);
  CHECK_THAT(lines_of(trials), Catch::VectorContains(std::string(
                                   "The order depends on whose fault contacts are: by untouched done, P + unsafe "
                                   "(0.90; safe 0.90) is before P + touched (0.75; safe 1.00).")));

  SECTION("not where the order stays, or the values are equal") {
    trials.clear();
    add_trials(trials, "touched", 20, first(4, one_is_touched));  // safe 1, untouched .9
    add_trials(trials, "unsafe", 20, first(4, one_touches));      // both .9
    add_trials(trials, "worst", 20, first(16, one_fails));
    CHECK(answer_of(trials).flips.empty());
    for (const std::string& line : lines_of(trials)) CHECK_THAT(line, !Contains("whose fault"));
  }
  SECTION("each sibling by itself") {
    const std::vector<RobotResult> one_is_excused{{20.0, false, 10.0, true, true}, {40.0, true, 20.0}};
    add_trials(trials, "excused", 20, first(16, one_is_excused));  // safe .6, excused 1
    CHECK_THAT(lines_of(trials),
               Catch::VectorContains(
                   std::string("The order depends on whose fault contacts are: by untouched done, P + unsafe "
                               "(0.90; safe 0.90) is before P + touched (0.75; safe 1.00) and by excused done, P + "
                               "excused (1.00; safe 0.60) is before P + unsafe (0.90; safe 0.90).")));
  }
  SECTION("also where another share comes before it") {
    SummaryLayout layout = ranking_layout();
    layout.answer.shares = {"done", "safe"};
    layout.answer.names = {{"done", "arrivals by time"}};
    const std::vector<Answer> all = answers(layout, ranking_metrics(), trials);
    REQUIRE(all.front().criteria.size() == 3);
    CHECK(all.front().criteria[0].name == "arrivals by time");
    CHECK(all.front().criteria[1].name == "safe");
    CHECK(all.front().safe == 1);
    REQUIRE(all.front().flips.size() == 1);
    const OrderFlip& flip = all.front().flips.front();
    CHECK(all.front().ranking[flip.before].local_controller == "touched");
    CHECK(all.front().ranking[flip.behind].local_controller == "unsafe");
  }
  SECTION("nor where the sibling was not measured") {
    std::vector<MetricColumn> metrics = ranking_metrics();
    metrics.erase(metrics.begin() + 1);
    CHECK(answers(ranking_layout(), metrics, trials).front().flips.empty());
  }
}

}  // namespace answer_test
