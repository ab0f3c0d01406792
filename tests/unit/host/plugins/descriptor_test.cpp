// SPDX-License-Identifier: MIT
// The descriptors of a library: what the host reads of them, leaves out, and refuses.
#include <dmrp/ext/annotate.h>
#include <dmrp/ext/lidar.h>
#include <dmrp/ext/walking_grid.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

#include "host/plugins/offered_extensions.hpp"
#include "tests/support/odd_plugins/grown.hpp"
#include "tests/unit/host/plugins/odd_library.hpp"

namespace descriptor_test {

using namespace dmrp::host;
using namespace dmrp::test;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

dmrp_param_spec parameter(const char* key, std::uint32_t type) {
  dmrp_param_spec spec{};
  spec.key = key;
  spec.type = type;
  spec.minimum = -infinity;
  spec.maximum = infinity;
  return spec;
}

dmrp_metric_value_spec value(const char* name) {
  return {name, "m", "what it is", DMRP_DIRECTION_LOWER, 1u << DMRP_SUBJECT_SYSTEM, 0, 0, 0.0, 0.0};
}

void give(dmrp_descriptor& descriptor, const GrownArray<dmrp_param_spec>& elements) {
  descriptor.params = elements.data();
  descriptor.param_count = elements.count();
  descriptor.param_stride = elements.stride();
}

dmrp_metric_traits metric_traits(const GrownArray<dmrp_metric_value_spec>& values) {
  return {sizeof(dmrp_metric_traits), 0, values.data(), values.count(), values.stride()};
}

template <class Element>
GrownArray<Element> array_of(const std::vector<Element>& elements, int extra = 0) {
  GrownArray<Element> out(extra);
  for (const Element& element : elements) out.push_back(element);
  return out;
}

const PluginInfo& info_of(const Library& library, const std::string& id) {
  for (const PluginInfo& info : library.plugins())
    if (info.id == id) return info;
  throw std::runtime_error("no plugin " + id);
}

// Why the host refuses the library when its controller has this parameter.
std::string refusal_of(const std::function<void(dmrp_param_spec&)>& spoil, std::uint32_t type = DMRP_PARAM_DOUBLE) {
  const OddLibrary odd;
  dmrp_param_spec spec = parameter("gain", type);
  spoil(spec);
  const auto specs = array_of(std::vector{spec});
  give(odd.descriptor(odd_controller), specs);
  return OddLibrary::refusal();
}

// Why the host refuses the library when its controller has this descriptor.
std::string refusal_of_descriptor(const std::function<void(dmrp_descriptor&)>& spoil) {
  const OddLibrary odd;
  spoil(odd.descriptor(odd_controller));
  return OddLibrary::refusal();
}

TEST_CASE("the known part of a newer plugin's descriptor is read") {
  const int extra = GENERATE(0, 8, 24);
  const OddLibrary odd;
  dmrp_param_spec gain = parameter("gain", DMRP_PARAM_DOUBLE);
  gain.number = 0.5;
  gain.unit = "1/s";
  const double weights_of[] = {1.0, 2.5};
  dmrp_param_spec weights = parameter("weights", DMRP_PARAM_DOUBLE_ARRAY);
  weights.numbers = weights_of;
  weights.count = 2;
  const char* const choices[] = {"left", "right"};
  dmrp_param_spec side = parameter("side", DMRP_PARAM_CHOICE);
  side.choices = choices;
  side.choice_count = 2;
  side.text = "right";
  const auto specs = array_of(std::vector{gain, weights, side}, extra);
  give(odd.descriptor(odd_metric), specs);
  const auto values = array_of(std::vector{value("first"), value("second")}, extra);
  const Grown<dmrp_metric_traits> traits(metric_traits(values), 8);
  odd.descriptor(odd_metric).traits = traits.get();
  const Grown<dmrp_descriptor> newer(odd.descriptor(odd_metric), 16);
  static const dmrp_descriptor* shown;
  shown = newer.get();
  odd.entry().plugin_count = [](const dmrp_entry*) -> std::uint32_t { return 1; };
  odd.entry().descriptor = [](const dmrp_entry*, std::uint32_t) { return shown; };
  odd.entry().struct_size += 8;

  const Library library(DMRP_ODD_PLUGINS);
  CHECK(library.warnings().empty());
  const PluginInfo& info = info_of(library, "test.odd.metric");
  REQUIRE(info.parameters.size() == 3);
  CHECK(info.parameters[0].fallback.key == "gain");
  CHECK(info.parameters[0].fallback.number == 0.5);
  CHECK(info.parameters[0].unit == "1/s");
  CHECK(info.parameters[1].fallback.numbers == std::vector<double>{1.0, 2.5});
  CHECK(info.parameters[2].fallback.text == "right");
  CHECK(info.parameters[2].choices == std::vector<std::string>{"left", "right"});
  REQUIRE(info.values.size() == 2);
  CHECK(info.values[0].name == "first");
  CHECK(info.values[1].name == "second");
  CHECK(info.values[1].unit == "m");
}

TEST_CASE("what is shorter than v1.0's is refused") {
  const OddLibrary odd;
  dmrp_descriptor& metric = odd.descriptor(odd_metric);
  SECTION("the entry") {
    odd.entry().struct_size -= 8;
    CHECK(OddLibrary::refusal() == "its dmrp_entry_v1 is shorter than v1.0's");
  }
  SECTION("an entry of a few bytes") {
    odd.entry().struct_size = 8;
    CHECK(OddLibrary::refusal() == "its dmrp_entry_v1 is shorter than v1.0's");
  }
  SECTION("a descriptor") {
    metric.struct_size -= 8;
    CHECK(OddLibrary::refusal() == "has a descriptor that is shorter than v1.0's");
  }
  SECTION("a reserved field of the descriptor") {
    metric.reserved = 7;
    CHECK(OddLibrary::refusal() == "the descriptor of 'test.odd.metric' has 7 in a reserved field, which must be 0");
  }
  SECTION("a reserved field of a parameter") {
    dmrp_param_spec spec = *metric.params;
    spec.reserved = 7;
    metric.params = &spec;
    CHECK(OddLibrary::refusal() == "parameter 'does' has 7 in a reserved field, which must be 0");
  }
  const std::string odd_array = " that are shorter than v1.0's, or whose stride is no multiple of 8";
  SECTION("its parameters") {
    metric.param_stride += GENERATE(-8u, 4u);
    CHECK(OddLibrary::refusal() == "has a descriptor with parameters" + odd_array);
  }
  SECTION("its values") {
    auto traits = odd.traits<dmrp_metric_traits>(odd_metric);
    traits.value_stride = GENERATE(0u, 44u);
    metric.traits = &traits;
    CHECK(OddLibrary::refusal() == "has a descriptor with values" + odd_array);
  }
  SECTION("its traits") {
    auto traits = odd.traits<dmrp_metric_traits>(odd_metric);
    traits.struct_size -= 8;
    metric.traits = &traits;
    CHECK(OddLibrary::refusal() == "has traits that are shorter than v1.0's");
  }
}

TEST_CASE("a controller without traits drives differential drives, a planner without traits is refused") {
  const OddLibrary odd;
  CHECK(info_of(Library(DMRP_ODD_PLUGINS), "test.odd.controller").kinematics == 1u << DMRP_KINEMATICS_DIFFERENTIAL);
  const dmrp_controller_traits any = {sizeof(any), 1u << DMRP_KINEMATICS_ACKERMANN};
  odd.descriptor(odd_controller).traits = &any;
  CHECK(info_of(Library(DMRP_ODD_PLUGINS), "test.odd.controller").kinematics == 1u << DMRP_KINEMATICS_ACKERMANN);
  odd.descriptor(odd_planner).traits = nullptr;
  CHECK(OddLibrary::refusal() == "'test.odd.planner' is a planner that declares no connectivity (4, 8, any)");
}

TEST_CASE("a library of another draft, or for a newer host, gets one line") {
  const OddLibrary odd;
  SECTION("draft 1") {
    odd.entry().abi_draft = 1;
    odd.entry().struct_size = 48;  // whatever else that draft had
    CHECK(OddLibrary::refusal() == "built for draft 1 of the v1 contract, this host has draft 5: build it again");
  }
  SECTION("a newer host") {
    odd.entry().min_host_minor = 3;
    CHECK(OddLibrary::refusal() == "needs a host of ABI 1.3 or newer, this is 1.0");
  }
}

TEST_CASE("a plugin that this host does not know is left out with a note, and the others are loaded") {
  const OddLibrary odd;
  const auto expect_note = [](const std::string& note) {
    const Library library(DMRP_ODD_PLUGINS);
    REQUIRE(library.warnings().size() == 1);
    CHECK(library.warnings()[0] == note);
    CHECK(library.plugins().size() == 5);
    CHECK_NOTHROW(info_of(library, "test.odd.controller"));
  };
  dmrp_descriptor& stranger = odd.descriptor(odd_stranger);
  SECTION("a kind") {
    expect_note("its plugin 'test.odd.stranger' is left out: it is of kind 77, which this host does not know");
  }
  SECTION("a connectivity") {
    stranger.kind = DMRP_KIND_GLOBAL_PLANNER;
    const dmrp_planner_traits traits = {sizeof(traits), 16};
    stranger.traits = &traits;
    expect_note(
        "its plugin 'test.odd.stranger' is left out: it plans with connectivity 16, which this host does not know");
  }
  SECTION("a flag that must be understood") {
    stranger.kind = DMRP_KIND_PEDESTRIAN_MODEL;
    stranger.flags = 1u << 20 | 1u << 10;
    expect_note(
        "its plugin 'test.odd.stranger' is left out: it has the flags 0x100000 of DMRP_FLAGS_NEEDED, which this host "
        "does not know");
  }
  SECTION("the type of a parameter") {
    stranger.kind = DMRP_KIND_PEDESTRIAN_MODEL;
    const auto specs = array_of(std::vector{parameter("gain", DMRP_PARAM_DOUBLE), parameter("when", 99)});
    give(stranger, specs);
    expect_note(
        "its plugin 'test.odd.stranger' is left out: it has parameter 'when' of type 99, which this host does not "
        "know");
  }
}

TEST_CASE("a parameter's mistake is refused with the plugin, the key and the reason") {
  const std::string subject = "test.odd.controller: parameter 'gain' ";
  const auto range = [](double minimum, double maximum, double fallback) {
    return [=](dmrp_param_spec& spec) {
      spec.minimum = minimum;
      spec.maximum = maximum;
      spec.number = fallback;
      spec.integer = std::isnan(fallback) ? 0 : static_cast<std::int64_t>(fallback);
    };
  };
  CHECK(refusal_of(range(-1.0, 1.0, 0.5)).empty());
  CHECK(refusal_of(range(-1.0, 1.0, 2.0)) == subject + "has the default 2.0, which is not in -1 to 1");
  CHECK(refusal_of(range(1.0, 5.0, 0.0), DMRP_PARAM_INT) == subject + "has the default 0, which is not in 1 to 5");
  CHECK(refusal_of(range(-1.0, 1.0, undefined)) == subject + "has the default nan, which is not in -1 to 1");
  CHECK(refusal_of(range(undefined, 1.0, 0.5)) == subject + "has the range nan to 1");
  CHECK(refusal_of(range(0.0, undefined, 0.5)) == subject + "has the range 0 to nan");
  CHECK(refusal_of(range(2.0, 1.0, 1.5)) == subject + "has the range 2 to 1");
  for (const std::uint32_t type : {DMRP_PARAM_INT, DMRP_PARAM_DOUBLE, DMRP_PARAM_DOUBLE_ARRAY})
    CHECK(refusal_of(range(0.0, 0.0, 0.0), type) ==
          subject + "has minimum = maximum = 0 (no bound is -INFINITY and INFINITY)");
  CHECK(refusal_of(range(0.0, 0.0, 0.0), DMRP_PARAM_STRING).empty());  // texts have no range

  const double some[] = {0.5, 7.0};
  CHECK(refusal_of(
            [&](dmrp_param_spec& spec) {
              range(0.0, 1.0, 0.0)(spec);
              spec.numbers = some;
              spec.count = 2;
            },
            DMRP_PARAM_DOUBLE_ARRAY) == subject + "has the default [0.5, 7.0], which is not in 0 to 1");

  const char* const choices[] = {"left", "right"};
  const auto choose = [&](const char* fallback) {
    return [&choices, fallback](dmrp_param_spec& spec) {
      spec.choices = choices;
      spec.choice_count = 2;
      spec.text = fallback;
    };
  };
  CHECK(refusal_of(choose("left"), DMRP_PARAM_CHOICE).empty());
  CHECK(refusal_of(choose("up"), DMRP_PARAM_CHOICE) ==
        subject + "has the default \"up\", which is not one of its choices");
  CHECK(refusal_of([](auto&) {}, DMRP_PARAM_CHOICE) ==
        subject + "has the default \"\", which is not one of its choices");
  CHECK(refusal_of([](auto& spec) { spec.integer = 2; }, DMRP_PARAM_BOOL) == subject + "is a bool with the default 2");
  CHECK(refusal_of([](auto& spec) { spec.text = "a\nb"; }, DMRP_PARAM_STRING) ==
        subject + "has a text with control characters or bytes that are not UTF-8");
  CHECK(refusal_of([](auto& spec) { spec.text = "\xff"; }, DMRP_PARAM_STRING) ==
        subject + "has a text with control characters or bytes that are not UTF-8");
  CHECK(refusal_of([](auto& spec) { spec.type = 0; }) ==
        "test.odd.controller: declares parameter 'gain' without a type");

  for (const auto& [key, shown] : {std::pair("", ""), {"a b", "a b"}, {"a\nb", "a\\nb"}, {"\x1b[2J", "\\x1b[2J"}})
    CHECK(refusal_of([key = key](auto& spec) { spec.key = key; }) ==
          std::string("test.odd.controller: parameter '") + shown +
              "' has a key that is not made of letters, digits and '_'");
}

TEST_CASE("what is declared twice is refused") {
  const OddLibrary odd;
  dmrp_descriptor& metric = odd.descriptor(odd_metric);
  SECTION("a parameter") {
    const auto specs =
        array_of(std::vector{parameter("gain", DMRP_PARAM_DOUBLE), parameter("gain", DMRP_PARAM_STRING)});
    give(metric, specs);
    CHECK(OddLibrary::refusal() == "test.odd.metric: declares parameter 'gain' twice");
  }
  SECTION("a value") {
    const auto values = array_of(std::vector{value("length"), value("length")});
    const dmrp_metric_traits traits = metric_traits(values);
    metric.traits = &traits;
    CHECK(OddLibrary::refusal() == "test.odd.metric: declares the value 'length' twice");
  }
}

TEST_CASE("a metric's value needs a plain name and the system") {
  const OddLibrary odd;
  dmrp_metric_value_spec spec = value("length");
  SECTION("a name with a space") {
    spec.name = "the length";
    const auto values = array_of(std::vector{spec});
    const dmrp_metric_traits traits = metric_traits(values);
    odd.descriptor(odd_metric).traits = &traits;
    CHECK(OddLibrary::refusal() ==
          "test.odd.metric: has a value whose name 'the length' is not made of letters, digits and '_'");
  }
  SECTION("robots alone") {
    spec.subjects = 1u << DMRP_SUBJECT_ROBOT;
    const auto values = array_of(std::vector{spec});
    const dmrp_metric_traits traits = metric_traits(values);
    odd.descriptor(odd_metric).traits = &traits;
    CHECK(OddLibrary::refusal() ==
          "test.odd.metric: declares the value 'length' without the system among its subjects");
  }
  SECTION("a range upside down") {
    spec.minimum = 1.0;
    const auto values = array_of(std::vector{spec});
    const dmrp_metric_traits traits = metric_traits(values);
    odd.descriptor(odd_metric).traits = &traits;
    CHECK(OddLibrary::refusal() == "test.odd.metric: the value 'length' has the range 1 to 0");
  }
}

TEST_CASE("an id is a plain name, and not one of the built-in plugins'") {
  const auto refusal = [](const char* id) {
    return refusal_of_descriptor([id](dmrp_descriptor& descriptor) { descriptor.id = id; });
  };
  CHECK(refusal("org.example.Mine_2-b").empty());
  CHECK(refusal("") == "has a plugin without an id");
  CHECK(refusal(nullptr) == "has a plugin without an id");
  for (const auto& [id, shown] :
       {std::pair("my plugin", "my plugin"), {"mine!", "mine!"}, {"a\nb", "a\\nb"}, {"caf\xe9", "caf\\xe9"}})
    CHECK(refusal(id) ==
          std::string("has a plugin with the id '") + shown + "': an id is made of letters, digits, '.', '_' and '-'");
  CHECK(refusal("dmrp.controller.mine") ==
        "has a plugin with the id 'dmrp.controller.mine': ids that begin with 'dmrp.' are for the built-in plugins");
  CHECK(refusal("dmrpx.controller").empty());
  CHECK_NOTHROW(Library(DMRP_PLUGIN_DIR "/libdmrp_metrics.so"));
}

TEST_CASE("texts for display may be any bytes") {
  const OddLibrary odd;
  dmrp_descriptor& controller = odd.descriptor(odd_controller);
  controller.name =
      "M\xfc"
      "ller\n\x1b[2J";
  controller.summary = "\xed\xa0\x80";
  controller.vendor = nullptr;
  const char* const extensions[] = {"caf\xe9/1"};
  controller.uses = extensions;
  controller.uses_count = 1;
  controller.needed = extensions;
  controller.needed_count = 1;
  dmrp_param_spec spec = parameter("gain", DMRP_PARAM_DOUBLE);
  spec.unit = "\xb0";
  spec.doc = "caf\xc3\xa9\x07";
  const auto specs = array_of(std::vector{spec});
  give(controller, specs);
  const Library library(DMRP_ODD_PLUGINS);
  const PluginInfo& info = info_of(library, "test.odd.controller");
  CHECK(info.name == "M\\xfcller\\n\\x1b[2J");
  CHECK(info.summary == "\\xed\\xa0\\x80");
  CHECK(info.vendor.empty());
  CHECK(info.uses == std::vector<std::string>{"caf\\xe9/1"});
  CHECK(info.needs == info.uses);
  CHECK(info.parameters[0].unit == "\\xb0");
  CHECK(info.parameters[0].doc == "caf\u00e9\\x07");
  CHECK_NOTHROW(nlohmann::json(library.plugins()).dump());
}

TEST_CASE("extensions in `requires` and `uses` that the host lacks are told with the nearest") {
  const OddLibrary odd;
  dmrp_descriptor& controller = odd.descriptor(odd_controller);
  const char* const misspelt[] = {"dmrp.lidr/1"};
  const char* const others[] = {"org.example.telepathy/1", DMRP_EXT_LIDAR};
  SECTION("required") {
    controller.needed = misspelt;
    controller.needed_count = 1;
    const Library library(DMRP_ODD_PLUGINS);
    CHECK(missing_extension(info_of(library, "test.odd.controller")) ==
          "needs the extension dmrp.lidr/1, which this host does not offer to a local_controller (offered: "
          "dmrp.annotate/1, dmrp.lidar/1, dmrp.local_costmap/1, dmrp.distance_field/1, dmrp.obstacle_clusters/1, "
          "dmrp.timing/1) (did you mean 'dmrp.lidar/1'?)");
  }
  SECTION("required, by a plugin of another kind") {
    dmrp_descriptor& metric = odd.descriptor(odd_metric);
    metric.needed = &others[1];
    const Library library(DMRP_ODD_PLUGINS);
    CHECK_THAT(missing_extension(info_of(library, "test.odd.metric")),
               Catch::StartsWith("needs the extension dmrp.lidar/1, which this host does not offer to a metric"));
  }
  SECTION("used, and misspelt") {
    controller.uses = misspelt;
    controller.uses_count = 1;
    const Library library(DMRP_ODD_PLUGINS);
    REQUIRE(library.warnings().size() == 2);  // and the plugin of unknown kind
    CHECK(library.warnings()[0] ==
          "test.odd.controller uses the extension 'dmrp.lidr/1', which this host does not offer to a local_controller "
          "(did you mean 'dmrp.lidar/1'?)");
  }
  SECTION("used where there is one") {
    controller.uses = others;
    controller.uses_count = 2;
    const Library library(DMRP_ODD_PLUGINS);
    CHECK(library.warnings().size() == 1);
    CHECK(missing_extension(info_of(library, "test.odd.controller")).empty());
  }
}

}  // namespace descriptor_test
