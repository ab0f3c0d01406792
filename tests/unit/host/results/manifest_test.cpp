// SPDX-License-Identifier: MIT
#include "host/results/manifest.hpp"

#include <catch2/catch.hpp>

#include "host/files/atomic_file.hpp"
#include "host/files/sha256.hpp"
#include "tests/unit/host/results/results_example.hpp"

namespace manifest_test {

using namespace dmrp::host;
using dmrp::test::ScratchFolder;

TEST_CASE("a manifest can be written and read", "[results]") {
  const ScratchFolder folder;
  write_file_atomically(folder / "map.yaml", "abc");
  const auto begun = std::chrono::system_clock::time_point(std::chrono::seconds(1'700'000'000));
  Manifest manifest = new_manifest("0.1.0", {"dmrp-host", "a b.toml", "--jobs", "2"}, begun);
  manifest.commit = "597cdd0a1b2c";
  manifest.identity = {{"experiment.seed", "7"}};
  manifest.files.push_back(hashed_file("map", folder / "map.yaml"));
  manifest.plugin_limits = {"namespaces", "RLIMIT_DATA", {"org.example.helped"}};
  std::vector<TrialRecord> trials(3);
  trials[0].timing = {{"test.one", "reads a clock"}};
  trials[2].timing = {{"test.one", "reads a clock"}, {"test.two", "draws in a thread"}};
  count_unrepeatable(manifest.not_repeatable, trials);
  write_file_atomically(folder / "manifest.json", to_json_text(manifest));
  const Manifest read = read_manifest(folder / "manifest.json");

  CHECK(read.dmrp_version == "0.1.0");
  CHECK(read.command_line == manifest.command_line);
  CHECK(read.started_at == "2023-11-14T22:13:20Z");
  CHECK(read.commit == manifest.commit);
  CHECK(read.identity == manifest.identity);
  CHECK_FALSE(read.machine.libc.empty());
  CHECK_FALSE(read.machine.compiler.empty());
  REQUIRE(read.files.size() == 1);
  CHECK(read.files[0].role == "map");
  CHECK(read.files[0].sha256 == sha256_of_bytes("abc"));
  CHECK(read.plugin_limits.box == "namespaces");
  CHECK(read.plugin_limits.memory == "RLIMIT_DATA");
  CHECK(read.plugin_limits.with_processes == std::vector<std::string>{"org.example.helped"});
  REQUIRE(read.not_repeatable.size() == 2);
  CHECK(read.not_repeatable[0].reason == trials[0].timing[0]);
  CHECK(read.not_repeatable[0].trials == 2);
  CHECK(read.not_repeatable[1].trials == 1);
  CHECK(differences(manifest, read).empty());

  write_file_atomically(folder / "half.json", "{\"dmrp_version\": \"0.1.0\"");
  CHECK_THROWS_WITH(read_manifest(folder / "half.json"), Catch::Contains("half.json"));
}

TEST_CASE("manifests differ in what can change bits, and in nothing else", "[results]") {
  Manifest before;
  before.machine = {"glibc 2.36", "x86-64-v3", {"avx", "avx2", "erms", "fma"}, "gcc 12.2.0"};
  before.commit = "597cdd0a1b2c";
  before.files = {{"plugin library", "/a/libx.so", "11", "c1"}, {"plugin library", "/a/liby.so", "22", "c2"}};
  Manifest now = before;
  now.command_line = {"other"};
  now.started_at = "later";
  now.files = {{"plugin library", "/b/liby.so", "22", "c2"}, {"plugin library", "/b/libx.so", "12", "c1"}};  // stripped
  now.machine.cpu_features = {"avx", "avx2", "fma", "tsc"};
  CHECK(differences(before, now).empty());

  now.machine.libc = "glibc 2.37";
  now.machine.cpu_features = {"avx", "avx2", "tsc"};
  now.files[0].code = "c3";
  now.commit = "e7aacf7";
  CHECK(differences(before, now) ==
        std::vector<std::string>{"commit: 597cdd0a1b2c, now e7aacf7", "libc: glibc 2.36, now glibc 2.37",
                                 "CPU feature fma is missing now", "plugin library liby.so has changed"});
  now = before;
  now.files[1].path = "/a/libz.so";
  CHECK(differences(before, now) ==
        std::vector<std::string>{"plugin library liby.so is missing now", "plugin library libz.so is new"});
}

TEST_CASE("identities differ by keys, with hashes cut short", "[results]") {
  const std::string hash(64, 'a');
  const Identity before = {{"experiment.seed", "7"},
                           {"scenario[0].use", "\"hall " + hash + ", map.png " + hash + "\""}};
  CHECK(differences(before, before).empty());
  Identity now = before;
  now["scenario[0].use"] = "\"hall " + std::string(64, 'b') + "\"";
  now["robot.v_max"] = "0.8";
  now.erase("experiment.seed");
  const std::vector<KeyDifference> found = differences(before, now);
  REQUIRE(found.size() == 3);
  CHECK(found[0].key == "experiment.seed");
  CHECK(found[0].before == "7");
  CHECK(found[0].now == "missing");
  CHECK(found[1].before == "\"hall aaaaaaaaaaaa, map.png aaaaaaaaaaaa\"");
  CHECK(found[1].now == "\"hall bbbbbbbbbbbb\"");
  CHECK(found[2].key == "robot.v_max");
  CHECK(found[2].before == "missing");
}

}  // namespace manifest_test
