// SPDX-License-Identifier: MIT
#include "host/process/line_channel.hpp"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

namespace line_channel_test {

using namespace dmrp::host;
using nlohmann::json;

// A channel to itself; `raw` writes bytes that are not messages.
struct Loop {
  Loop() {
    Pipe pipe = make_pipe();
    write_end = pipe.write_end.number();
    channel = std::make_unique<LineChannel>(std::move(pipe.read_end), std::move(pipe.write_end));
  }
  void raw(const std::string& bytes) const {
    REQUIRE(write(write_end, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size()));
  }
  int write_end = -1;
  std::unique_ptr<LineChannel> channel;
};

// Two connected channels.
struct Pair {
  Pair() {
    Pipe there = make_pipe();
    Pipe back = make_pipe();
    near = std::make_unique<LineChannel>(std::move(back.read_end), std::move(there.write_end));
    far = std::make_unique<LineChannel>(std::move(there.read_end), std::move(back.write_end));
  }
  std::unique_ptr<LineChannel> near;
  std::unique_ptr<LineChannel> far;
};

TEST_CASE("messages arrive one by one, in order") {
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

TEST_CASE("a damaged line is discarded, and the next one is whole") {
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

TEST_CASE("invalid UTF-8 is replaced") {
  const Loop loop;
  REQUIRE(loop.channel->send({{"text", "a\xff z"}}));
  const auto got = loop.channel->receive();
  REQUIRE(got);
  CHECK(got->at("text") == "a\uFFFD z");
}

TEST_CASE("the other side closes") {
  Pair pair;
  pair.near.reset();
  CHECK_FALSE(pair.far->fill());
  CHECK_FALSE(pair.far->receive());
}

}  // namespace line_channel_test
