// SPDX-License-Identifier: MIT
#include "host/ranking/answer.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "host/ranking/answer_text.hpp"
#include "tests/unit/host/ranking/ranking_example.hpp"

using namespace dmrp::host;
using namespace dmrp::test;
using Catch::Matchers::Contains;

namespace {

const std::vector<RobotResult> both_arrive{{20.0, true, 10.0}, {40.0, true, 20.0}};
const std::vector<RobotResult> one_fails{{20.0, true, 10.0}, {std::nullopt, true, 20.0}};
const std::vector<RobotResult> one_touches{{20.0, true, 10.0}, {40.0, false, 20.0}};

MakeRobots always(const std::vector<RobotResult>& robots) {
  return [robots](std::uint32_t) { return robots; };
}

// Arrive after `s_per_m` for each metre of their ways, on a task of the repetition's own if `drawn`.
MakeRobots with_pace(double s_per_m, bool drawn = false) {
  return [=](std::uint32_t i) {
    const double way = drawn ? 10.0 + i : 10.0;
    const double noise = 0.01 * (i % 3);
    return std::vector<RobotResult>{{(s_per_m + noise) * way, true, way},
                                    {(s_per_m + noise) * 2.0 * way, true, 2.0 * way}};
  };
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

std::vector<std::string> order_of(const Answer& answer) {
  std::vector<std::string> names;
  for (const RankedCombination& one : answer.ranking) names.push_back(one.local_controller);
  return names;
}

using Names = std::vector<std::string>;

}  // namespace

TEST_CASE("safety comes before success, and success before time", "[ranking]") {
  std::vector<TrialRecord> trials;
  add_trials(trials, "fast but unsafe", 20, [](std::uint32_t) {
    return std::vector<RobotResult>{{5.0, false, 10.0}, {5.0, true, 20.0}};
  });
  add_trials(trials, "slow", 20, with_pace(3.0));
  add_trials(trials, "fails", 20, always(one_fails));
  add_trials(trials, "good", 20, with_pace(2.0));
  const Answer answer = answer_of(trials);
  // the unsafe one and the failing one are equally unsafe; the failing one arrives less often
  CHECK(order_of(answer) == Names{"good", "slow", "fast but unsafe", "fails"});
  for (std::size_t i = 1; i < 4; ++i) CHECK(answer.ranking[i].standing == Standing::worse);
  CHECK(answer.ranking[1].decided == 2u);
  CHECK(answer.ranking[1].against[2].mean == Approx(1.0));  // s/m
  CHECK(answer.ranking[2].decided == 0u);
  CHECK(answer.ranking[2].against[0].mean == Approx(-0.5));
  CHECK_THAT(answer_lines(answer, {}).front(), Contains("Best: P + good"));
}

TEST_CASE("the time of each robot counts relative to its own shortest way", "[ranking]") {
  // a: the short way takes 1 s/m longer; b: the long one does. In seconds b is slower, relative to the ways it is equal.
  std::vector<TrialRecord> trials;
  add_trials(trials, "a", 12, always({{30.0, true, 10.0}, {200.0, true, 100.0}}));
  add_trials(trials, "b", 12, always({{20.0, true, 10.0}, {300.0, true, 100.0}}));
  const Answer answer = answer_of(trials);
  CHECK(answer.ranking[0].means[2] == Approx(2.5));
  CHECK(answer.ranking[1].means[2] == Approx(2.5));
  CHECK(answer.ranking[1].standing == Standing::not_told_apart);
}

TEST_CASE("two labels for one controller are the same", "[ranking]") {
  std::vector<TrialRecord> trials;
  add_trials(trials, "one", 20, with_pace(2.0));
  add_trials(trials, "two", 20, with_pace(2.0));
  const Answer answer = answer_of(trials);
  CHECK(order_of(answer) == Names{"one", "two"});
  CHECK(answer.ranking[1].standing == Standing::not_told_apart);
  CHECK_FALSE(answer.needed);  // nothing deviates
  CHECK_THAT(answer_lines(answer, {}).front(), Contains("Not told apart from it: P + two (the same in every trial)"));
}

TEST_CASE("few trials tell nothing apart, and say how many it takes", "[ranking]") {
  std::vector<TrialRecord> trials;
  add_trials(trials, "good", 4, always(both_arrive));
  add_trials(trials, "fails", 4, always(one_fails));
  const Answer answer = answer_of(trials);
  CHECK(order_of(answer) == Names{"good", "fails"});
  CHECK(answer.ranking[1].standing == Standing::not_told_apart);
  CHECK_FALSE(answer.needed);  // below ten
  // two tests (both shares differ, the time does not): 2 * 2^(1 - n) < 0.05 from n = 7 on
  CHECK_THAT(answer_lines(answer, {}).back(),
             Contains("4 crowd seeds cannot tell so many combinations apart: it takes at least 7."));

  SECTION("as many as that do") {
    std::vector<TrialRecord> more;
    add_trials(more, "good", 7, always(both_arrive));
    add_trials(more, "fails", 7, always(one_fails));
    CHECK(answer_of(more).ranking[1].standing == Standing::worse);
    more.clear();
    add_trials(more, "good", 6, always(both_arrive));
    add_trials(more, "fails", 6, always(one_fails));
    CHECK(answer_of(more).ranking[1].standing == Standing::not_told_apart);
  }
}

TEST_CASE("a rare failure does not make a combination worse", "[ranking]") {
  std::vector<TrialRecord> trials;
  add_trials(trials, "good", 20, always(both_arrive));
  add_trials(trials, "nearly", 20, [](std::uint32_t i) { return i == 3 ? one_fails : both_arrive; });
  const Answer answer = answer_of(trials);
  CHECK(order_of(answer) == Names{"good", "nearly"});
  CHECK(answer.ranking[1].standing == Standing::not_told_apart);
  // sd of nineteen 0 and one -0.5: 0.1118; ((1.960 + 0.842) * 0.1118 / 0.05)^2 + 1.960^2 / 2 = 41.2
  CHECK(answer.needed.value() == 42);
  CHECK_THAT(answer_lines(answer, {}).back(), Contains("5 points in safe would show with about 42 crowd seeds"));
}

TEST_CASE("how many trials a difference needs follows from how the pairs deviate, not from the effect", "[ranking]") {
  const auto needed_with_shift = [](int failures) {
    std::vector<TrialRecord> trials;
    add_trials(trials, "a", 20,
               [=](std::uint32_t i) { return static_cast<int>(i) < failures ? one_fails : both_arrive; });
    add_trials(trials, "b", 20, [](std::uint32_t i) { return i == 19 ? one_fails : both_arrive; });
    return answer_of(trials).needed.value();
  };
  // no effect, deviation 0.1622; an effect of -0.025, deviation 0.1970
  CHECK(needed_with_shift(1) == 85);
  CHECK(needed_with_shift(2) == 124);
}

TEST_CASE("who is faster but not as safe is named, and not worse", "[ranking]") {
  std::vector<TrialRecord> trials;
  add_trials(trials, "safe", 20, with_pace(3.0));
  add_trials(trials, "fast", 20, [](std::uint32_t i) {
    auto robots = with_pace(2.0)(i);
    robots[0].safe = i != 0;
    return robots;
  });
  const Answer answer = answer_of(trials);
  CHECK(order_of(answer) == Names{"safe", "fast"});
  CHECK(answer.ranking[1].standing == Standing::not_told_apart);
  CHECK(answer.ranking[1].decided == 2u);
  CHECK_THAT(answer_lines(answer, {}).front(), Contains("P + fast (1.00 s/m faster)"));
}

TEST_CASE("swapped labels swap the answer", "[ranking]") {
  std::vector<TrialRecord> trials;
  add_trials(trials, "A", 20, always(both_arrive));
  add_trials(trials, "B", 20, always(one_touches));
  const auto lines = lines_of(trials);
  for (TrialRecord& trial : trials) trial.local_controller = trial.local_controller == "A" ? "B" : "A";
  const auto swapped = lines_of(trials);
  CHECK_THAT(lines[0], Contains("Best: P + A"));
  CHECK_THAT(lines[1], Contains("Worse: P + B (safe 0.50 lower"));
  CHECK_THAT(swapped[0], Contains("Best: P + B"));
  CHECK_THAT(swapped[1], Contains("Worse: P + A (safe 0.50 lower"));
  CHECK_THAT(lines[2], Contains("Of the 40 robots of P + B, 20 did not arrive safely: 20 after a contact at fault."));
  CHECK_THAT(swapped[2], Contains("Of the 40 robots of P + A, 20"));
}

TEST_CASE("with one task the crowd seeds count, from five on the tasks", "[ranking]") {
  std::vector<TrialRecord> trials;
  SECTION("one task") {
    add_trials(trials, "a", 8, with_pace(2.0));
    add_trials(trials, "b", 8, with_pace(2.5));
    const Answer answer = answer_of(trials);
    CHECK(answer_heading(answer) == "On this task, over 8 crowd seeds");
    CHECK(answer.ranking[1].against[2].observations == 8);
  }
  SECTION("a task each") {
    add_trials(trials, "a", 8, with_pace(2.0, true));
    add_trials(trials, "b", 8, with_pace(2.5, true));
    const Answer answer = answer_of(trials);
    CHECK(answer_heading(answer) == "In general, over 8 tasks");
    CHECK(answer.ranking[1].standing == Standing::worse);
  }
  SECTION("several crowds on each of five tasks are five observations") {
    const auto on_five_tasks = [](double pace) {
      return [=](std::uint32_t i) { return with_pace(pace, true)(i % 5); };
    };
    add_trials(trials, "a", 20, on_five_tasks(2.0));
    add_trials(trials, "b", 20, on_five_tasks(2.5));
    const Answer answer = answer_of(trials);
    CHECK(answer_heading(answer) == "In general, over 5 tasks");
    CHECK(answer.ranking[1].against[2].observations == 5);
    CHECK(answer.ranking[1].standing == Standing::not_told_apart);  // 2^-4
  }
  SECTION("neither tasks nor ways are known") {
    add_trials(trials, "a", 8, with_pace(2.0));
    add_trials(trials, "b", 8, with_pace(2.5));
    for (TrialRecord& trial : trials) {
      trial.task.clear();
      std::erase_if(trial.values, [](const MetricValue& value) { return value.metric == "way"; });
    }
    const Answer answer = answer_of(trials);
    CHECK(answer_heading(answer) == "Under these 8 crowd seeds");
    CHECK(answer.criteria.size() == 2);  // no time without them
  }
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
  CHECK(answer_heading(found[0]) == "On these 2 tasks, over 20 crowd seeds");
  CHECK(found[0].ranking[1].standing == Standing::not_told_apart);
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
    add_trials(trials, "fast", 6, with_pace(2.0, true));
    add_trials(trials, "slow", 6, with_pace(3.0, true));
    for (std::size_t i = first; i < trials.size(); ++i) {
      trials[i].swept = {{"", "people", people}};
      trials[i].scenario = with_swept(trials[i].scenario, trials[i].swept);
    }
  }
  const std::vector<Answer> found = answers_of(trials);
  REQUIRE(found.size() == 3);  // over both, and for each
  CHECK(found[0].cells.size() == 2);
  CHECK(found[0].tasks == 6);
}

TEST_CASE("orders that a sibling of the first share turns round are flagged", "[ranking]") {
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
  SECTION("nor where the sibling was not measured") {
    std::vector<MetricColumn> metrics = ranking_metrics();
    metrics.erase(metrics.begin() + 1);
    CHECK(answers(ranking_layout(), metrics, trials).front().flips.empty());
  }
}

TEST_CASE("the answer says whether the tasks can tell combinations apart", "[ranking]") {
  // of two robots so many arrive, each on a task of the repetition's own
  const auto arriving = [](std::uint32_t robots) {
    return [=](std::uint32_t i) {
      const double way_m = 10.0 + i;
      const std::optional<double> time_s = 2.0 * way_m;
      return std::vector<RobotResult>{{robots > 0 ? time_s : std::nullopt, true, way_m},
                                      {robots > 1 ? time_s : std::nullopt, true, way_m}};
    };
  };
  const auto line_of = [&](const std::vector<std::uint32_t>& arrivals, std::uint32_t tasks) -> std::string {
    std::vector<TrialRecord> trials;
    for (const std::uint32_t robots : arrivals)
      add_trials(trials, std::to_string(trials.size()), tasks, arriving(robots));
    for (const std::string& line : lines_of(trials))
      if (line.starts_with("The tasks ")) return line;
    return "";
  };
  CHECK(line_of({2, 1, 1}, 12) == "The tasks tell 2 of 3 pairs of combinations apart.");
  CHECK(line_of({1, 1, 1}, 12) == "The tasks tell 0 of 3 pairs of combinations apart.");
  CHECK(line_of({1, 1}, 12).empty());  // of two combinations, the line about the first tells
  CHECK(line_of({2, 2}, 12) == "The tasks are too easy to tell combinations apart by safe: its mean is 1.00.");
  CHECK(line_of({0, 0}, 12) == "The tasks are too hard to tell combinations apart by safe: its mean is 0.00.");
  CHECK(line_of({2, 1}, 9).empty());
}
