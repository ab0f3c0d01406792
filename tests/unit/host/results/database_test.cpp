// SPDX-License-Identifier: MIT
#include "host/results/database.hpp"

#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <cstring>
#include <limits>

#include "host/files/atomic_file.hpp"
#include "host/files/sha256.hpp"
#include "host/results/csv.hpp"
#include "host/results/manifest.hpp"
#include "host/results/trials_csv.hpp"
#include "tests/unit/host/results/results_example.hpp"

using namespace dmrp::host;
using dmrp::test::content_of;
using dmrp::test::example_metrics;
using dmrp::test::example_trial;
using dmrp::test::ScratchFolder;

namespace {

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
  CHECK(same_bits(a.sim_time_s, b.sim_time_s));
  CHECK(same_bits(a.wall_time_s, b.wall_time_s));
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
    CHECK(a.events[i].text == b.events[i].text);
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
  trial.sim_time_s = 1.0 / 3.0;
  trial.values.push_back({"cpu", DMRP_SUBJECT_SYSTEM, std::nullopt, std::nullopt, -1.0 / 3.0});
  trial.values.push_back({"cpu", DMRP_SUBJECT_SYSTEM, std::nullopt, 0.1, 5e-324});
  trial.values.push_back({"cpu", DMRP_SUBJECT_SYSTEM, std::nullopt, 0.2, std::numeric_limits<double>::max()});
  trial.values.push_back({"cpu", DMRP_SUBJECT_PEDESTRIAN, 0x8000'0000'0000'0001u, std::nullopt, std::nullopt});
  trial.events.push_back({"touches", 20'000'000, 1'999'999'999, {0, 1}, "it's \"close\""});
  trial.events.push_back({"touches", 179'980'000'000, 180'000'000'000, {}, ""});
  trial.faults.push_back({"crash", "org.example.x", "step", 812, 1, 11, "SIGSEGV", "dmrp-host x.toml --trials 7"});
  trial.faults.push_back({"exit", "", "", 0, -1, 0, "", ""});
  return trial;
}

}  // namespace

TEST_CASE("the database gives trials back to the bit", "[results]") {
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

TEST_CASE("others read the database by SQL", "[results]") {
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

TEST_CASE("a run is taken up again", "[results]") {
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

TEST_CASE("databases that cannot be used say why", "[results]") {
  const ScratchFolder folder;
  CHECK_THROWS_WITH(ResultsDatabase::open(folder / "none.sqlite"), Catch::Contains("none.sqlite"));
  write_file_atomically(folder / "text.sqlite", std::string(2000, 'x'));
  CHECK_THROWS_AS(ResultsDatabase::open(folder / "text.sqlite"), SqliteError);
  CHECK_THROWS_WITH(ResultsDatabase::create(folder / "text.sqlite", example_metrics()), Catch::Contains("exists"));
  SqliteConnection(folder / "other.sqlite", SqliteMode::create).execute("PRAGMA user_version = 7");
  CHECK_THROWS_WITH(ResultsDatabase::open(folder / "other.sqlite"), Catch::Contains("version 7, not 1"));
}

TEST_CASE("CSV fields are quoted where they must be", "[results]") {
  CsvWriter csv;
  csv.field("plain").field("a,b").field("say \"hi\"").field("two\nlines").field("").field(std::optional<double>());
  csv.end_line();
  csv.field(0.1).field(1e300).field(-0.0).field(100.0).field(std::numeric_limits<double>::quiet_NaN()).field(7);
  csv.end_line();
  CHECK(csv.text() == "plain,\"a,b\",\"say \"\"hi\"\"\",\"two\nlines\",,\n0.1,1e+300,-0,100,,7\n");
}

TEST_CASE("trials.csv has a line for each trial and a column for each metric", "[results]") {
  TrialRecord curved = example_trial(1, "A, B", 0, std::nullopt, 0.1 + 0.2);
  curved.values.insert(curved.values.begin(), {"time", DMRP_SUBJECT_SYSTEM, std::nullopt, 3.0, 99.0});
  const std::vector<TrialRecord> trials{curved, example_trial(4, "C", 1, 41.5, 0.5)};
  CHECK(trials_csv(example_metrics(), trials) ==
        "trial,scenario,robots,global_planner,local_controller,pedestrian_model,repetition,seed,outcome,repeatable,"
        "sim_time_s,wall_time_s,done,time,speed,speed_sd,touches,cpu\n"
        "1,mall,2,\"A, B\",DWA,crowd,0,1000,failed,1,180,0.125,0.5,,0.30000000000000004,0.17,0,\n"
        "4,mall,2,C,DWA,crowd,1,1001,succeeded,1,41.5,0.125,1,41.5,0.5,0.17,0,\n");
}

TEST_CASE("files are replaced at once, with the permissions of others", "[results]") {
  const ScratchFolder folder;
  write_file_atomically(folder / "a.txt", "old");
  write_file_atomically(folder / "a.txt", "new");
  CHECK(content_of(folder / "a.txt") == "new");
  const auto entries = std::filesystem::directory_iterator(folder.path());
  CHECK(std::distance(begin(entries), end(entries)) == 1);  // nothing lies beside it
  const mode_t mask = ::umask(0);
  ::umask(mask);
  struct stat status {};
  REQUIRE(::stat((folder / "a.txt").c_str(), &status) == 0);
  CHECK((status.st_mode & 0777u) == (0666u & ~mask));
  CHECK_THROWS_WITH(write_file_atomically(folder / "no/folder.txt", "x"), Catch::Contains("no/folder.txt"));
}

TEST_CASE("SHA-256", "[results]") {
  // FIPS 180-4's examples
  CHECK(sha256_of_bytes("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  CHECK(sha256_of_bytes("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  const ScratchFolder folder;
  const std::string large(1'000'000, 'a');
  write_file_atomically(folder / "large", large);
  CHECK(sha256_of_file(folder / "large") == "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
  CHECK_THROWS_AS(sha256_of_file(folder / "none"), std::system_error);
}

TEST_CASE("the manifest comes back from its file", "[results]") {
  const ScratchFolder folder;
  write_file_atomically(folder / "map.yaml", "abc");
  const auto begun = std::chrono::system_clock::time_point(std::chrono::seconds(1'700'000'000));
  Manifest manifest = new_manifest("0.1.0", {"dmrp-host", "a b.toml", "--jobs", "2"}, begun);
  manifest.files.push_back(hashed_file("map", folder / "map.yaml"));
  write_file_atomically(folder / "manifest.json", to_json_text(manifest));
  const Manifest read = read_manifest(folder / "manifest.json");

  CHECK(read.dmrp_version == "0.1.0");
  CHECK(read.command_line == manifest.command_line);
  CHECK(read.started_at == "2023-11-14T22:13:20Z");
  CHECK_FALSE(read.machine.libc.empty());
  CHECK_FALSE(read.machine.compiler.empty());
  REQUIRE(read.files.size() == 1);
  CHECK(read.files[0].role == "map");
  CHECK(read.files[0].sha256 == sha256_of_bytes("abc"));
  CHECK(differences(manifest, read).empty());

  write_file_atomically(folder / "half.json", "{\"dmrp_version\": \"0.1.0\"");
  CHECK_THROWS_WITH(read_manifest(folder / "half.json"), Catch::Contains("half.json"));
}

TEST_CASE("manifests tell what may change bits, and nothing else", "[results]") {
  Manifest before;
  before.machine = {"glibc 2.36", "x86-64-v3", {"avx", "avx2", "erms", "fma"}, "gcc 12.2.0"};
  before.files = {{"plugin library", "/a/libx.so", "11"}, {"map", "/a/m.yaml", "22"}};
  Manifest now = before;
  now.command_line = {"other"};
  now.started_at = "later";
  now.files[0].path = "/b/libx.so";
  now.machine.cpu_features = {"avx", "avx2", "fma", "tsc"};
  CHECK(differences(before, now).empty());

  now.machine.libc = "glibc 2.37";
  now.machine.cpu_features = {"avx", "avx2", "tsc"};
  now.files[1].sha256 = "23";
  CHECK(differences(before, now) == std::vector<std::string>{"libc: glibc 2.36, now glibc 2.37",
                                                             "CPU feature fma is missing now",
                                                             "map /a/m.yaml has changed"});
}

TEST_CASE("the level of a CPU is the highest whose features are all there", "[results]") {
  const std::string v2 = "cx16 lahf_lm popcnt pni sse4_1 sse4_2 ssse3";
  const std::string v3 = v2 + " avx avx2 bmi1 bmi2 f16c fma abm movbe";
  const auto level = [](const std::string& flags) {
    return x86_64_level_of(cpu_features_of("processor\t: 0\nflags\t\t: " + flags + "\nbugs\t\t: some\n"));
  };
  CHECK(level("fpu sse sse2") == "x86-64-v1");
  CHECK(level(v2) == "x86-64-v2");
  CHECK(level(v3) == "x86-64-v3");
  CHECK(level(v3 + " avx512f") == "x86-64-v3");
  CHECK(level(v3 + " avx512f avx512bw avx512cd avx512dq avx512vl") == "x86-64-v4");
  CHECK(cpu_features_of("Features\t: fp asimd\n") == std::vector<std::string>{"asimd", "fp"});
}
