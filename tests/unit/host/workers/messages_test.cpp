// SPDX-License-Identifier: MIT
// What supervisor and worker say to each other arrives as it was said.
#include "host/workers/messages.hpp"

#include <unistd.h>

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "host/process/line_channel.hpp"

namespace {

using namespace dmrp::host;
using nlohmann::json;

template <class T>
T through_text(const T& value) {
  return json::parse(json(value).dump()).template get<T>();
}

// A channel to itself; `raw` writes what no channel would.
struct Loop {
  Loop() {
    REQUIRE(pipe(ends.data()) == 0);
    channel = std::make_unique<LineChannel>(Descriptor(ends[0]), Descriptor(ends[1]));
  }
  void raw(const std::string& bytes) const {
    REQUIRE(write(ends[1], bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size()));
  }
  std::array<int, 2> ends{};
  std::unique_ptr<LineChannel> channel;
};

// Two channels, each other's ends.
struct Pair {
  Pair() {
    std::array<int, 2> there{};
    std::array<int, 2> back{};
    REQUIRE(pipe(there.data()) == 0);
    REQUIRE(pipe(back.data()) == 0);
    near = std::make_unique<LineChannel>(Descriptor(back[0]), Descriptor(there[1]));
    far = std::make_unique<LineChannel>(Descriptor(there[0]), Descriptor(back[1]));
  }
  std::unique_ptr<LineChannel> near;
  std::unique_ptr<LineChannel> far;
};

}  // namespace

TEST_CASE("messages keep all their fields") {
  const Job job = through_text(
      Job{1ull << 40, "traces/trial_000007.mcap", "trial_000007.scratch", false, {2, 5}, {{"sto", 1, 2, {3}, "near"}}});
  CHECK(job.trial == 1ull << 40);
  CHECK(job.trace_file == "traces/trial_000007.mcap");
  CHECK(job.scratch_file == "trial_000007.scratch");
  CHECK_FALSE(job.keep_trace_of_success);
  CHECK(job.skip_metrics == std::vector<std::uint32_t>{2, 5});
  REQUIRE(job.known_events.size() == 1);
  CHECK(job.known_events[0].robots == std::vector<std::uint32_t>{3});

  const TrialDone done = through_text(TrialDone{trial_outcome::failed, false, 0.1 + 0.2});
  CHECK(done.outcome == "failed");
  CHECK_FALSE(done.repeatable);
  CHECK(done.sim_time_s == 0.1 + 0.2);

  const FaultRecord fault = through_text(FaultRecord{"crash", "org.x", "step", -1, 3, 11, "a \"b\"\n", "dmrp-host x"});
  CHECK(fault.kind == "crash");
  CHECK(fault.plugin == "org.x");
  CHECK(fault.function == "step");
  CHECK(fault.step == -1);
  CHECK(fault.robot == 3);
  CHECK(fault.signal == 11);
  CHECK(fault.detail == "a \"b\"\n");
  CHECK(fault.rerun == "dmrp-host x");
}

TEST_CASE("metric values keep their bits, and what is undefined stays so") {
  const double odd[] = {0.0,    -0.0, 0.1, 1.0 / 3.0, 5e-324, 2.2250738585072014e-308, 1.7976931348623157e308,
                        -1e-17, 1e22};
  MetricResult sent;
  sent.index = 4;
  for (const double value : odd) sent.values.push_back({"length", DMRP_SUBJECT_ROBOT, 7, value, value});
  sent.values.push_back({"length", DMRP_SUBJECT_SYSTEM, std::nullopt, std::nullopt, std::nullopt});
  sent.events.push_back({"sto", 10, 9'000'000'000'000'000'001, {0, 3}, "near"});
  const MetricResult got = through_text(sent);
  CHECK(got.index == 4);
  REQUIRE(got.values.size() == sent.values.size());
  for (std::size_t i = 0; i < std::size(odd); ++i) {
    REQUIRE(got.values[i].value);
    REQUIRE(got.values[i].coordinate);
    CHECK(std::memcmp(&*got.values[i].value, &odd[i], sizeof(double)) == 0);
    CHECK(std::memcmp(&*got.values[i].coordinate, &odd[i], sizeof(double)) == 0);
    CHECK(got.values[i].subject == 7);
    CHECK(got.values[i].subject_kind == DMRP_SUBJECT_ROBOT);
  }
  CHECK_FALSE(got.values.back().subject);
  CHECK_FALSE(got.values.back().coordinate);
  CHECK_FALSE(got.values.back().value);
  REQUIRE(got.events.size() == 1);
  CHECK(got.events[0].to_ns == 9'000'000'000'000'000'001);
  CHECK(got.events[0].robots == std::vector<std::uint32_t>{0, 3});
}

TEST_CASE("messages come through a channel one by one, in order") {
  const Pair pair;
  REQUIRE(pair.near->send({{"type", "a"}, {"text", "two\nlines"}}));
  REQUIRE(pair.near->send({{"type", "b"}}));
  REQUIRE(pair.far->send({{"type", "answer"}}));
  CHECK(pair.far->receive() == json({{"type", "a"}, {"text", "two\nlines"}}));
  CHECK(pair.far->receive() == json({{"type", "b"}}));
  CHECK(pair.near->receive() == json({{"type", "answer"}}));
}

TEST_CASE("a message larger than a pipe") {
  const Pair pair;
  const json large = std::string(1 << 20, 'x');
  std::thread writer([&] { pair.near->send(large); });
  const auto got = pair.far->receive();
  writer.join();
  CHECK(got == large);
}

TEST_CASE("fill and take: a message that comes in pieces") {
  const Loop loop;
  loop.raw("{\"type\":");
  REQUIRE(loop.channel->fill());
  CHECK_FALSE(loop.channel->take());
  loop.raw("\"done\"}\n{\"type\":\"next\"}\n{\"ty");
  REQUIRE(loop.channel->fill());
  CHECK(loop.channel->take() == json({{"type", "done"}}));
  CHECK(loop.channel->take() == json({{"type", "next"}}));
  CHECK_FALSE(loop.channel->take());
}

TEST_CASE("a damaged line is told apart, and the next one is whole") {
  const Loop loop;
  loop.raw("{oops\n\n[1]\n");
  REQUIRE(loop.channel->fill());
  for (int i = 0; i < 2; ++i) {
    const auto damaged = loop.channel->take();
    REQUIRE(damaged);
    CHECK(damaged->is_discarded());
  }
  CHECK(loop.channel->take() == json::array({1}));
  loop.raw("}\n");
  CHECK_FALSE(loop.channel->receive());
}

TEST_CASE("text that is no UTF-8 is replaced, not refused") {
  const Loop loop;
  REQUIRE(loop.channel->send({{"text", "a\xff z"}}));
  const auto got = loop.channel->receive();
  REQUIRE(got);
  CHECK(got->at("text") == "a\uFFFD z");
}

TEST_CASE("the end of the other side") {
  Pair pair;
  pair.near.reset();
  CHECK_FALSE(pair.far->fill());
  CHECK_FALSE(pair.far->receive());
}
