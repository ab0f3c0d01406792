// SPDX-License-Identifier: MIT
#include "core/statistics/best_set.hpp"

#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/statistics/signed_rank.hpp"

namespace best_set_test {

using namespace dmrp::core;

using Values = std::vector<std::vector<double>>;

Resampling one_world(std::size_t tasks) {
  return {std::vector<std::uint32_t>(tasks, 0), Scope::these_worlds, 0};
}

Criterion share(const Values& values) {
  return {differences_of(values), true, PairedScore::mean, 0.05, share_bounds};
}

Criterion time(const Values& values) {
  return {differences_of(values), false, PairedScore::ranks, 0.0, {}};
}

BestSet best_set_of(std::size_t entries, const std::vector<Criterion>& criteria, std::size_t tasks) {
  return best_set(entries, criteria, one_world(tasks));
}

// 1, 2, ...: times that a factor makes slower.
std::vector<double> times(std::size_t tasks, double factor) {
  std::vector<double> values;
  for (std::size_t i = 0; i < tasks; ++i) values.push_back(factor * (1.0 + static_cast<double>(i)));
  return values;
}

struct Country {
  std::string name;
  double score;
  double error;
};

// OECD: PISA 2018, mathematics: means and standard errors.
const std::vector<Country>& pisa() {
  static const std::vector<Country> countries{
      {"Australia", 491.3600252, 1.939833031},      {"Austria", 498.9423138, 2.970998694},
      {"Belgium", 508.0703063, 2.262662011},        {"Canada", 512.0169429, 2.357475749},
      {"Chile", 417.4065563, 2.41588757},           {"Colombia", 390.9322732, 2.989559274},
      {"Czech Republic", 499.4676508, 2.460661531}, {"Denmark", 509.3983746, 1.735002337},
      {"Estonia", 523.4145802, 1.743602224},        {"Finland", 507.3013618, 1.967920411},
      {"France", 495.4075794, 2.320214487},         {"Germany", 500.0437805, 2.647083096},
      {"Greece", 451.3703438, 3.091228197},         {"Hungary", 481.0826364, 2.319596741},
      {"Iceland", 495.1873762, 1.953082603},        {"Ireland", 499.632894, 2.198621128},
      {"Israel", 463.0345488, 3.498563228},         {"Italy", 486.5898573, 2.780045867},
      {"Japan", 526.9732502, 2.471475318},          {"Korea", 525.933002, 3.121394315},
      {"Latvia", 496.1263306, 1.962766789},         {"Lithuania", 481.1911884, 1.953282039},
      {"Luxembourg", 483.421485, 1.097632409},      {"Mexico", 408.8014734, 2.493225544},
      {"Netherlands", 519.2309824, 2.632277885},    {"New Zealand", 494.489676, 1.705942856},
      {"Norway", 500.9637885, 2.219044878},         {"Poland", 515.6478747, 2.602085176},
      {"Portugal", 492.4874062, 2.684570081},       {"Slovak Republic", 486.1648542, 2.555595707},
      {"Slovenia", 508.8975441, 1.363877596},       {"Spain", 481.3926126, 1.462417763},
      {"Sweden", 502.3877022, 2.654250935},         {"Switzerland", 515.3147131, 2.908003898},
      {"Turkey", 453.5077774, 2.260406789},         {"United Kingdom", 501.7698992, 2.564428111},
      {"United States", 478.2447174, 3.235444099}};
  return countries;
}

// Independent values on 64 tasks with exactly these means and standard errors: columns of a Hadamard matrix.
Values pisa_values() {
  constexpr std::size_t tasks = 64;
  Values values;
  for (const Country& country : pisa()) {
    std::vector<double>& own = values.emplace_back();
    for (std::size_t task = 0; task < tasks; ++task) {
      const bool odd = std::popcount(task & values.size()) % 2 != 0;
      own.push_back(country.score + (odd ? -1.0 : 1.0) * country.error * std::sqrt(tasks - 1.0));
    }
  }
  return values;
}

TEST_CASE("the best set of two entries is the signed-rank test's verdict", "[statistics]") {
  std::vector<double> slower = times(9, 1.0);
  const std::vector<double> extra{0.3, 0.5, -0.1, 0.4, 0.7, -0.2, 0.6, 0.8, 0.9};
  for (std::size_t i = 0; i < extra.size(); ++i) slower[i] += extra[i];
  const Values values{times(9, 1.0), slower};
  const BestSet set = best_set_of(2, {time(values)}, 9);
  CHECK(set.observations == 9);
  CHECK_FALSE(set.excluded[0]);
  REQUIRE(set.excluded[1]);
  CHECK(set.excluded[1]->by == 0);
  CHECK(set.excluded[1]->criterion == 0);
  CHECK(set.excluded[1]->p == Approx(signed_rank_test(extra).p));
}

TEST_CASE("selection among many is inside the best set", "[statistics]") {
  // one entry lucky enough for p = 2 / 64 against one other is not enough among five
  Values values(5, std::vector<double>(6, 0.0));
  const double noise[5][6] = {
      {5, 6, 4, 7, 5, 6}, {9, 1, 8, 2, 3, 9}, {1, 9, 2, 8, 9, 1}, {6, 7, 5, 8, 6, 7}, {4, 4, 9, 1, 9, 3}};
  for (std::size_t e = 0; e < 5; ++e)
    for (std::size_t i = 0; i < 6; ++i) values[e][i] = noise[e][i] + 0.01 * static_cast<double>(i * e);
  const Values two{values[0], values[3]};
  CHECK(best_set_of(2, {time(two)}, 6).excluded[1]);
  CHECK_FALSE(best_set_of(5, {time(values)}, 6).excluded[3]);
}

TEST_CASE("fewer than six observations exclude nobody", "[statistics]") {
  for (const std::size_t tasks : {5u, 6u}) {
    const Values values{times(tasks, 1.0), times(tasks, 3.0)};
    CHECK(best_set_of(2, {time(values)}, tasks).excluded[1].has_value() == (tasks == 6));
  }
  CHECK(best_set_of(2, {time({{}, {}})}, 0).excluded.size() == 2);
}

TEST_CASE("in general, a world is one observation", "[statistics]") {
  const Values values{times(40, 1.0), times(40, 1.2)};
  std::vector<std::uint32_t> worlds;
  for (std::uint32_t i = 0; i < 40; ++i) worlds.push_back(i / 8);
  const std::vector<Criterion> criteria{time(values)};
  const BestSet here = best_set(2, criteria, Resampling(worlds, Scope::these_worlds, 0));
  CHECK(here.observations == 40);
  CHECK(here.excluded[1]);
  const BestSet general = best_set(2, criteria, Resampling(worlds, Scope::in_general, 0));
  CHECK(general.observations == 5);
  CHECK_FALSE(general.excluded[1]);
}

TEST_CASE("criteria decide in their order", "[statistics]") {
  const std::size_t tasks = 100;
  const std::vector<double> all(tasks, 1.0);
  const std::vector<double> few(tasks, 0.5);
  const Values faster_last{times(tasks, 1.5), times(tasks, 1.0)};
  SECTION("the less safe entry is out, though it is faster") {
    const Values shares{all, few};
    const BestSet set = best_set_of(2, {share(shares), time(faster_last)}, tasks);
    CHECK_FALSE(set.excluded[0]);
    REQUIRE(set.excluded[1]);
    CHECK(set.excluded[1]->criterion == 0);
  }
  SECTION("of entries that are equally safe everywhere, time decides") {
    const Values shares{all, all};
    const BestSet set = best_set_of(2, {share(shares), time(faster_last)}, tasks);
    REQUIRE(set.excluded[0]);
    CHECK(set.excluded[0]->criterion == 1);
    CHECK_FALSE(set.excluded[1]);
  }
  SECTION("time does not decide where the faster entry may be less safe by more than the margin") {
    Values shares{all, all};
    for (std::size_t i = 0; i < 4; ++i) shares[1][i] = 0.0;
    const BestSet set = best_set_of(2, {share(shares), time(faster_last)}, tasks);
    CHECK_FALSE(set.excluded[0]);
    CHECK_FALSE(set.excluded[1]);
  }
  SECTION("a difference within the margin excludes nobody, however sure") {
    Values shares{all, all};
    for (double& value : shares[1]) value -= 0.04;
    CHECK_FALSE(best_set_of(2, {share(shares)}, tasks).excluded[1]);
    for (double& value : shares[1]) value -= 0.02;
    CHECK(best_set_of(2, {share(shares)}, tasks).excluded[1]);
  }
}

TEST_CASE("missing values leave out their task", "[statistics]") {
  Values values{times(12, 1.0), times(12, 1.5)};
  for (std::size_t i = 0; i < 7; ++i) values[1][i] = std::numeric_limits<double>::quiet_NaN();
  const BestSet set = best_set_of(2, {time(values)}, 12);
  CHECK(set.observations == 5);
  CHECK_FALSE(set.excluded[1]);
}

TEST_CASE("the best set lies within the published confidence set for the five best of PISA", "[statistics]") {
  // vignette of the R package csranks: the 95 % confidence set for the five best in mathematics
  const std::vector<std::string> five_best{"Belgium", "Canada",      "Denmark", "Estonia",  "Finland", "Japan",
                                           "Korea",   "Netherlands", "Poland",  "Slovenia", "Sweden",  "Switzerland"};
  const Values values = pisa_values();
  const std::vector<Criterion> criteria{{differences_of(values), true, PairedScore::mean, 0.0, {}}};
  const BestSet set = best_set(values.size(), criteria, one_world(64));
  std::vector<std::string> best;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!set.excluded[i]) best.push_back(pisa()[i].name);
  for (const std::string& name : best) CHECK(std::find(five_best.begin(), five_best.end(), name) != five_best.end());
  // all that are within 2.7 standard errors of the first, which two alone would need at 0.7 %, and none beyond 4.5
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double z = (526.9732502 - pisa()[i].score) / std::hypot(2.471475318, pisa()[i].error);
    INFO(pisa()[i].name << " " << z);
    if (z < 2.7) CHECK_FALSE(set.excluded[i]);
    if (z > 4.5) CHECK(set.excluded[i]);
  }
}

TEST_CASE("not inferior", "[statistics]") {
  const Criterion criterion{{}, true, PairedScore::mean, 0.05, share_bounds};
  const auto shows = [&](const std::vector<double>& differences) {
    return non_inferior(differences, criterion, one_world(differences.size()));
  };
  CHECK(shows(std::vector<double>(10, 0.0)));
  CHECK_FALSE(shows({}));
  std::vector<double> one_lost(200, 0.0);
  one_lost[0] = -1.0;
  CHECK(shows(one_lost));
  one_lost.resize(40);
  CHECK_FALSE(shows(one_lost));
  CHECK_FALSE(shows(std::vector<double>(200, -0.06)));

  const Criterion delay{{}, false, PairedScore::ranks, 0.5, {}};
  std::vector<double> seconds;
  for (int i = 0; i < 20; ++i) seconds.push_back(i % 2 == 0 ? 0.3 : -0.1);  // mean 0.1, error 0.0459
  CHECK(non_inferior(seconds, delay, one_world(20)));
  for (double& value : seconds) value += 0.33;  // 0.43 + 1.729 * 0.0459 is above 0.5
  CHECK_FALSE(non_inferior(seconds, delay, one_world(20)));
  CHECK_FALSE(non_inferior(std::vector<double>{0.1, 0.2, 0.1, -0.1, 0.0, 0.1, 0.2, 0.1, 0.1}, delay, one_world(9)));
}

TEST_CASE("the Pareto set", "[statistics]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::vector<double>> means{{0.9, 0.8, 0.8, 0.7, 0.0}, {30.0, 20.0, 25.0, nan, 10.0}};
  CHECK(pareto_set(means, {true, false}) == std::vector<bool>{true, true, false, false, true});
  CHECK(pareto_set({}, {}).empty());
}

}  // namespace best_set_test
