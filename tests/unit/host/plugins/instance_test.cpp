// SPDX-License-Identifier: MIT
// An instance and its host: what a plugin gets, and what becomes of its breaches.
#include <dmrp/ext/lidar.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <map>

#include "tests/support/instance_pool.hpp"
#include "tests/unit/host/plugins/odd_library.hpp"

namespace instance_test {

using namespace dmrp::host;
using namespace dmrp::test;

// Of no function but the controllers' and planners'. 20 is an answer of a later minor version.
const std::map<int, std::string> status_names = {
    {2, "DMRP_NO_SOLUTION (2)"}, {3, "DMRP_TIMEOUT (3)"}, {20, "DMRP_NO_SOLUTION (20)"}, {64, "64"}};

void check_breach(const PluginFault& fault, const std::string& function, int status) {
  INFO(function << " " << status << ": " << fault.what());
  CHECK(fault.kind() == std::string(fault_kind::abi_breach));
  CHECK(fault.function() == function);
  CHECK_THAT(fault.what(), Catch::Contains(status_names.at(status)));
}

TEST_CASE("create and start may not return NO_SOLUTION or TIMEOUT") {
  for (const auto& [status, name] : status_names)
    for (const std::string function : {"create", "start"}) {
      OddInstances odd;
      check_breach(odd.fault(function + " " + std::to_string(status)), function, status);
    }
  OddInstances odd;
  CHECK_NOTHROW(odd.start(odd.make("create 1")));
  CHECK_NOTHROW(odd.start(odd.make("start 1")));
  CHECK(odd.fault("create 5").kind() == std::string(fault_kind::error_status));
  CHECK(odd.fault("create 42").kind() == std::string(fault_kind::error_status));  // an error of a later minor version
  CHECK(odd.fault("create 7").kind() == std::string(fault_kind::abi_breach));
  CHECK(odd.fault("start 7").kind() == std::string(fault_kind::unsupported));
  CHECK(odd.fault("start 6").fatal());
}

TEST_CASE("init may not return NO_SOLUTION or TIMEOUT") {
  const OddLibrary odd;
  static int status;
  odd.entry().init = [](const dmrp_entry*, const dmrp_host*) -> std::int32_t { return status; };
  CallNote note{};
  CallGuard guard{note};
  const std::vector<LibraryUse> uses = {{"odd", DMRP_ODD_PLUGINS, {}}};
  const auto open = [&] { InstancePool(uses, guard, [](auto, const auto&, const auto&) {}); };
  for (const auto& [answer, name] : status_names) {
    status = answer;
    try {
      open();
      FAIL("no fault");
    } catch (const PluginFault& fault) {
      check_breach(fault, "init", answer);
    }
  }
  status = DMRP_WARNING;
  CHECK_NOTHROW(open());
}

TEST_CASE("trial_end may not return NO_SOLUTION or TIMEOUT") {
  const dmrp_trial_end end{};
  for (const auto& [status, name] : status_names) {
    OddInstances odd;
    Instance& instance = odd.make("trial_end " + std::to_string(status));
    odd.start(instance);
    try {
      instance.end_trial(end, 7, 1'000'000'000);
      FAIL("no fault");
    } catch (const PluginFault& fault) {
      check_breach(fault, "trial_end", status);
      CHECK(fault.step() == 7);
    }
  }
}

TEST_CASE("create() that writes beyond dmrp_plugin is a breach, near and far") {
  const std::string bytes = GENERATE("1", "8", "200");
  OddInstances odd;
  const PluginFault fault = odd.fault("overrun create " + bytes);
  CHECK(fault.kind() == std::string(fault_kind::abi_breach));
  CHECK(fault.function() == std::string("create"));
  CHECK(fault.plugin() == "test.odd.controller");
  CHECK(fault.what() == std::string("wrote beyond the end of dmrp_plugin"));
}

TEST_CASE("function tables of newer plugins are read as far as they are known, short ones are a breach") {
  OddInstances odd;
  for (const char* id :
       {"test.odd.planner", "test.odd.controller", "test.odd.central", "test.odd.people", "test.odd.metric"}) {
    CHECK_NOTHROW(odd.start(odd.make("newer", id)));
    try {
      odd.make("short table", id);
      FAIL("no fault");
    } catch (const PluginFault& fault) {
      CHECK(fault.kind() == std::string(fault_kind::abi_breach));
      CHECK(fault.function() == std::string("create"));
      CHECK_THAT(fault.what(), Catch::StartsWith("returned OK but did not fill in dmrp_plugin.table->struct_size ("));
    }
  }
}

TEST_CASE("a plugin's text reaches faults and the log as one line of plain text") {
  const std::string plain = "one\\ntwo \\x1b[2J \\xc2\\x9b1m \\xff\\xfe caf\u00e9";
  OddInstances odd;
  CHECK(odd.fault("fail").what() == plain);
  odd.start(odd.make("log"));
  odd.start(odd.make("warn"));
  REQUIRE(odd.log.size() == 2);
  CHECK(odd.log[0].level == DMRP_LOG_INFO);
  CHECK(odd.log[1].level == DMRP_LOG_WARNING);
  for (const LogLine& line : odd.log) {
    CHECK(line.text == plain);
    CHECK(line.plugin == "test.odd.controller");
  }
  CHECK(odd.fault("say much").what() == std::string(4000, 'x'));
}

TEST_CASE("a thread that outlives its call is told to stop, and cannot speak for another plugin") {
  OddInstances odd;
  odd.start(odd.make("leave a thread"));
  try {
    odd.start(odd.make("let the thread speak", "test.odd.planner"));
    FAIL("no fault");
  } catch (const PluginFault& fault) {
    CHECK(fault.plugin() == "test.odd.planner");
    CHECK(fault.what() == std::string("text of the call"));
  }
  REQUIRE(odd.log.size() == 2);
  CHECK(odd.log[0].text == "the thread was told to stop");
  CHECK(odd.log[1].text == "the call may go on");
  CHECK(odd.guard.timing().empty());  // no call was
}

TEST_CASE("a plugin gets the extensions that it declares, and no others") {
  static const int offered = 0;
  const auto ask = [](const std::string& id) {
    OddInstances odd;
    Instance& instance = odd.make("ask " + id);
    instance.offer([](const char*) -> const void* { return &offered; });  // whatever is asked for
    odd.start(instance);
    return odd.log;
  };
  const auto declared = ask(DMRP_EXT_LIDAR);
  REQUIRE(declared.size() == 2);
  CHECK(declared[0].text == "given");
  CHECK(declared[1].text == "given");

  // asked for twice, told once
  const auto undeclared = ask("dmrp.local_costmap/1");
  REQUIRE(undeclared.size() == 3);
  CHECK(undeclared[0].level == DMRP_LOG_WARNING);
  CHECK(undeclared[0].text ==
        "asks for the extension 'dmrp.local_costmap/1', which its descriptor does not declare: it gets none");
  CHECK(undeclared[1].text == "not given");
  CHECK(undeclared[2].text == "not given");

  const auto misspelt = ask("dmrp.lidar/2");
  REQUIRE(misspelt.size() == 3);
  CHECK_THAT(misspelt[0].text, Catch::EndsWith("it gets none (did you mean 'dmrp.lidar/1'?)"));
}

TEST_CASE("a plugin knows the host's version of the contract and its own file") {
  OddInstances odd;
  odd.start(odd.make("describe the host"));
  REQUIRE(odd.log.size() == 1);
  CHECK(odd.log[0].text == std::to_string(DMRP_ABI_MINOR) + " " DMRP_ODD_PLUGINS);

  // and so does its library, however it is named
  const OddLibrary changed;
  static std::string path;
  changed.entry().init = [](const dmrp_entry*, const dmrp_host* host) -> std::int32_t {
    return path = host->library_path, DMRP_OK;
  };
  const std::vector<LibraryUse> uses = {{"odd", std::filesystem::relative(DMRP_ODD_PLUGINS), {}}};
  const InstancePool pool(uses, odd.guard, [](auto, const auto&, const auto&) {});
  CHECK(std::filesystem::path(path).is_absolute());
  CHECK(std::filesystem::equivalent(path, DMRP_ODD_PLUGINS));
}

}  // namespace instance_test
