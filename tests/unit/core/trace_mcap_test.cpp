// SPDX-License-Identifier: MIT
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstring>
#include <dmrp/toolkit/random.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <tuple>
#include <vector>

#include "core/mcap_reader.hpp"
#include "core/trace_file.hpp"
#include "core/trace_reader.hpp"
#include "trace_example.hpp"

using namespace dmrp::core;
using dmrp::test::example_trace;

namespace {

// A path of this test alone, removed with it.
class ScratchFile {
 public:
  ScratchFile() : path_(std::filesystem::temp_directory_path() / ("dmrp_mcap_" + std::to_string(::getpid()))) {}
  ~ScratchFile() { std::filesystem::remove(path_); }
  const std::filesystem::path& path() const { return path_; }

  TraceBytes bytes() const {
    std::ifstream file(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  }
  void replace(const TraceBytes& bytes) const {
    std::ofstream(path_, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  }

 private:
  std::filesystem::path path_;
};

// About five chunks.
constexpr std::int64_t many_samples = 10'000;

TraceBytes write_example(const ScratchFile& file, std::int64_t samples, bool finish = true) {
  TraceFileWriter writer(file.path());
  const TraceBytes trace = example_trace(
      samples, [&](std::int64_t t_ns, std::span<const std::uint8_t> record) { writer.write(t_ns, record); });
  if (finish) writer.finish();
  return trace;
}

template <class Value>
Value value_at(const TraceBytes& bytes, std::size_t offset) {
  Value value;
  std::memcpy(&value, &bytes.at(offset), sizeof(value));
  return value;
}

std::span<const std::uint8_t> bytes_of(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

}  // namespace

TEST_CASE("a trace comes back from its file", "[mcap]") {
  const ScratchFile file;
  const std::int64_t samples = GENERATE(std::int64_t{0}, std::int64_t{3}, many_samples);
  const TraceBytes trace = write_example(file, samples);
  CHECK(read_trace_file(file.path()) == trace);
}

TEST_CASE("a trace without its end can be read up to the last whole chunk", "[mcap]") {
  const ScratchFile file;
  const TraceBytes trace = write_example(file, many_samples, false);
  const TraceBytes whole = file.bytes();
  for (const std::size_t length : {whole.size(), whole.size() - 1, whole.size() / 2}) {
    file.replace(TraceBytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length)));
    const TraceBytes part = read_trace_file(file.path());
    CHECK(part.size() > 900'000);
    REQUIRE(part.size() < trace.size());
    CHECK(std::equal(part.begin(), part.end(), trace.begin()));
    TraceReader reader(part);
    CHECK(reader.sample_count() > 1000);
    CHECK(reader.end() == nullptr);
  }
}

TEST_CASE("a damaged file is refused", "[mcap]") {
  const ScratchFile file;
  write_example(file, 100);
  TraceBytes bytes = file.bytes();
  SECTION("no MCAP file at all") {
    bytes[1] = 'X';
  }
  SECTION("a byte of a chunk") {
    bytes[bytes.size() / 3] ^= 0x10;
  }
  file.replace(bytes);
  CHECK_THROWS_AS(read_trace_file(file.path()), TraceError);
  std::filesystem::remove(file.path());
  CHECK_THROWS_AS(read_trace_file(file.path()), std::system_error);
}

TEST_CASE("whatever byte is wrong, a file is read or refused", "[mcap]") {
  const ScratchFile file;
  const TraceBytes trace = write_example(file, 60);
  const TraceBytes whole = file.bytes();
  dmrp::toolkit::Stream random(1, "mcap.damage");
  int refused = 0;
  int other = 0;  // neither refused nor the whole trace: cut short, or another trace altogether
  for (int round = 0; round < 3000; ++round) {
    TraceBytes damaged = whole;
    damaged[random.below(damaged.size())] ^= static_cast<std::uint8_t>(1 + random.below(255));
    TraceBytes found;
    try {
      read_mcap(damaged, "dmrp/trace", [&](std::int64_t, std::span<const std::uint8_t> record) {
        found.insert(found.end(), record.begin(), record.end());
      });
      if (found != trace) {
        ++other;
        CHECK(found.empty());  // the one chunk's opcode or length was hit, so that it was not seen
      }
    } catch (const TraceError&) {
      ++refused;
    }
  }
  CHECK(refused > 1500);
  CHECK(other < 30);
}

TEST_CASE("several channels share a file, each read by its topic", "[mcap]") {
  const ScratchFile file;
  McapWriter writer(file.path());
  const std::uint16_t schema = writer.add_schema({"example.Text", "jsonschema", "{}"});
  const std::uint16_t first = writer.add_channel({"first", "json", schema, {}});
  const std::uint16_t second = writer.add_channel({"second", "json", schema, {{"key", "value"}}});
  CHECK(first != second);
  writer.write(first, 10, bytes_of("a"));
  writer.write(second, 20, bytes_of("bb"));
  writer.write(first, 15, bytes_of(""));
  writer.finish();

  using Message = std::tuple<std::int64_t, std::string>;
  const auto messages = [&](std::string_view topic) {
    std::vector<Message> found;
    CHECK(read_mcap(file.bytes(), topic, [&](std::int64_t t_ns, std::span<const std::uint8_t> message) {
      found.emplace_back(t_ns, std::string(message.begin(), message.end()));
    }));
    return found;
  };
  CHECK(messages("first") == std::vector<Message>{{10, "a"}, {15, ""}});
  CHECK(messages("second") == std::vector<Message>{{20, "bb"}});
  CHECK(messages("third").empty());
}

TEST_CASE("the file ends with a summary whose offsets lead to its records", "[mcap]") {
  const ScratchFile file;
  write_example(file, many_samples);
  const TraceBytes bytes = file.bytes();
  const std::size_t footer = bytes.size() - mcap_magic.size() - 20 - mcap_record_prefix_bytes;
  REQUIRE(bytes[footer] == static_cast<std::uint8_t>(McapOpcode::footer));
  CHECK(value_at<std::uint64_t>(bytes, footer + 1) == 20);
  const auto summary = value_at<std::uint64_t>(bytes, footer + 9);
  const auto offsets = value_at<std::uint64_t>(bytes, footer + 17);
  CHECK(bytes.at(summary) == static_cast<std::uint8_t>(McapOpcode::channel));  // there is no schema
  std::vector<std::uint8_t> groups;
  for (std::size_t at = offsets; at < footer; at += mcap_record_prefix_bytes + 17) {
    REQUIRE(bytes.at(at) == static_cast<std::uint8_t>(McapOpcode::summary_offset));
    groups.push_back(bytes.at(at + 9));
    CHECK(bytes.at(value_at<std::uint64_t>(bytes, at + 10)) == groups.back());
  }
  CHECK(groups == std::vector<std::uint8_t>{0x04, 0x08, 0x0B});
}
