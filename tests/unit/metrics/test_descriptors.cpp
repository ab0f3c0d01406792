// SPDX-License-Identifier: MIT
// What the metrics say about themselves, what they do where there is nothing to measure, and the parameter sets.
#include <toml++/toml.h>

#include <catch2/catch.hpp>
#include <map>
#include <set>

#include "synthetic_trial.hpp"

using namespace dmrp::test;

namespace {

const dmrp_entry& entry() {
  return PluginLibrary::load("libdmrp_metrics.so").entry();
}

const dmrp_metric_value_spec& value_of(const dmrp_descriptor& descriptor, std::uint32_t index) {
  return *DMRP_AT(dmrp_metric_value_spec, descriptor.values, descriptor.value_stride, index);
}

const dmrp_param_spec* parameter_of(const dmrp_descriptor& descriptor, const std::string& key) {
  for (std::uint32_t i = 0; i < descriptor.param_count; ++i) {
    const auto* spec = DMRP_AT(dmrp_param_spec, descriptor.params, descriptor.param_stride, i);
    if (key == spec->fallback.key) return spec;
  }
  return nullptr;
}

// Parameters by "id.key", all checked against the descriptors.
std::map<std::string, double> read_parameter_set(const std::string& file) {
  std::map<std::string, double> set;
  const toml::table root = toml::parse_file(DMRP_METRIC_PARAMETER_SETS "/" + file);
  for (const toml::node& node : *root["metric"].as_array()) {
    const toml::table& metric = *node.as_table();
    const std::string id = *metric["use"].value<std::string>();
    const dmrp_descriptor* descriptor = PluginLibrary::load("libdmrp_metrics.so").find(id);
    REQUIRE(descriptor);
    for (const auto& [key, value] : *metric["params"].as_table()) {
      const dmrp_param_spec* spec = parameter_of(*descriptor, std::string(key.str()));
      REQUIRE(spec);
      const double number = *value.value<double>();
      CHECK(number >= spec->minimum);
      CHECK(number <= spec->maximum);
      set[id + "." + std::string(key.str())] = number;
    }
  }
  return set;
}

}  // namespace

TEST_CASE("the metrics give the values that results are read by, each once") {
  std::map<std::string, std::string> units;
  for (std::uint32_t i = 0; i < entry().plugin_count(); ++i) {
    const dmrp_descriptor& descriptor = *entry().descriptor(i);
    INFO(descriptor.id);
    CHECK(descriptor.kind == DMRP_KIND_METRIC);
    CHECK(std::string(descriptor.summary) != "");
    CHECK(std::string(descriptor.source) != "");
    for (std::uint32_t v = 0; v < descriptor.value_count; ++v) {
      const dmrp_metric_value_spec& value = value_of(descriptor, v);
      INFO(value.name);
      CHECK(units.emplace(value.name, value.unit).second);
      CHECK(std::string(value.description) != "");
      // neither the crowd that was met nor the cells of the plan can be better
      const std::string name = value.name;
      CHECK((value.direction == DMRP_DIRECTION_NONE) == (name == "people_nearby" || name == "sto_cell_size"));
      CHECK((value.subjects & 1u << DMRP_SUBJECT_SYSTEM) != 0);
      CHECK(value.wall_clock == (std::string(value.name) == "planning_time" ? 1u : 0u));
      CHECK(value.curve == 0);
    }
  }
  const std::map<std::string, std::string> expected = {{"success", "1"},
                                                       {"trial_success", "1"},
                                                       {"safe_success", "1"},
                                                       {"path_length", "m"},
                                                       {"planned_length", "m"},
                                                       {"plan_turns", "1"},
                                                       {"planning_time", "ms"},
                                                       {"completion_time", "s"},
                                                       {"mission_time", "s"},
                                                       {"mean_speed", "m/s"},
                                                       {"speed_sd", "m/s"},
                                                       {"collisions", "1"},
                                                       {"collisions_at_fault", "1"},
                                                       {"collisions_static", "1"},
                                                       {"collisions_robot", "1"},
                                                       {"collisions_person", "1"},
                                                       {"collisions_unavoidable", "1"},
                                                       {"sto", "1"},
                                                       {"sto_cell_size", "m"},
                                                       {"people_nearby", "1"},
                                                       {"ibtr", "%"},
                                                       {"ibtr_pair_sum", "%"},
                                                       {"ldf", "1"},
                                                       {"ldf_active", "1"},
                                                       {"pfd", "m"},
                                                       {"pfd_initial", "m"}};
  CHECK(units == expected);
}

TEST_CASE("a trial without a plan has a value for every name, and 0 only where nothing happening is an answer") {
  SyntheticTrial trial(3);
  trial.end(0.0, {never, never, never});  // no plan, no sample
  const std::set<std::string> zero = {
      "success",           "trial_success",         "safe_success",      "mission_time",
      "collisions",        "collisions_at_fault",   "collisions_static", "collisions_robot",
      "collisions_person", "collisions_unavoidable"};
  for (std::uint32_t i = 0; i < entry().plugin_count(); ++i) {
    const Measurement m = measure(entry().descriptor(i)->id, trial);  // checks that every name comes
    CHECK(m.events.size() == (std::string(entry().descriptor(i)->id) == "dmrp.metric.success" ? 3 : 0));
    for (const auto& [key, value] : m.values) {
      const std::string& name = std::get<0>(key);
      INFO(name);
      if (zero.count(name) == 1) {
        CHECK(value == 0.0);
      } else {
        CHECK(std::isnan(value));
      }
    }
  }
}

TEST_CASE("in a trial with a plan only completion time can be undefined") {
  SyntheticTrial trial(2);  // nobody moves, nobody arrives
  trial.plan({{{0, 0}, {1, 0}}, {{5, 0}}});
  for (int t = 0; t <= 3; ++t) trial.sample(t, {at(0, 0), at(5, 0)});
  trial.end(3.0, {never, never});
  for (std::uint32_t i = 0; i < entry().plugin_count(); ++i) {
    const Measurement m = measure(entry().descriptor(i)->id, trial);
    for (const auto& [key, value] : m.values) {
      const std::string& name = std::get<0>(key);
      INFO(name);
      CHECK(std::isnan(value) == (name == "completion_time"));
    }
  }
}

TEST_CASE("the paper's parameter set is the defaults, the released code's differs where it is known to") {
  const auto paper = read_parameter_set("paper.toml");
  for (const char* id : {"dmrp.metric.sto", "dmrp.metric.ibtr", "dmrp.metric.ldf"}) {
    const dmrp_descriptor& descriptor = *PluginLibrary::load("libdmrp_metrics.so").find(id);
    for (std::uint32_t i = 0; i < descriptor.param_count; ++i) {
      const auto& fallback = DMRP_AT(dmrp_param_spec, descriptor.params, descriptor.param_stride, i)->fallback;
      const double value = fallback.type == DMRP_PARAM_INT ? static_cast<double>(fallback.integer) : fallback.number;
      CHECK(paper.at(std::string(id) + "." + fallback.key) == value);
    }
  }
  auto expected = paper;
  expected["dmrp.metric.ibtr.distance_m"] = 2.5;
  expected["dmrp.metric.ibtr.speed_fraction"] = 0.5;
  expected["dmrp.metric.ldf.distance_m"] = 1.0;
  CHECK(read_parameter_set("released_code.toml") == expected);
}
