// SPDX-License-Identifier: MIT
// Metrics read the same trace from memory and from the spool; no scratch file is left.
#include "host/trial/kept_trace.hpp"

#include <stdlib.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <string>

#include "tests/unit/core/trace/trace_example.hpp"

namespace kept_trace_test {

namespace fs = std::filesystem;
namespace core = dmrp::core;
using dmrp::host::KeptTrace;
using dmrp::test::example_trace;

class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name = (fs::temp_directory_path() / "dmrp_kept_XXXXXX").string();
    REQUIRE(mkdtemp(name.data()));
    path_ = name;
  }
  ~ScratchFolder() { fs::remove_all(path_); }
  fs::path operator/(const char* name) const { return path_ / name; }
  bool is_empty() const { return fs::is_empty(path_); }

 private:
  fs::path path_;
};

// About two megabytes: two chunks and an incomplete one.
constexpr std::int64_t samples = 4000;

core::TraceBytes write_example(KeptTrace& kept) {
  return example_trace(
      samples, [&](std::int64_t t_ns, std::span<const std::uint8_t> record) { kept.write(t_ns, record); },
      kept.foxglove());
}

core::TraceBytes pass(core::TraceRecords& records) {
  core::TraceBytes bytes;
  while (const auto record = records.next()) bytes.insert(bytes.end(), record->whole.begin(), record->whole.end());
  records.rewind();
  return bytes;
}

TEST_CASE("A trace that is not recorded is read as it was written, from memory or from a spool") {
  const ScratchFolder folder;
  const std::size_t most_bytes_in_memory = GENERATE(std::size_t{0}, std::size_t{500'000}, std::size_t{10'000'000});
  KeptTrace kept({}, folder / "scratch", most_bytes_in_memory);
  CHECK_FALSE(kept.is_recorded());
  CHECK(kept.foxglove() == nullptr);
  const core::TraceBytes trace = write_example(kept);
  CHECK(folder.is_empty());
  core::TraceRecords records = kept.records();
  CHECK(pass(records) == trace);
  CHECK(pass(records) == trace);
  kept.finish();
  CHECK(folder.is_empty());
}

TEST_CASE("A recorded trace is read while its file waits for what metrics find") {
  const ScratchFolder folder;
  const std::size_t most_bytes_in_memory = GENERATE(std::size_t{0}, std::size_t{10'000'000});
  KeptTrace kept(folder / "recorded", folder / "scratch", most_bytes_in_memory);
  const core::TraceBytes trace = write_example(kept);
  core::TraceRecords records = kept.records();
  CHECK(pass(records) == trace);
  CHECK(pass(records) == trace);
  REQUIRE(kept.foxglove());
  kept.foxglove()->metric_event({"sto", 0, 1'000'000'000, {}, "near"});
  kept.finish();
  CHECK_FALSE(fs::exists(folder / "scratch"));

  core::TraceRecords stored(folder / "recorded");
  CHECK(pass(stored) == trace);
  core::McapReader events(folder / "recorded", "/metric_events");
  CHECK(events.next());
  CHECK_FALSE(events.next());
  CHECK(events.is_whole());
}

TEST_CASE("Where no spool can be made, a large trace says so") {
  const ScratchFolder folder;
  KeptTrace kept({}, folder / "gone" / "scratch", 0);
  CHECK_THROWS_AS(write_example(kept), std::system_error);
}

}  // namespace kept_trace_test
