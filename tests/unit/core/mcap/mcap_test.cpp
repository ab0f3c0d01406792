// SPDX-License-Identifier: MIT
#include <unistd.h>

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <dmrp/toolkit/random.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "core/mcap/mcap_reader.hpp"
#include "core/trace/trace_file.hpp"
#include "core/trace/trace_reader.hpp"
#include "core/trace/trace_spool.hpp"
#include "tests/support/draws.hpp"
#include "tests/unit/core/trace/trace_example.hpp"

namespace mcap_test {

using namespace dmrp::core;
using dmrp::test::example_trace;

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
      samples, [&](std::int64_t t_ns, std::span<const std::uint8_t> record) { writer.write(t_ns, record); },
      &writer.foxglove());
  if (finish) writer.finish();
  return trace;
}

// All of it, however much of it is kept in memory.
TraceBytes read_trace(const std::filesystem::path& path, std::size_t most_bytes_in_memory) {
  TraceRecords records(path, most_bytes_in_memory);
  TraceBytes trace;
  while (const auto record = records.next()) trace.insert(trace.end(), record->whole.begin(), record->whole.end());
  return trace;
}
TraceBytes read_trace(const std::filesystem::path& path) {
  return read_trace(path, TraceRecords::small_trace_bytes);
}

template <class Value>
Value value_at(const TraceBytes& bytes, std::size_t offset) {
  Value value;
  std::memcpy(&value, &bytes.at(offset), sizeof(value));
  return value;
}

// The footer is followed by the magic bytes alone.
std::size_t footer_begin(const TraceBytes& bytes) {
  return bytes.size() - mcap_magic.size() - 20 - mcap_record_prefix_bytes;
}

std::size_t summary_begin(const TraceBytes& bytes) {
  return value_at<std::uint64_t>(bytes, footer_begin(bytes) + 9);
}

std::span<const std::uint8_t> bytes_of(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

TEST_CASE("a trace comes back from its file", "[mcap]") {
  const ScratchFile file;
  const std::int64_t samples = GENERATE(std::int64_t{0}, std::int64_t{3}, many_samples);
  const TraceBytes trace = write_example(file, samples);
  CHECK(read_trace(file.path()) == trace);
}

TEST_CASE("a trace that stays in its file is read repeatedly", "[mcap]") {
  const ScratchFile file;
  const TraceBytes trace = write_example(file, many_samples);
  const std::size_t most_bytes_in_memory = GENERATE(std::size_t{0}, std::size_t{100'000}, std::size_t{100'000'000});
  TraceReader in_memory(trace);
  TraceReader in_file(TraceRecords(file.path(), most_bytes_in_memory), TraceExtent::samples);
  REQUIRE(in_file.end());
  CHECK(in_file.reason() == "time limit");
  CHECK(in_file.plans().size() == 3);
  CHECK(in_file.sample_count() == many_samples);
  CHECK(in_file.notes().empty());
  CHECK(in_file.scans().empty());
  CHECK(in_file.trajectories().empty());
  for (int round = 0; round < 10; ++round) in_file.next_sample();
  in_file.rewind();
  for (int pass = 0; pass < 2; ++pass) {
    in_memory.rewind();
    bool equal = true;
    while (const dmrp_sample* expected = in_memory.next_sample()) {
      const dmrp_sample* sample = in_file.next_sample();
      REQUIRE(sample);
      equal = equal && sample->t_ns == expected->t_ns && sample->plan->revision == expected->plan->revision &&
              std::memcmp(sample->people, expected->people, 2 * sizeof(dmrp_person)) == 0;
    }
    CHECK(equal);
    CHECK(in_file.next_sample() == nullptr);
    CHECK(in_file.next_sample() == nullptr);
    in_file.rewind();
  }
}

TEST_CASE("a spool gives records back, with any changes between them", "[mcap]") {
  const ScratchFile file;
  TraceSpool spool(file.path());
  CHECK_FALSE(std::filesystem::exists(file.path()));
  dmrp::toolkit::Stream random(1, "spool");
  std::vector<TraceBytes> written;
  std::size_t bytes = 0;
  for (int k = 0; k < 3000; ++k) {
    // as another one before, longer or shorter, with some bytes changed; sometimes of more than one mask
    const auto kind = static_cast<std::uint8_t>(1 + random.below(7));
    TraceBytes record = written.empty() ? TraceBytes() : written[random.below(written.size())];
    record.resize(trace_record_prefix_bytes + random.below(random.below(10) == 0 ? 20'000 : 300));
    for (std::uint64_t changes = random.below(8); changes > 0; --changes)
      record[random.below(record.size())] = static_cast<std::uint8_t>(random.below(256));
    const auto length = static_cast<std::uint32_t>(record.size() - trace_record_prefix_bytes);
    std::memcpy(record.data(), &length, sizeof(length));
    record[sizeof(length)] = kind;
    spool.write(record);
    bytes += record.size();
    written.push_back(std::move(record));
  }
  CHECK(bytes > 3'000'000);
  for (int pass = 0; pass < 2; ++pass) {
    spool.rewind();
    std::size_t equal = 0;
    for (const TraceBytes& expected : written) {
      const auto record = spool.next();
      REQUIRE(record);
      equal += std::equal(record->begin(), record->end(), expected.begin(), expected.end()) ? 1U : 0U;
    }
    CHECK(equal == written.size());
    CHECK_FALSE(spool.next());
  }
}

TEST_CASE("a trace without its end can be read up to the last whole chunk", "[mcap]") {
  const ScratchFile file;
  const TraceBytes trace = write_example(file, many_samples, false);
  const TraceBytes whole = file.bytes();
  for (const std::size_t length : {whole.size(), whole.size() - 1, whole.size() / 2}) {
    file.replace(TraceBytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length)));
    const TraceBytes part = read_trace(file.path());
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
  CHECK_THROWS_AS(read_trace(file.path()), TraceError);
  std::filesystem::remove(file.path());
  CHECK_THROWS_AS(read_trace(file.path()), std::system_error);
}

TEST_CASE("with any wrong byte a file is read or refused", "[mcap]") {
  const ScratchFile file;
  const TraceBytes trace = write_example(file, 60);
  const TraceBytes whole = file.bytes();
  dmrp::toolkit::Stream random(1, "mcap.damage");
  int refused = 0;
  int other = 0;  // neither refused nor the whole trace: cut short, or another trace altogether
  for (int round = 0; round < dmrp::test::draws(3000); ++round) {
    TraceBytes damaged = whole;
    damaged[random.below(summary_begin(whole))] ^= static_cast<std::uint8_t>(1 + random.below(255));
    TraceBytes found;
    try {
      file.replace(damaged);
      found = read_trace(file.path());
      if (found != trace) {
        ++other;
        CHECK(found.empty());  // the one chunk's opcode or length was hit, so that it was not seen
      }
    } catch (const TraceError&) {
      ++refused;
    }
  }
  CHECK(refused > dmrp::test::draws(1500));
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
  const auto messages = [&](const char* topic) {
    std::vector<Message> found;
    McapReader reader(file.path(), topic);
    while (const auto message = reader.next())
      found.emplace_back(message->log_time_ns, std::string(message->data.begin(), message->data.end()));
    CHECK(reader.is_whole());
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
  const std::size_t footer = footer_begin(bytes);
  REQUIRE(bytes[footer] == static_cast<std::uint8_t>(McapOpcode::footer));
  CHECK(value_at<std::uint64_t>(bytes, footer + 1) == 20);
  const std::size_t summary = summary_begin(bytes);
  const auto offsets = value_at<std::uint64_t>(bytes, footer + 17);
  CHECK(bytes.at(summary) == static_cast<std::uint8_t>(McapOpcode::schema));
  std::vector<std::uint8_t> groups;
  for (std::size_t at = offsets; at < footer; at += mcap_record_prefix_bytes + 17) {
    REQUIRE(bytes.at(at) == static_cast<std::uint8_t>(McapOpcode::summary_offset));
    groups.push_back(bytes.at(at + 9));
    CHECK(bytes.at(value_at<std::uint64_t>(bytes, at + 10)) == groups.back());
  }
  CHECK(groups == std::vector<std::uint8_t>{0x03, 0x04, 0x08, 0x0B});
}

TEST_CASE("numbers in messages have four decimals and are always finite", "[mcap]") {
  const auto text = [](double value) { return JsonText().number(value).text(); };
  CHECK(text(0.0) == "0");
  CHECK(text(-0.00004) == "0");
  CHECK(text(0.00005) == "0.0001");
  CHECK(text(-1.25) == "-1.25");
  CHECK(text(12.3456789) == "12.3457");
  CHECK(text(-3.0) == "-3");
  CHECK(text(0.99999) == "1");
  CHECK(text(1e15) == "0");
  CHECK(text(std::nan("")) == "0");
  CHECK(JsonText().string("a \"b\"\\\n\x01 \xC3\xB6").text() == "\"a \\\"b\\\"\\\\\\u000a\\u0001 \xC3\xB6\"");
}

TEST_CASE("a trace file contains the channels for Foxglove", "[mcap]") {
  const ScratchFile file;
  {
    TraceFileWriter writer(file.path());
    example_trace(
        12, [&](std::int64_t t_ns, std::span<const std::uint8_t> record) { writer.write(t_ns, record); },
        &writer.foxglove());
    const std::array<std::uint32_t, 2> robots{0, 1};
    writer.foxglove().metric_event({"sto", 40'000'000, 1'240'000'000, robots, "near"});
    writer.finish();
  }
  std::vector<std::string> seen;
  std::vector<std::int64_t> times;
  const auto read = [&](const char* topic) {
    seen.clear();
    times.clear();
    McapReader reader(file.path(), topic);
    while (const auto message = reader.next()) {
      times.push_back(message->log_time_ns);
      seen.emplace_back(message->data.begin(), message->data.end());
    }
    return seen.size();
  };
  const auto has = [&](std::size_t message, const char* part) {
    return seen.at(message).find(part) != std::string::npos;
  };

  // 12 samples 20 ms apart: shown are 0, 0.1, 0.2 and, the last, 0.22 s
  REQUIRE(read("/tf") == 4);
  CHECK(times == std::vector<std::int64_t>{0, 100'000'000, 200'000'000, 220'000'000});
  CHECK(has(3, R"("timestamp":{"sec":0,"nsec":220000000},"parent_frame_id":"map","child_frame_id":"robot_0",)"
               R"("translation":{"x":3.6667,"y":0.1,"z":0},"rotation":{"x":0,"y":0,"z":0,"w":1})"));
  REQUIRE(read("/people") == 3);
  CHECK(has(1, R"("position":{"x":1,"y":1.6667,"z":0.85})"));
  CHECK(read("/map") == 1);
  CHECK(has(0, R"("metadata":[{"key":"name","value":"shelf"}])"));
  CHECK(read("/robots") == 2);  // the second arrives at once
  CHECK(has(1, R"({"key":"state","value":"finished"})"));
  CHECK(read("/plan") == 2);
  CHECK(read("/contacts") == 4);  // one begins at every third sample
  REQUIRE(read("/robot_1/scan") == 1);
  CHECK(has(0, R"("start_angle":-0.5,"end_angle":0.5,"ranges":[1.5,0,0.25])"));
  CHECK(read("/predictions") == 1);
  REQUIRE(read("/metric_events") == 1);
  CHECK(times == std::vector<std::int64_t>{40'000'000});
  CHECK(has(0,
            "\"message\":\"near: r0, r\xC3\xB6"
            "1\",\"name\":\"sto\""));
  REQUIRE(read("/metric_events/robots") == 1);
  CHECK(has(0, R"("lifetime":{"sec":1,"nsec":200000000},"frame_locked":true)"));
  REQUIRE(read("/log") == 9);  // two plans and one that failed, a note, four contacts, the end
  CHECK(has(0, "plan 1 found"));
  CHECK(has(8, R"("message":"time limit","name":"trial")"));
}

}  // namespace mcap_test
