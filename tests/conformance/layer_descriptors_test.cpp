// SPDX-License-Identifier: MIT
// The descriptors that the C++ layer exports, and the parameters of plugins.
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "tests/conformance/sample_library.hpp"

using namespace dmrp::test;

namespace {

const dmrp_descriptor& descriptor(const std::string& id) {
  for (std::uint32_t i = 0; i < dmrp_entry_v1.plugin_count(&dmrp_entry_v1); ++i)
    if (const dmrp_descriptor* d = dmrp_entry_v1.descriptor(&dmrp_entry_v1, i); d && id == d->id) return *d;
  throw std::runtime_error("no descriptor of " + id);
}

template <class Traits>
const Traits& traits(const dmrp_descriptor& descriptor) {
  REQUIRE(descriptor.traits);
  const auto& its = *static_cast<const Traits*>(descriptor.traits);
  REQUIRE(its.struct_size == sizeof(Traits));
  return its;
}

const dmrp_param_spec& spec(const std::string& key) {
  const dmrp_descriptor& d = descriptor("sample.controller");
  for (std::uint32_t i = 0; i < d.param_count; ++i) {
    const auto* s = DMRP_AT(dmrp_param_spec, d.params, d.param_stride, i);
    if (key == s->key) return *s;
  }
  throw std::runtime_error("no parameter " + key);
}

std::vector<std::string> list(const char* const* texts, std::uint32_t count) {
  return {texts, texts + count};
}

dmrp_param_value value(const char* key, std::uint32_t type) {
  dmrp_param_value v{};
  v.key = key;
  v.type = type;
  return v;
}

}  // namespace

TEST_CASE("the entry says what it was built with and lists the plugins in their order") {
  CHECK(dmrp_entry_v1.struct_size == sizeof(dmrp_entry));
  CHECK(dmrp_entry_v1.abi_minor == DMRP_ABI_MINOR);
  CHECK(dmrp_entry_v1.abi_draft == DMRP_ABI_DRAFT);
  CHECK(dmrp_entry_v1.min_host_minor == 0);
  REQUIRE(dmrp_entry_v1.plugin_count(&dmrp_entry_v1) == 7);
  CHECK(dmrp_entry_v1.descriptor(&dmrp_entry_v1, 0)->id == std::string("sample.controller"));
  CHECK(dmrp_entry_v1.descriptor(&dmrp_entry_v1, 5)->id == std::string("sample.unmakeable"));
  CHECK(dmrp_entry_v1.descriptor(&dmrp_entry_v1, 6)->id == std::string("sample.windowed"));
  CHECK(dmrp_entry_v1.descriptor(&dmrp_entry_v1, 7) == nullptr);
  CHECK(dmrp_entry_v1.descriptor(&dmrp_entry_v1, 0) == dmrp_entry_v1.descriptor(&dmrp_entry_v1, 0));  // static data
}

TEST_CASE("a descriptor carries all that describe() said") {
  const dmrp_descriptor& controller = descriptor("sample.controller");
  CHECK(controller.struct_size == sizeof(dmrp_descriptor));
  CHECK(controller.kind == DMRP_KIND_LOCAL_CONTROLLER);
  CHECK(controller.name == std::string("Sample controller"));
  CHECK(controller.version == std::string("1.2.3"));
  CHECK(controller.vendor == std::string("Somebody"));
  CHECK(controller.license == std::string("MIT"));
  CHECK(controller.summary == std::string("what it does"));
  CHECK(controller.source == std::string("a paper, section 4"));
  CHECK(list(controller.needed, controller.needed_count) == std::vector<std::string>{"dmrp.lidar/1"});
  CHECK(list(controller.uses, controller.uses_count) ==
        std::vector<std::string>{"dmrp.local_costmap/1", "dmrp.annotate/1"});
  CHECK(controller.flags == (DMRP_FLAG_BACKWARDS | DMRP_FLAG_PROCESSES));
  CHECK(traits<dmrp_controller_traits>(controller).kinematics == 1u << DMRP_KINEMATICS_HOLONOMIC);

  const dmrp_descriptor& central = descriptor("sample.central");
  CHECK(central.kind == DMRP_KIND_LOCAL_CONTROLLER);
  CHECK(central.flags == DMRP_FLAG_CENTRAL);
  CHECK(traits<dmrp_controller_traits>(central).kinematics == 0);

  const dmrp_descriptor& planner = descriptor("sample.planner");
  CHECK(planner.kind == DMRP_KIND_GLOBAL_PLANNER);
  CHECK(traits<dmrp_planner_traits>(planner).connectivity == DMRP_CONNECTIVITY_8);
  CHECK(planner.flags == DMRP_FLAG_UNCOORDINATED);
  CHECK(planner.vendor == std::string());  // never NULL
  const dmrp_descriptor& windowed = descriptor("sample.windowed");
  CHECK(windowed.flags == DMRP_FLAG_WINDOWED);
  CHECK(traits<dmrp_planner_traits>(windowed).connectivity == DMRP_CONNECTIVITY_4);
  CHECK(descriptor("sample.pedestrian").kind == DMRP_KIND_PEDESTRIAN_MODEL);
  CHECK(descriptor("sample.pedestrian").traits == nullptr);

  const dmrp_descriptor& metric = descriptor("sample.metric");
  CHECK(metric.kind == DMRP_KIND_METRIC);
  const auto& measured = traits<dmrp_metric_traits>(metric);
  CHECK(measured.channels == (DMRP_CHANNEL_PEOPLE | DMRP_CHANNEL_CALLS));
  REQUIRE(measured.value_count == 3);
  const auto at = [&](std::uint32_t i) {
    return *DMRP_AT(dmrp_metric_value_spec, measured.values, measured.value_stride, i);
  };
  CHECK(at(0).name == std::string("plain"));
  CHECK(at(0).unit == std::string("m"));
  CHECK(at(0).description == std::string("one number"));
  CHECK(at(0).direction == DMRP_DIRECTION_LOWER);
  CHECK(at(0).subjects == 1u << DMRP_SUBJECT_SYSTEM);
  CHECK((at(0).wall_clock == 0 && at(0).curve == 0));
  CHECK(at(1).direction == DMRP_DIRECTION_NONE);
  CHECK(at(1).subjects == (1u << DMRP_SUBJECT_SYSTEM | 1u << DMRP_SUBJECT_ROBOT));
  CHECK((at(1).wall_clock == 1 && at(1).curve == 0));
  CHECK(at(2).direction == DMRP_DIRECTION_HIGHER);
  CHECK(at(2).subjects == (1u << DMRP_SUBJECT_SYSTEM | 1u << DMRP_SUBJECT_PEDESTRIAN));
  CHECK((at(2).wall_clock == 0 && at(2).curve == 1));
}

TEST_CASE("the parameter table has every declaration, in order, with type, default and bounds") {
  const dmrp_descriptor& d = descriptor("sample.controller");
  std::vector<std::string> keys;
  for (std::uint32_t i = 0; i < d.param_count; ++i)
    keys.push_back(DMRP_AT(dmrp_param_spec, d.params, d.param_stride, i)->key);
  CHECK(keys == std::vector<std::string>{"does", "flag", "integer", "large", "small", "number", "whole", "text",
                                         "choice", "file", "numbers", "texts"});

  CHECK(spec("flag").type == DMRP_PARAM_BOOL);
  CHECK(spec("flag").integer == 1);
  CHECK(spec("flag").doc == std::string("a flag"));
  CHECK(spec("flag").unit == std::string());
  CHECK(spec("integer").type == DMRP_PARAM_INT);
  CHECK(spec("integer").integer == 7);
  CHECK(spec("integer").minimum == 1.0);
  CHECK(spec("integer").maximum == 9.0);
  CHECK(spec("integer").unit == std::string("1"));
  CHECK(spec("large").integer == std::int64_t{1} << 60);
  CHECK(spec("large").minimum == -INFINITY);
  CHECK(spec("large").maximum == INFINITY);
  CHECK(spec("small").type == DMRP_PARAM_INT);
  CHECK(spec("small").integer == -3);
  CHECK(spec("whole").type == DMRP_PARAM_DOUBLE);  // whatever its default is written as
  CHECK(spec("whole").number == 1.0);
  CHECK(spec("whole").integer == 0);
  CHECK(spec("number").type == DMRP_PARAM_DOUBLE);
  CHECK(spec("number").number == 0.25);
  CHECK(spec("number").maximum == 0.5);
  CHECK(spec("text").type == DMRP_PARAM_STRING);
  CHECK(spec("text").text == std::string("as it is"));
  CHECK(spec("choice").type == DMRP_PARAM_CHOICE);
  CHECK(spec("choice").text == std::string("red"));
  CHECK(list(spec("choice").choices, spec("choice").choice_count) == std::vector<std::string>{"red", "green", "blue"});
  CHECK(spec("file").type == DMRP_PARAM_PATH);
  CHECK(spec("numbers").type == DMRP_PARAM_DOUBLE_ARRAY);
  REQUIRE(spec("numbers").count == 2);
  CHECK(spec("numbers").numbers[1] == -2.0);
  CHECK(spec("texts").type == DMRP_PARAM_STRING_ARRAY);
  CHECK(list(spec("texts").texts, spec("texts").count) == std::vector<std::string>{"a", "b", "c"});
}

TEST_CASE("create() brings values of every type into the members, what it leaves out keeps its default") {
  const double numbers[] = {4.0, 5.0, 6.0};
  const char* const texts[] = {"x"};
  std::vector<dmrp_param_value> given = {value("flag", DMRP_PARAM_BOOL),
                                         value("integer", DMRP_PARAM_INT),
                                         value("small", DMRP_PARAM_INT),
                                         value("number", DMRP_PARAM_DOUBLE),
                                         value("whole", DMRP_PARAM_DOUBLE),
                                         value("text", DMRP_PARAM_STRING),
                                         value("choice", DMRP_PARAM_CHOICE),
                                         value("file", DMRP_PARAM_PATH),
                                         value("numbers", DMRP_PARAM_DOUBLE_ARRAY),
                                         value("texts", DMRP_PARAM_STRING_ARRAY)};
  given[0].integer = 0;
  given[1].integer = 3;
  given[2].integer = std::numeric_limits<int>::min();
  given[3].number = 0.125;
  given[4].number = 1.5;
  std::string text = "mine";  // destroyed before the plugin reads it
  given[5].text = text.c_str();
  given[6].text = "blue";
  given[7].text = "/data/other.csv";
  given[8].numbers = numbers;
  given[8].count = 3;
  given[9].texts = texts;
  given[9].count = 1;
  const ParamList params(given);

  RecordingHost host;
  dmrp_plugin plugin{};
  plugin.struct_size = sizeof(plugin);
  REQUIRE(dmrp_entry_v1.create(&dmrp_entry_v1, &host.c, "sample.controller", params.c(), &plugin) == DMRP_OK);
  text.assign("XXXX");

  dmrp_world world{};
  world.struct_size = sizeof(world);
  world.time_limit_ns = 5;
  world.robot_count = 3;
  const dmrp_start start = {sizeof(start), 2, 99, &world};
  CHECK(plugin.start(plugin.self, &start) == DMRP_OK);
  const double large = static_cast<double>(std::int64_t{1} << 60);
  const double smallest = std::numeric_limits<int>::min();
  CHECK(seen().numbers ==
        std::vector<double>{0.0, 3.0, large, smallest, 0.125, 1.5, 4.0, 5.0, 6.0, 99.0, 2.0, 3.0, 1.0});
  CHECK(seen().texts == std::vector<std::string>{"mine", "blue", "/data/other.csv", "x"});
  plugin.destroy(plugin.self);
}

TEST_CASE("a value that does not fit into a Param<int> is refused with its key") {
  for (const std::int64_t outside : {std::int64_t{1} << 31, -(std::int64_t{1} << 31) - 1}) {
    std::vector<dmrp_param_value> given = {value("small", DMRP_PARAM_INT)};
    given[0].integer = outside;
    const ParamList params(given);
    RecordingHost host;
    dmrp_plugin plugin{};
    plugin.struct_size = sizeof(plugin);
    CHECK(dmrp_entry_v1.create(&dmrp_entry_v1, &host.c, "sample.controller", params.c(), &plugin) == DMRP_ERROR);
    CHECK(host.error == "small does not fit into an int");
    CHECK(plugin.self == nullptr);
    CHECK(seen().alive == 0);
  }
}

TEST_CASE("a parameter that is a text compares with texts on both sides") {
  const Sample sample("sample.controller", "compare texts");
  REQUIRE(sample.start() == DMRP_OK);
  CHECK(seen().numbers == std::vector<double>{1.0, 1.0, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0});
}

TEST_CASE("instances are told apart, and destroy() ends them") {
  CHECK(seen().alive == 0);  // the prototype that declared the parameters has been destroyed
  {
    const Sample first("sample.controller", "nothing");
    const Sample second("sample.controller", "no solution");
    CHECK(seen().alive == 2);
    CHECK(first.start() == DMRP_OK);
    CHECK(second.start() == DMRP_NO_SOLUTION);
  }
  CHECK(seen().alive == 0);
}

TEST_CASE("create() answers what it cannot make with a status and a text") {
  RecordingHost host;
  dmrp_plugin plugin{};
  plugin.struct_size = sizeof(plugin);
  const ParamList params({text_value("does", "nothing")});
  const auto create = [&](const char* id) {
    return dmrp_entry_v1.create(&dmrp_entry_v1, &host.c, id, params.c(), &plugin);
  };

  CHECK(create("sample.other") == DMRP_ERROR);
  CHECK(host.error == "no plugin of that id in this library");

  CHECK(dmrp_entry_v1.descriptor(&dmrp_entry_v1, 5) != nullptr);  // created before the error
  seen().texts = {"throw"};
  CHECK(create("sample.unmakeable") == DMRP_ERROR);
  CHECK(host.error == "thrown on purpose");
  seen().texts = {"throw number"};
  CHECK(create("sample.unmakeable") == DMRP_ERROR);
  CHECK(host.error == "an exception that is no std::exception");
  seen().texts = {"throw bad_alloc"};
  CHECK(create("sample.unmakeable") == DMRP_OUT_OF_MEMORY);
  CHECK(plugin.self == nullptr);
  seen().texts.clear();
}
