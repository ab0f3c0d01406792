// SPDX-License-Identifier: MIT
// The descriptors of the metrics, their values where there is nothing to measure, and the parameter sets.
#include <toml++/toml.h>

#include <catch2/catch.hpp>
#include <map>
#include <set>

#include "tests/unit/metrics/synthetic_trial.hpp"

namespace descriptors_test {

using namespace dmrp::test;

const dmrp_entry& entry() {
  return PluginLibrary::load("libdmrp_metrics.so").entry();
}

const dmrp_metric_traits& measures_of(const dmrp_descriptor& descriptor) {
  return traits_of<dmrp_metric_traits>(descriptor);
}

const dmrp_metric_value_spec& value_of(const dmrp_descriptor& descriptor, std::uint32_t index) {
  return *DMRP_AT(dmrp_metric_value_spec, measures_of(descriptor).values, measures_of(descriptor).value_stride, index);
}

const dmrp_param_spec* parameter_of(const dmrp_descriptor& descriptor, const std::string& key) {
  for (std::uint32_t i = 0; i < descriptor.param_count; ++i) {
    const auto* spec = DMRP_AT(dmrp_param_spec, descriptor.params, descriptor.param_stride, i);
    if (key == spec->key) return spec;
  }
  return nullptr;
}

// The parameters in a file of a parameter set, checked against the descriptor.
std::map<std::string, double> read_parameters(const std::string& file, const dmrp_descriptor& descriptor) {
  std::map<std::string, double> parameters;
  for (const auto& [key, value] : toml::parse_file(DMRP_METRIC_PARAMETER_SETS "/" + file)) {
    const dmrp_param_spec* spec = parameter_of(descriptor, std::string(key.str()));
    REQUIRE(spec);
    const double number = *value.value<double>();
    CHECK(number >= spec->minimum);
    CHECK(number <= spec->maximum);
    parameters[std::string(key.str())] = number;
  }
  return parameters;
}

TEST_CASE("the metrics declare the values that results are read by, each once") {
  // properties of the crowd and of the task are neither better nor worse
  const std::set<std::string> neither_better_nor_worse = {"first_cause",
                                                          "culprit",
                                                          "people_nearby",
                                                          "sto_cell_size",
                                                          "shortest_length",
                                                          "neighbours",
                                                          "schedule_error_s",
                                                          "proxemics_social",
                                                          "pedestrian_desired_speed",
                                                          "root_conflicts",
                                                          "root_conflicts_waited",
                                                          "root_conflicts_detoured",
                                                          "after_standstill",
                                                          "encounters_head_on_person",
                                                          "encounters_overtaking_person",
                                                          "encounters_crossing_person",
                                                          "encounters_head_on_robot",
                                                          "encounters_overtaking_robot",
                                                          "encounters_crossing_robot"};
  const std::set<std::string> timed = {"planning_time",     "plan_call_mean",   "plan_call_p99", "plan_missed",
                                       "control_call_mean", "control_call_p99", "control_missed"};
  const std::set<std::string> curves = {"sto_by_distance", "ibtr_by_distance",    "ibtr_by_speed_fraction",
                                        "ldf_by_distance", "pedestrian_progress", "success_at"};
  std::set<std::string> names;
  for (std::uint32_t i = 0; i < entry().plugin_count(&entry()); ++i) {
    const dmrp_descriptor& descriptor = *entry().descriptor(&entry(), i);
    INFO(descriptor.id);
    CHECK(descriptor.kind == DMRP_KIND_METRIC);
    CHECK(std::string(descriptor.summary) != "");
    CHECK(std::string(descriptor.source) != "");
    for (std::uint32_t v = 0; v < measures_of(descriptor).value_count; ++v) {
      const dmrp_metric_value_spec& value = value_of(descriptor, v);
      INFO(value.name);
      CHECK(names.insert(value.name).second);
      CHECK(std::string(value.unit) != "");
      CHECK(std::string(value.description) != "");
      CHECK((value.direction == DMRP_DIRECTION_NONE) == (neither_better_nor_worse.count(value.name) == 1));
      CHECK((value.subjects & 1u << DMRP_SUBJECT_SYSTEM) != 0);
      CHECK(value.wall_clock == (timed.count(value.name) == 1 ? 1u : 0u));
      CHECK(value.curve == (curves.count(value.name) == 1 ? 1u : 0u));
    }
  }
}

TEST_CASE("a trial without a plan has a value for every name, and 0 only where no event is a result") {
  SyntheticTrial trial(3);
  trial.end(0.0, {never, never, never});  // no plan, no sample
  const std::set<std::string> zero = {"isr",
                                      "csr",
                                      "spl",
                                      "shortest_length",
                                      "success",
                                      "trial_success",
                                      "safe_success",
                                      "safe_sct",
                                      "mission_time",
                                      "throughput",
                                      "contact_free_success",
                                      "braking_response_success",
                                      "success_at",
                                      "flow_rate"};
  for (std::uint32_t i = 0; i < entry().plugin_count(&entry()); ++i) {
    const Measurement m = measure(entry().descriptor(&entry(), i)->id, trial);  // checks that every name has a value
    CHECK(m.events.size() == (std::string(entry().descriptor(&entry(), i)->id) == "dmrp.metric.success" ? 3 : 0));
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

TEST_CASE("in a trial with a plan, only values without events or people are undefined") {
  SyntheticTrial trial(2);  // nobody moves, nobody arrives
  trial.planning_grid(6, 1).plan({{{0, 0}, {1, 0}}, {{5, 0}}});
  for (int t = 0; t <= 3; ++t) {
    trial.sample(t, {at(0, 0), at(5, 0)}).events({becomes(0, DMRP_CLASS_MOVING), becomes(1, DMRP_CLASS_MOVING)});
    trial.handed(0, {{0, 0}, {1, 0}}).handed(1, {{5, 0}});
  }
  trial.end(3.0, {never, never});
  const std::set<std::string> no_arrival = {"completion_time", "flowtime",       "makespan",
                                            "culprit",         "makespan_ratio", "after_standstill"};
  const std::set<std::string> no_motion = {"ttc_min", "impact_speed", "path_irregularity", "schedule_error_s",
                                           "schedule_deviation_s"};
  const std::set<std::string> no_calls = {"planning_time",     "plan_call_mean",   "plan_call_p99", "plan_missed",
                                          "control_call_mean", "control_call_p99", "control_missed"};
  const std::set<std::string> nobody = {"clearance_person_min",
                                        "clearance_person_mean",
                                        "danger_time_person",
                                        "proxemics_intimate",
                                        "proxemics_personal",
                                        "proxemics_social",
                                        "group_intrusion_time",
                                        "group_intrusions",
                                        "social_work",
                                        "social_work_robot",
                                        "social_work_people",
                                        "pedestrian_progress",
                                        "pedestrian_desired_speed",
                                        "pedestrian_speed",
                                        "encounters_head_on_person",
                                        "encounters_overtaking_person",
                                        "encounters_crossing_person"};
  for (std::uint32_t i = 0; i < entry().plugin_count(&entry()); ++i) {
    const Measurement m = measure(entry().descriptor(&entry(), i)->id, trial);
    for (const auto& [key, value] : m.values) {
      const std::string& name = std::get<0>(key);
      INFO(name);
      CHECK(std::isnan(value) ==
            (no_arrival.count(name) + no_motion.count(name) + no_calls.count(name) + nobody.count(name) == 1));
    }
  }
}

TEST_CASE("a trial without robots has values of time and people only") {
  SyntheticTrial trial(0);
  for (int t = 0; t <= 3; ++t) trial.sample(t, {}).people_at({{0, 0}, {5, 0}});
  trial.end(3.0);
  const std::set<std::string> defined = {"mission_time", "pedestrian_progress", "pedestrian_speed",
                                         "pedestrian_desired_speed"};
  for (std::uint32_t i = 0; i < entry().plugin_count(&entry()); ++i) {
    const Measurement m = measure(entry().descriptor(&entry(), i)->id, trial);
    CHECK(m.events.empty());
    for (const auto& [key, value] : m.values) {
      INFO(std::get<0>(key));
      CHECK(std::isnan(value) == (defined.count(std::get<0>(key)) == 0));
    }
  }
}

TEST_CASE("the paper's parameter set equals the defaults, the released code's has the known differences") {
  const std::map<std::string, std::map<std::string, double>> released = {
      {"sto", {{"distance_m", 0.5}, {"window", 2.0}}},
      {"ibtr", {{"distance_m", 2.5}, {"speed_fraction", 0.5}}},
      {"ldf", {{"distance_m", 1.0}, {"period_s", 1.0}}}};
  for (const auto& [name, parameters] : released) {
    INFO(name);
    const dmrp_descriptor& descriptor = *PluginLibrary::load("libdmrp_metrics.so").find("dmrp.metric." + name);
    for (const auto& [key, value] : read_parameters("paper/" + name + ".toml", descriptor)) {
      const dmrp_param_spec& spec = *parameter_of(descriptor, key);
      CHECK(value == (spec.type == DMRP_PARAM_INT ? static_cast<double>(spec.integer) : spec.number));
    }
    CHECK(read_parameters("paper/" + name + ".toml", descriptor).size() == parameters.size());
    CHECK(read_parameters("released_code/" + name + ".toml", descriptor) == parameters);
  }
}

}  // namespace descriptors_test
