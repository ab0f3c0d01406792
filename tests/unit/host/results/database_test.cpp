// SPDX-License-Identifier: MIT
#include "host/results/database.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstring>
#include <limits>

#include "host/errors/machine_error.hpp"
#include "host/files/atomic_file.hpp"
#include "tests/unit/host/results/results_example.hpp"

namespace database_test {

using namespace dmrp::host;
using dmrp::test::content_of;
using dmrp::test::example_metrics;
using dmrp::test::example_trial;
using dmrp::test::ScratchFolder;

bool same_bits(double a, double b) {
  return std::memcmp(&a, &b, sizeof(double)) == 0;
}

// Bits of everything, so that the last digit counts.
bool same(const std::optional<double>& a, const std::optional<double>& b) {
  return a.has_value() == b.has_value() && (!a || same_bits(*a, *b));
}

void check_same(const TrialRecord& a, const TrialRecord& b) {
  CHECK(a.id == b.id);
  CHECK(a.scenario == b.scenario);
  CHECK(a.robots == b.robots);
  CHECK(a.global_planner == b.global_planner);
  CHECK(a.local_controller == b.local_controller);
  CHECK(a.pedestrian_model == b.pedestrian_model);
  CHECK(a.repetition == b.repetition);
  CHECK(a.seed == b.seed);
  CHECK(a.outcome == b.outcome);
  CHECK(a.repeatable == b.repeatable);
  CHECK(a.timing == b.timing);
  CHECK(same_bits(a.sim_time_s, b.sim_time_s));
  CHECK(same_bits(a.wall_time_s, b.wall_time_s));
  CHECK(a.task == b.task);
  CHECK(a.swept == b.swept);
  REQUIRE(a.values.size() == b.values.size());
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    CHECK(a.values[i].metric == b.values[i].metric);
    CHECK(a.values[i].subject_kind == b.values[i].subject_kind);
    CHECK(a.values[i].subject == b.values[i].subject);
    CHECK(same(a.values[i].coordinate, b.values[i].coordinate));
    CHECK(same(a.values[i].value, b.values[i].value));
  }
  REQUIRE(a.events.size() == b.events.size());
  for (std::size_t i = 0; i < a.events.size(); ++i) {
    CHECK(a.events[i].metric == b.events[i].metric);
    CHECK(a.events[i].from_ns == b.events[i].from_ns);
    CHECK(a.events[i].to_ns == b.events[i].to_ns);
    CHECK(a.events[i].robots == b.events[i].robots);
    CHECK(a.events[i].people == b.events[i].people);
    CHECK(a.events[i].text == b.events[i].text);
    CHECK(a.events[i].severity == b.events[i].severity);
    REQUIRE(a.events[i].place.has_value() == b.events[i].place.has_value());
    if (!a.events[i].place) continue;
    CHECK(same_bits(a.events[i].place->x, b.events[i].place->x));
    CHECK(same_bits(a.events[i].place->y, b.events[i].place->y));
  }
  REQUIRE(a.faults.size() == b.faults.size());
  for (std::size_t i = 0; i < a.faults.size(); ++i) {
    CHECK(a.faults[i].kind == b.faults[i].kind);
    CHECK(a.faults[i].plugin == b.faults[i].plugin);
    CHECK(a.faults[i].function == b.faults[i].function);
    CHECK(a.faults[i].step == b.faults[i].step);
    CHECK(a.faults[i].robot == b.faults[i].robot);
    CHECK(a.faults[i].signal == b.faults[i].signal);
    CHECK(a.faults[i].detail == b.faults[i].detail);
    CHECK(a.faults[i].rerun == b.faults[i].rerun);
  }
}

TrialRecord full_trial(std::uint64_t id) {
  TrialRecord trial = example_trial(id, "CBS, optimal", 0, 41.8, 0.1 + 0.2);
  trial.seed = 0xFFFF'FFFF'FFFF'FFF0u;
  trial.outcome = trial_outcome::fault;
  trial.repeatable = false;
  trial.timing = {{"org.example.x", "draws in a thread"}, {"org.example.y", "plan() was stopped by its time budget"}};
  trial.sim_time_s = 1.0 / 3.0;
  trial.task = "0123456789abcdef";
  trial.swept = {{"", "people", "6"}, {"simulation", "tracking", "it's"}};
  trial.values.push_back({"cpu", DMRP_SUBJECT_SYSTEM, std::nullopt, std::nullopt, -1.0 / 3.0});
  trial.values.push_back({"cpu", DMRP_SUBJECT_SYSTEM, std::nullopt, 0.1, 5e-324});
  trial.values.push_back({"cpu", DMRP_SUBJECT_SYSTEM, std::nullopt, 0.2, std::numeric_limits<double>::max()});
  trial.values.push_back({"cpu", DMRP_SUBJECT_PEDESTRIAN, 0x8000'0000'0000'0001u, std::nullopt, std::nullopt});
  trial.events.push_back({"touches",
                          20'000'000,
                          1'999'999'999,
                          {0, 1},
                          {3, 0x8000'0000'0000'0001u},
                          "it's \"close\"",
                          DMRP_SEVERITY_SERIOUS,
                          dmrp_vec2{0.1 + 0.2, -1.0 / 3.0}});
  trial.events.push_back({"touches", 179'980'000'000, 180'000'000'000, {}, {}, "", DMRP_SEVERITY_INFO, {}});
  trial.faults.push_back({"crash", "org.example.x", "step", 812, 1, 11, "SIGSEGV", "dmrp-host x.toml --trials 7"});
  trial.faults.push_back({"exit", "", "", 0, -1, 0, "", ""});
  return trial;
}

TEST_CASE("trials read from the database equal the written ones bit by bit", "[results]") {
  const ScratchFolder folder;
  const std::vector<TrialRecord> written{example_trial(3, "A", 1, std::nullopt, 0.5), full_trial(7)};
  {
    ResultsDatabase database = ResultsDatabase::create(folder / "results.sqlite", example_metrics());
    database.write(written[1]);  // as trials come in, not by id
    database.write(written[0]);
  }
  const ResultsDatabase database = ResultsDatabase::open_read_only(folder / "results.sqlite");
  const std::vector<TrialRecord> read = database.trials();
  REQUIRE(read.size() == 2);
  check_same(read[0], written[0]);
  check_same(read[1], written[1]);

  const std::vector<MetricColumn> metrics = database.metrics();
  REQUIRE(metrics.size() == example_metrics().size());
  CHECK(metrics[1].name == "time");
  CHECK(metrics[1].unit == "s");
  CHECK(metrics[1].direction == DMRP_DIRECTION_LOWER);
  CHECK(metrics[1].description == "until the last one");
  CHECK_FALSE(metrics[1].wall_clock);
  CHECK(metrics[5].wall_clock);
}

TEST_CASE("a row that was changed after the run is refused", "[results]") {
  const ScratchFolder folder;
  TrialRecord trial = full_trial(3);
  trial.plan_sha256 = "aa";
  trial.trace_sha256 = "bb";
  for (const double odd : {-0.0, std::nan(""), 1e300})
    trial.values.push_back({"cpu", DMRP_SUBJECT_SYSTEM, {}, {}, odd});
  const auto path = folder / "results.sqlite";
  {
    ResultsDatabase database = ResultsDatabase::create(path, example_metrics());
    database.write(trial);
    database.write(full_trial(4));
    CHECK(database.trials()[0].trace_sha256 == "bb");
    database.finish();
  }
  for (const char* change :
       {"UPDATE value SET value = value + 1 WHERE rowid = 1", "UPDATE trial SET seed = seed + 1 WHERE id = 3",
        "UPDATE trial SET row_sha256 = '' WHERE id = 3", "DELETE FROM value WHERE rowid = 1",
        "UPDATE trial SET trace_sha256 = 'cc' WHERE id = 3"}) {
    const auto changed = folder / "changed.sqlite";
    std::filesystem::copy_file(path, changed, std::filesystem::copy_options::overwrite_existing);
    SqliteConnection(changed, SqliteMode::read_write).execute(change);
    CHECK_THROWS_WITH(ResultsDatabase::open_read_only(changed).trials(), Catch::Contains("trial 3 has other values"));
  }
  CHECK(ResultsDatabase::open_read_only(path).trials().size() == 2);
}

TEST_CASE("the database can be read by SQL", "[results]") {
  const ScratchFolder folder;
  ResultsDatabase::create(folder / "results.sqlite", example_metrics()).write(full_trial(7));
  const SqliteConnection connection(folder / "results.sqlite", SqliteMode::read_only);
  const auto answer = [&](const std::string& sql) {
    SqliteStatement statement(connection, sql);
    REQUIRE(statement.step());
    return statement.column_is_null(0) ? std::string("NULL") : statement.column_text(0);
  };
  CHECK(answer("SELECT printf('%!.17g', value) FROM value WHERE metric = 'speed'") == "0.30000000000000004");
  CHECK(answer("SELECT printf('%!.17g', sim_time_s) FROM trial") == "0.33333333333333331");
  CHECK(answer("SELECT value FROM value WHERE subject_kind = 'pedestrian'") == "NULL");
  CHECK(answer("SELECT subject FROM value WHERE metric = 'time'") == "NULL");
  CHECK(answer("SELECT coordinate FROM value WHERE metric = 'time'") == "NULL");
  CHECK(answer("SELECT subject FROM value WHERE subject_kind = 'robot' ORDER BY subject DESC") == "1");
  CHECK(answer("SELECT from_s FROM event") == "0.02");
  CHECK(answer("SELECT subjects FROM event") == "[0,1]");
  CHECK(answer("SELECT signal FROM fault WHERE kind = 'exit'") == "NULL");
  CHECK(answer("SELECT robot FROM fault WHERE kind = 'exit'") == "NULL");
  CHECK(answer("SELECT direction FROM metric WHERE name = 'done'") == "higher");
  CHECK(answer("PRAGMA journal_mode") == "wal");
  CHECK(answer("PRAGMA foreign_key_list(value)") == "0");
}

TEST_CASE("views have a column for each metric, with its unit", "[results]") {
  const ScratchFolder folder;
  std::vector<MetricColumn> metrics = example_metrics();
  metrics.push_back({"odd'\"name", "m", 0, false, ""});
  {
    ResultsDatabase database = ResultsDatabase::create(folder / "results.sqlite", metrics);
    database.write(example_trial(0, "CBS", 0, 40.0, 0.5));
    database.write(example_trial(1, "CBS", 1, std::nullopt, 0.6));
  }
  const SqliteConnection connection(folder / "results.sqlite", SqliteMode::read_only);
  SqliteStatement trials(connection,
                         "SELECT global_planner, \"time [s]\", \"speed [m/s]\", done, \"odd'\"\"name [m]\" FROM "
                         "trial_values ORDER BY id");
  REQUIRE(trials.step());
  CHECK(trials.column_text(0) == "CBS");
  CHECK(trials.column_number(1) == 40.0);
  CHECK(trials.column_number(2) == 0.5);
  REQUIRE(trials.step());
  CHECK(trials.column_is_null(1));
  CHECK(trials.column_number(3) == 0.5);
  CHECK_FALSE(trials.step());
  SqliteStatement robots(connection, "SELECT robot, done FROM robot_values WHERE trial_id = 1 ORDER BY robot");
  REQUIRE(robots.step());
  CHECK(robots.column_number(1) == 1.0);
  REQUIRE(robots.step());
  CHECK(robots.column_number(1) == 0.0);
  CHECK_FALSE(robots.step());
}

TEST_CASE("a trial is written whole or not at all", "[results]") {
  const ScratchFolder folder;
  ResultsDatabase database = ResultsDatabase::create(folder / "results.sqlite", example_metrics());
  TrialRecord trial = example_trial(1, "A", 0, 40.0, 0.5);
  trial.values.push_back(dmrp::test::system_number("undeclared", 1.0));
  CHECK_THROWS_AS(database.write(trial), SqliteError);
  CHECK(database.trials().empty());
  trial.values.pop_back();
  trial.outcome = "exploded";
  CHECK_THROWS_AS(database.write(trial), SqliteError);
  CHECK(database.trials().empty());
  trial.outcome = trial_outcome::succeeded;
  database.write(trial);
  CHECK(database.trials().size() == 1);
}

TEST_CASE("a run can be resumed", "[results]") {
  const ScratchFolder folder;
  {
    ResultsDatabase database = ResultsDatabase::create(folder / "results.sqlite", example_metrics());
    database.write(example_trial(5, "A", 2, 40.0, 0.5));
    database.write(full_trial(2));
    TrialRecord skipped = example_trial(1, "A", 0, std::nullopt, 0.5);
    skipped.outcome = trial_outcome::skipped;
    database.write(skipped);
  }
  ResultsDatabase database = ResultsDatabase::open(folder / "results.sqlite");
  CHECK(database.finished_trials() == std::vector<std::uint64_t>{2, 5});
  const TrialRecord again = example_trial(1, "A", 0, 44.0, 0.5);
  database.write(again);
  CHECK(database.finished_trials() == std::vector<std::uint64_t>{1, 2, 5});
  check_same(database.trials()[0], again);  // nothing of what was there before is left
}

TEST_CASE("unusable databases are reported with the reason", "[results]") {
  const ScratchFolder folder;
  CHECK_THROWS_WITH(ResultsDatabase::open(folder / "none.sqlite"), Catch::Contains("none.sqlite"));
  write_file_atomically(folder / "text.sqlite", std::string(2000, 'x'));
  CHECK_THROWS_AS(ResultsDatabase::open(folder / "text.sqlite"), SqliteError);
  CHECK_THROWS_WITH(ResultsDatabase::create(folder / "text.sqlite", example_metrics()), Catch::Contains("exists"));
  for (const char* version : {"3", "7"}) {  // an earlier and a later host's
    const auto other = folder / (std::string("other") + version + ".sqlite");
    SqliteConnection(other, SqliteMode::create).execute(std::string("PRAGMA user_version = ") + version);
    for (const auto open : {&ResultsDatabase::open, &ResultsDatabase::open_read_only})
      CHECK_THROWS_WITH(open(other), Catch::Contains(std::string("version ") + version + ", not 6"));
  }
}

TEST_CASE("values of a trial that was deleted are refused, and not doubled when it runs again") {
  const ScratchFolder folder;
  {
    ResultsDatabase database = ResultsDatabase::create(folder / "results.sqlite", example_metrics());
    for (const std::uint64_t id : {1, 2}) database.write(full_trial(id));
  }
  SqliteConnection(folder / "results.sqlite", SqliteMode::read_write).execute("DELETE FROM trial WHERE id = 2");
  CHECK_THROWS_WITH(ResultsDatabase::open_read_only(folder / "results.sqlite").trials(),
                    Catch::Contains("results of trial 2"));
  ResultsDatabase database = ResultsDatabase::open(folder / "results.sqlite");
  CHECK(database.finished_trials() == std::vector<std::uint64_t>{1});
  database.write(full_trial(2));
  REQUIRE(database.trials().size() == 2);
  check_same(database.trials()[1], full_trial(2));
}

TEST_CASE("a file that was deleted or replaced is noticed") {
  const ScratchFolder folder;
  ResultsDatabase database = ResultsDatabase::create(folder / "results.sqlite", example_metrics());
  database.write(full_trial(1));
  SECTION("deleted") {
    std::filesystem::remove(folder / "results.sqlite");
  }
  SECTION("replaced") {
    std::filesystem::rename(folder / "results.sqlite", folder / "old");
    std::filesystem::copy_file(folder / "old", folder / "results.sqlite");
  }
  CHECK_THROWS_AS(database.write(full_trial(2)), MachineError);
}

TEST_CASE("who reads while a run writes sees one moment") {
  const ScratchFolder folder;
  ResultsDatabase database = ResultsDatabase::create(folder / "results.sqlite", example_metrics());
  database.write(full_trial(1));
  const ResultsDatabase reader = ResultsDatabase::open_read_only(folder / "results.sqlite");
  database.write(full_trial(2));
  CHECK(reader.finished_trials() == std::vector<std::uint64_t>{1});
  CHECK(reader.trials().size() == 1);
  CHECK(ResultsDatabase::open_read_only(folder / "results.sqlite").trials().size() == 2);
  database.finish();
  CHECK(reader.trials().size() == 1);
}

TEST_CASE("a finished database is one file, and can be resumed") {
  const ScratchFolder folder;
  const auto files = [&] { return std::distance(std::filesystem::directory_iterator(folder.path()), {}); };
  {
    ResultsDatabase database = ResultsDatabase::create(folder / "results.sqlite", example_metrics());
    database.write(full_trial(1));
    database.finish();
  }
  CHECK(ResultsDatabase::open_read_only(folder / "results.sqlite").trials().size() == 1);
  CHECK(files() == 1);
  ResultsDatabase database = ResultsDatabase::open(folder / "results.sqlite");
  database.write(full_trial(2));
  CHECK(std::filesystem::exists(folder / "results.sqlite-wal"));
}

TEST_CASE("events are read of one metric, or of one trial") {
  const ScratchFolder folder;
  ResultsDatabase database = ResultsDatabase::create(folder / "results.sqlite", example_metrics());
  for (const std::uint64_t id : {1, 2}) database.write(full_trial(id));
  const std::size_t all = full_trial(1).events.size();
  CHECK(database.trials()[0].events.size() == all);
  CHECK(database.trials_with_events_of("touches")[1].events.size() == all);
  CHECK(database.trials_with_events_of("done")[1].events.empty());
  CHECK(database.trials_with_events_of("")[1].events.empty());
  CHECK(database.events(2).size() == all);
  CHECK(database.events(3).empty());
  TrialRecord whole = database.trials_with_events_of("")[0];
  whole.events = database.events(1);
  check_same(whole, full_trial(1));
}

TEST_CASE("a damaged file is refused") {
  const ScratchFolder folder;
  {
    ResultsDatabase database = ResultsDatabase::create(folder / "results.sqlite", example_metrics());
    for (std::uint64_t id = 0; id < 100; ++id) database.write(full_trial(id));
  }
  std::string bytes = content_of(folder / "results.sqlite");
  SECTION("cut short") {
    bytes.resize(bytes.size() / 2);
  }
  SECTION("overwritten") {
    std::fill(bytes.begin() + 8192, bytes.end() - 4096, 'x');
  }
  SECTION("another file") {
    bytes = "hello";
  }
  std::ofstream(folder / "results.sqlite", std::ios::binary) << bytes;
  CHECK_THROWS_AS(ResultsDatabase::open(folder / "results.sqlite"), SqliteError);
}

TEST_CASE("a fault is added to a trial that has ended, and makes it one to try again") {
  const ScratchFolder folder;
  ResultsDatabase database = ResultsDatabase::create(folder / "results.sqlite", example_metrics());
  TrialRecord trial = full_trial(3);
  trial.faults.clear();
  database.write(trial);
  CHECK(database.finished_trials(ResultsDatabase::Finished::without_faults) == std::vector<std::uint64_t>{3});
  trial.faults = {{"crash", "org.example.x", "destroy", 0, -1, 11, "Segmentation fault", "dmrp-host x.toml"}};
  database.add_fault(3, trial.faults[0]);
  check_same(database.trials()[0], trial);
  CHECK(database.finished_trials() == std::vector<std::uint64_t>{3});
  CHECK(database.finished_trials(ResultsDatabase::Finished::without_faults).empty());
}

}  // namespace database_test
