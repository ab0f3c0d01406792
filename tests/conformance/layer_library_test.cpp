// SPDX-License-Identifier: MIT
// What belongs to the library as a whole: what loads once, and the extensions of host and plugin.
#include <catch2/catch.hpp>
#include <dmrp/plugin.hpp>
#include <string>
#include <vector>

#include "tests/conformance/calls.hpp"

using namespace dmrp::test;

namespace {

// Calls init(), and has load() of sample.controller and unload() of sample.controller do this.
std::int32_t init(RecordingHost& host, const char* load_does, const char* unload_does = "nothing") {
  seen().loaded.clear();
  seen().unloaded.clear();
  seen().load_does = load_does;
  seen().unload_does = unload_does;
  return dmrp_entry_v1.init(&dmrp_entry_v1, &host.c);
}

}  // namespace

TEST_CASE("init() loads each class once, with the library's host, and deinit() unloads it") {
  RecordingHost host;
  REQUIRE(init(host, "nothing") == DMRP_OK);
  CHECK(seen().loaded == std::vector<std::string>{"sample.controller from /plugins/libsample.so", "sample.central"});
  {
    const Sample first("sample.controller", "nothing");
    const Sample second("sample.controller", "nothing");
    CHECK(seen().loaded.size() == 2);
  }
  CHECK(seen().unloaded.empty());
  dmrp_entry_v1.deinit(&dmrp_entry_v1);
  CHECK(seen().unloaded.size() == 2);
}

TEST_CASE("an exception of load() becomes the status of init()") {
  RecordingHost host;
  CHECK(init(host, "throw") == DMRP_ERROR);
  CHECK(host.error == "thrown on purpose");
  CHECK(init(host, "throw number") == DMRP_ERROR);
  CHECK(host.error == "an exception that is no std::exception");
  CHECK(init(host, "throw bad_alloc") == DMRP_OUT_OF_MEMORY);
}

TEST_CASE("an exception of unload() does not get out, and the other classes are unloaded") {
  RecordingHost host;
  REQUIRE(init(host, "nothing", "throw") == DMRP_OK);
  CHECK_NOTHROW(dmrp_entry_v1.deinit(&dmrp_entry_v1));
  CHECK(seen().unloaded == std::vector<std::string>{"sample.controller", "sample.central"});
}

TEST_CASE("extension<T>() gives an extension by its type, find_extension<T>() may give none") {
  Sample sample("sample.controller", "ask");
  const dmrp_lidar lidar = {sizeof(lidar), 0, nullptr, nullptr};
  const sample_extension number = {sizeof(number), 17};
  sample.host.offers = {{DMRP_EXT_LIDAR, &lidar}, {SAMPLE_EXTENSION, &number}};
  REQUIRE(sample.start() == DMRP_OK);
  CHECK(sample.host.log == std::vector<std::string>{std::to_string(DMRP_LOG_DEBUG) + " no annotations",
                                                    std::to_string(DMRP_LOG_INFO) + " the lidar has 24",
                                                    std::to_string(DMRP_LOG_INFO) + " the number is 17"});

  const Sample in_vain("sample.controller", "ask in vain");
  CHECK(in_vain.start() == DMRP_ERROR);
  CHECK(in_vain.host.error == "the host gives no dmrp.lidar/1: declare it in describe() by needs() or uses()");
}

TEST_CASE("a plugin offers extensions of its own") {
  const Sample sample("sample.controller", "nothing");
  REQUIRE(sample.c.get_extension != nullptr);
  const void* offered = sample.c.get_extension(sample.c.self, "sample/1");
  REQUIRE(offered != nullptr);
  CHECK(*static_cast<const int*>(offered) == 5);
  CHECK(sample.c.get_extension(sample.c.self, "sample/2") == nullptr);
}
