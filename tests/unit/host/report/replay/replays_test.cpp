// SPDX-License-Identifier: MIT
#include "host/report/replay/replays.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "core/trace/trace_file.hpp"
#include "core/trace/trace_reader.hpp"
#include "host/report/replay/page_packing.hpp"
#include "host/report/replay/replay_choice.hpp"
#include "host/report/replay/replay_data.hpp"
#include "tests/unit/core/trace/trace_example.hpp"
#include "tests/unit/host/results/results_example.hpp"

namespace dmrp::host {
namespace {

using test::example_trial;

// Three repetitions of two planners: A takes 30, 10 and 20 s, B arrives never.
std::vector<TrialRecord> two_planners() {
  std::vector<TrialRecord> trials = {example_trial(0, "A", 0, 30.0, 0.5), example_trial(1, "B", 0, {}, 0.3),
                                     example_trial(2, "A", 1, 10.0, 0.5), example_trial(3, "B", 1, {}, 0.1),
                                     example_trial(4, "A", 2, 20.0, 0.5), example_trial(5, "B", 2, {}, 0.2)};
  return trials;
}

std::vector<std::pair<std::uint64_t, std::string>> wishes_of(const std::vector<TrialRecord>& trials,
                                                             const std::vector<std::string>& rank_by,
                                                             const std::vector<std::uint64_t>& asked = {}) {
  std::vector<std::pair<std::uint64_t, std::string>> list;
  for (const ReplayWish& wish : wished_replays(trials, test::example_metrics(), rank_by, asked))
    list.emplace_back(trials[wish.trial].id, wish.why);
  return list;
}

using Wishes = std::vector<std::pair<std::uint64_t, std::string>>;

TEST_CASE("Median and worst come before failures, by the first metric that a combination has", "[report]") {
  // "time" is undefined for all of B, so "speed" ranks it: higher is better
  CHECK(
      wishes_of(two_planners(), {"time", "speed"}) ==
      Wishes{{4, "median"}, {5, "median"}, {0, "worst"}, {3, "worst"}, {1, "failure"}, {3, "failure"}, {5, "failure"}});
  CHECK(wishes_of(two_planners(), {"time"}) ==
        Wishes{{4, "median"}, {0, "worst"}, {1, "failure"}, {3, "failure"}, {5, "failure"}});
  CHECK(wishes_of(two_planners(), {}, {2, 77}) == Wishes{{2, "asked"}, {1, "failure"}, {3, "failure"}, {5, "failure"}});
}

TEST_CASE("Equals are ranked by id, of an even number the lower is the median, the skipped do not count", "[report]") {
  std::vector<TrialRecord> trials = {example_trial(0, "A", 0, 10.0, 0.5), example_trial(1, "A", 1, 10.0, 0.5),
                                     example_trial(2, "A", 2, 10.0, 0.5), example_trial(3, "A", 3, 10.0, 0.5),
                                     example_trial(4, "A", 4, 90.0, 0.5)};
  trials[4].outcome = trial_outcome::skipped;
  CHECK(wishes_of(trials, {"time"}) == Wishes{{1, "median"}, {3, "worst"}});
}

TEST_CASE("Faults come before failures, a round of all combinations at a time", "[report]") {
  std::vector<TrialRecord> trials = two_planners();
  trials[0].outcome = trials[3].outcome = trials[4].outcome = trial_outcome::fault;
  CHECK(wishes_of(trials, {}) == Wishes{{0, "fault"}, {3, "fault"}, {4, "fault"}, {1, "failure"}, {5, "failure"}});
}

// A run's folder with traces of these trials.
class Run {
 public:
  explicit Run(const std::vector<std::uint64_t>& traced) {
    std::filesystem::create_directory(folder_ / "traces");
    for (const std::uint64_t id : traced) {
      core::TraceFileWriter file(trace(id));
      test::example_trace(200, [&](std::int64_t t_ns, auto record) { file.write(t_ns, record); });
      file.finish();
    }
  }
  const std::filesystem::path& path() const { return folder_.path(); }
  std::filesystem::path trace(std::uint64_t id) const {
    return folder_ / ("traces/trial_00000" + std::to_string(id) + ".mcap");
  }

 private:
  test::ScratchFolder folder_;
};

TEST_CASE("Replays of a run: by id with all their reasons; what cannot be had is counted", "[report]") {
  const Run run({0, 1, 3, 4});
  std::ofstream(run.trace(3), std::ios::trunc) << "no trace";
  const Replays replays = choose_and_encode_replays(run.path(), two_planners(), test::example_metrics(),
                                                    {{"time", "speed"}, 1'000'000, {}});
  REQUIRE(replays.replays.size() == 3);
  CHECK(replays.replays[0].trial == 0);
  CHECK(replays.replays[0].why == std::vector<std::string>{"worst"});
  CHECK(replays.replays[1].trial == 1);
  CHECK(replays.replays[1].why == std::vector<std::string>{"failure"});
  CHECK(replays.replays[2].trial == 4);

  REQUIRE(replays.left_out.size() == 4);
  CHECK(replays.left_out[0].why == "median");
  CHECK(replays.left_out[0].reason == "no trace was recorded");
  CHECK(replays.left_out[1].why == "worst");
  CHECK(replays.left_out[1].reason == "the trace cannot be read");
  CHECK(replays.left_out[2].why == "failure");
  CHECK(replays.left_out[3].why == "failure");
  CHECK(replays.left_out[3].trials == 1);

  const core::TraceBytes bytes = test::example_trace(200);
  core::TraceReader trace(bytes);
  CHECK(replays.replays[0].packed == base64(gzip(replay_json(trace, two_planners()[0]))));
}

TEST_CASE("The budget holds the most wanted replays", "[report]") {
  const Run run({0, 1, 2, 3, 4, 5});
  const ReplayPolicy all{{"time", "speed"}, 1'000'000, {}};
  const Replays everything = choose_and_encode_replays(run.path(), two_planners(), test::example_metrics(), all);
  REQUIRE(everything.replays.size() == 5);
  CHECK(everything.left_out.empty());
  std::map<std::uint64_t, std::size_t> bytes;
  for (const Replay& replay : everything.replays) bytes[replay.trial] = replay.packed.size();

  // room for the two medians, 4 and 5, exactly
  const ReplayPolicy little{{"time", "speed"}, bytes[4] + bytes[5], {}};
  const Replays few = choose_and_encode_replays(run.path(), two_planners(), test::example_metrics(), little);
  REQUIRE(few.replays.size() == 2);
  CHECK(few.replays[0].trial == 4);
  CHECK(few.replays[1].trial == 5);
  CHECK(few.replays[1].why == std::vector<std::string>{"median", "failure"});
  REQUIRE(few.left_out.size() == 2);
  CHECK(few.left_out[0].why == "worst");
  CHECK(few.left_out[0].trials == 2);
  CHECK(few.left_out[1].why == "failure");
  CHECK(few.left_out[1].trials == 2);
}

}  // namespace
}  // namespace dmrp::host
