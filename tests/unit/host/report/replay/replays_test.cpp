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

namespace replays_test {

using namespace dmrp;
using namespace dmrp::host;
using dmrp::test::example_trial;

// Three repetitions of two planners: A takes 30, 10 and 20 s, B arrives never.
std::vector<TrialRecord> two_planners() {
  std::vector<TrialRecord> trials = {example_trial(0, "A", 0, 30.0, 0.5), example_trial(1, "B", 0, {}, 0.3),
                                     example_trial(2, "A", 1, 10.0, 0.5), example_trial(3, "B", 1, {}, 0.1),
                                     example_trial(4, "A", 2, 20.0, 0.5), example_trial(5, "B", 2, {}, 0.2)};
  return trials;
}

std::vector<std::pair<std::uint64_t, std::string>> candidates_of(const std::vector<TrialRecord>& trials,
                                                                 const std::vector<std::string>& rank_by,
                                                                 const std::vector<std::uint64_t>& asked = {}) {
  std::vector<std::pair<std::uint64_t, std::string>> list;
  for (const ReplayCandidate& candidate : replay_candidates(trials, dmrp::test::example_metrics(), rank_by, asked))
    list.emplace_back(trials[candidate.trial].id, candidate.why);
  return list;
}

using Candidates = std::vector<std::pair<std::uint64_t, std::string>>;

TEST_CASE("median and worst trials precede failures, by the first metric that a combination has", "[report]") {
  // "time" is undefined for all of B, so "speed" ranks it: higher is better
  CHECK(candidates_of(two_planners(), {"time", "speed"}) ==
        Candidates{
            {4, "median"}, {5, "median"}, {0, "worst"}, {3, "worst"}, {1, "failure"}, {3, "failure"}, {5, "failure"}});
  CHECK(candidates_of(two_planners(), {"time"}) ==
        Candidates{{4, "median"}, {0, "worst"}, {1, "failure"}, {3, "failure"}, {5, "failure"}});
  CHECK(candidates_of(two_planners(), {}, {2, 77}) ==
        Candidates{{2, "asked"}, {1, "failure"}, {3, "failure"}, {5, "failure"}});
}

TEST_CASE("ties rank by id, the lower of two medians counts, skipped trials are ignored", "[report]") {
  std::vector<TrialRecord> trials = {example_trial(0, "A", 0, 10.0, 0.5), example_trial(1, "A", 1, 10.0, 0.5),
                                     example_trial(2, "A", 2, 10.0, 0.5), example_trial(3, "A", 3, 10.0, 0.5),
                                     example_trial(4, "A", 4, 90.0, 0.5)};
  trials[4].outcome = trial_outcome::skipped;
  CHECK(candidates_of(trials, {"time"}) == Candidates{{1, "median"}, {3, "worst"}});
}

TEST_CASE("faults precede failures, in rounds over all combinations", "[report]") {
  std::vector<TrialRecord> trials = two_planners();
  trials[0].outcome = trials[3].outcome = trials[4].outcome = trial_outcome::fault;
  CHECK(candidates_of(trials, {}) ==
        Candidates{{0, "fault"}, {3, "fault"}, {4, "fault"}, {1, "failure"}, {5, "failure"}});
}

// A run's folder with traces of these trials.
class Run {
 public:
  explicit Run(const std::vector<std::uint64_t>& traced) {
    std::filesystem::create_directory(folder_ / "traces");
    for (const std::uint64_t id : traced) {
      core::TraceFileWriter file(trace(id));
      dmrp::test::example_trace(200, [&](std::int64_t t_ns, auto record) { file.write(t_ns, record); });
      file.finish();
    }
  }
  const std::filesystem::path& path() const { return folder_.path(); }
  std::filesystem::path trace(std::uint64_t id) const {
    return folder_ / ("traces/trial_00000" + std::to_string(id) + ".mcap");
  }

 private:
  dmrp::test::ScratchFolder folder_;
};

TEST_CASE("replays are sorted by id with all reasons, and omitted ones are counted", "[report]") {
  const Run run({0, 1, 3, 4});
  std::ofstream(run.trace(3), std::ios::trunc) << "no trace";
  const Replays replays =
      encode_replays(run.path(), two_planners(), dmrp::test::example_metrics(), {{"time", "speed"}, 1'000'000, {}});
  REQUIRE(replays.replays.size() == 3);
  CHECK(replays.replays[0].trial == 0);
  CHECK(replays.replays[0].why == std::vector<std::string>{"worst"});
  CHECK(replays.replays[1].trial == 1);
  CHECK(replays.replays[1].why == std::vector<std::string>{"failure"});
  CHECK(replays.replays[2].trial == 4);

  REQUIRE(replays.omitted.size() == 4);
  CHECK(replays.omitted[0].why == "median");
  CHECK(replays.omitted[0].reason == "no trace was recorded");
  CHECK(replays.omitted[1].why == "worst");
  CHECK(replays.omitted[1].reason == "the trace cannot be read");
  CHECK(replays.omitted[2].why == "failure");
  CHECK(replays.omitted[3].why == "failure");
  CHECK(replays.omitted[3].trials == 1);

  const core::TraceBytes bytes = dmrp::test::example_trace(200);
  core::TraceReader trace(bytes);
  CHECK(replays.replays[0].packed == base64(gzip(replay_json(trace, two_planners()[0]))));
}

TEST_CASE("the budget is spent by priority", "[report]") {
  const Run run({0, 1, 2, 3, 4, 5});
  const ReplayPolicy all{{"time", "speed"}, 1'000'000, {}};
  const Replays everything = encode_replays(run.path(), two_planners(), dmrp::test::example_metrics(), all);
  REQUIRE(everything.replays.size() == 5);
  CHECK(everything.omitted.empty());
  std::map<std::uint64_t, std::size_t> bytes;
  for (const Replay& replay : everything.replays) bytes[replay.trial] = replay.packed.size();

  // room for the two medians, 4 and 5, exactly
  const ReplayPolicy little{{"time", "speed"}, bytes[4] + bytes[5], {}};
  const Replays few = encode_replays(run.path(), two_planners(), dmrp::test::example_metrics(), little);
  REQUIRE(few.replays.size() == 2);
  CHECK(few.replays[0].trial == 4);
  CHECK(few.replays[1].trial == 5);
  CHECK(few.replays[1].why == std::vector<std::string>{"median", "failure"});
  REQUIRE(few.omitted.size() == 2);
  CHECK(few.omitted[0].why == "worst");
  CHECK(few.omitted[0].trials == 2);
  CHECK(few.omitted[1].why == "failure");
  CHECK(few.omitted[1].trials == 2);
}

}  // namespace replays_test
