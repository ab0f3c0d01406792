// SPDX-License-Identifier: MIT
// The descriptors of the metrics, their values where there is nothing to measure, and the parameter sets.
#include <toml++/toml.h>

#include <catch2/catch.hpp>
#include <map>
#include <set>

#include "tests/unit/metrics/synthetic_trial.hpp"

using namespace dmrp::test;

namespace {

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

}  // namespace

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
                                                          "after_standstill"};
  const std::set<std::string> timed = {"planning_time",     "plan_call_mean",   "plan_call_p99", "plan_missed",
                                       "control_call_mean", "control_call_p99", "control_missed"};
  const std::set<std::string> curves = {"sto_by_distance", "ibtr_by_distance",    "ibtr_by_speed_fraction",
                                        "ldf_by_distance", "pedestrian_progress", "success_at"};
  std::map<std::string, std::string> units;
  for (std::uint32_t i = 0; i < entry().plugin_count(&entry()); ++i) {
    const dmrp_descriptor& descriptor = *entry().descriptor(&entry(), i);
    INFO(descriptor.id);
    CHECK(descriptor.kind == DMRP_KIND_METRIC);
    CHECK(std::string(descriptor.summary) != "");
    CHECK(std::string(descriptor.source) != "");
    for (std::uint32_t v = 0; v < measures_of(descriptor).value_count; ++v) {
      const dmrp_metric_value_spec& value = value_of(descriptor, v);
      INFO(value.name);
      CHECK(units.emplace(value.name, value.unit).second);
      CHECK(std::string(value.description) != "");
      CHECK((value.direction == DMRP_DIRECTION_NONE) == (neither_better_nor_worse.count(value.name) == 1));
      CHECK((value.subjects & 1u << DMRP_SUBJECT_SYSTEM) != 0);
      CHECK(value.wall_clock == (timed.count(value.name) == 1 ? 1u : 0u));
      CHECK(value.curve == (curves.count(value.name) == 1 ? 1u : 0u));
    }
  }
  const std::map<std::string, std::string> expected = {{"success", "1"},
                                                       {"trial_success", "1"},
                                                       {"safe_success", "1"},
                                                       {"contact_free_success", "1"},
                                                       {"braking_response_success", "1"},
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
                                                       {"impact_speed", "m/s"},
                                                       {"sto", "1"},
                                                       {"sto_cell_size", "m"},
                                                       {"people_nearby", "1"},
                                                       {"ibtr", "%"},
                                                       {"ibtr_pair_sum", "%"},
                                                       {"ldf", "1"},
                                                       {"ldf_active", "1"},
                                                       {"pfd", "m"},
                                                       {"pfd_initial", "m"},
                                                       {"isr", "1"},
                                                       {"csr", "1"},
                                                       {"flowtime", "s"},
                                                       {"makespan", "s"},
                                                       {"throughput", "1/s"},
                                                       {"spl", "1"},
                                                       {"shortest_length", "m"},
                                                       {"sto_by_distance", "1"},
                                                       {"ibtr_by_distance", "%"},
                                                       {"ibtr_by_speed_fraction", "%"},
                                                       {"ldf_by_distance", "1"},
                                                       {"pfd_max", "m"},
                                                       {"pfd_sd", "m"},
                                                       {"clearance_static_min", "m"},
                                                       {"clearance_static_mean", "m"},
                                                       {"clearance_robot_min", "m"},
                                                       {"clearance_robot_mean", "m"},
                                                       {"clearance_person_min", "m"},
                                                       {"clearance_person_mean", "m"},
                                                       {"danger_time", "%"},
                                                       {"danger_time_robot", "%"},
                                                       {"danger_time_person", "%"},
                                                       {"ttc_min", "s"},
                                                       {"ttc_low_time", "%"},
                                                       {"success_at", "1"},
                                                       {"first_cause", "1"},
                                                       {"culprit", "1"},
                                                       {"held_behind", "1"},
                                                       {"after_standstill", "1"},
                                                       {"blocked_time", "s"},
                                                       {"blocked_time_person", "s"},
                                                       {"blocked_time_robot", "s"},
                                                       {"blocked_time_stuck", "s"},
                                                       {"held_time", "s"},
                                                       {"circling_time", "s"},
                                                       {"deadlocks", "1"},
                                                       {"deadlock_time", "s"},
                                                       {"person_standoff", "1"},
                                                       {"open_standstills", "1"},
                                                       {"neighbours", "1"},
                                                       {"proxemics_intimate", "%"},
                                                       {"proxemics_personal", "%"},
                                                       {"proxemics_social", "%"},
                                                       {"group_intrusion_time", "%"},
                                                       {"group_intrusions", "1"},
                                                       {"social_work", "m/s"},
                                                       {"social_work_robot", "m/s"},
                                                       {"social_work_people", "m/s"},
                                                       {"pedestrian_progress", "m"},
                                                       {"pedestrian_speed", "m/s"},
                                                       {"pedestrian_desired_speed", "m/s"},
                                                       {"sto_physical", "1"},
                                                       {"schedule_error_s", "s"},
                                                       {"schedule_deviation_s", "s"},
                                                       {"root_conflicts", "1"},
                                                       {"root_conflicts_waited", "1"},
                                                       {"root_conflicts_detoured", "1"},
                                                       {"root_conflicts_left", "1"},
                                                       {"heading_change", "rad"},
                                                       {"path_irregularity", "rad/m"},
                                                       {"acceleration", "m/s^2"},
                                                       {"jerk", "m/s^3"},
                                                       {"idle_time", "s"},
                                                       {"clipped_commands", "1"},
                                                       {"recoveries", "1"},
                                                       {"interventions", "1"},
                                                       {"intervention_time", "s"},
                                                       {"plan_call_mean", "ms"},
                                                       {"plan_call_p99", "ms"},
                                                       {"plan_missed", "%"},
                                                       {"control_call_mean", "ms"},
                                                       {"control_call_p99", "ms"},
                                                       {"control_missed", "%"}};
  CHECK(units == expected);
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
                                      "mission_time",
                                      "throughput",
                                      "contact_free_success",
                                      "braking_response_success",
                                      "success_at"};
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
  for (int t = 0; t <= 3; ++t)
    trial.sample(t, {at(0, 0), at(5, 0)}).events({becomes(0, DMRP_CLASS_MOVING), becomes(1, DMRP_CLASS_MOVING)});
  trial.end(3.0, {never, never});
  const std::set<std::string> no_arrival = {"completion_time", "flowtime", "makespan", "culprit", "after_standstill"};
  const std::set<std::string> no_motion = {"ttc_min", "impact_speed", "path_irregularity", "schedule_error_s",
                                           "schedule_deviation_s"};
  const std::set<std::string> no_calls = {"planning_time",     "plan_call_mean",   "plan_call_p99", "plan_missed",
                                          "control_call_mean", "control_call_p99", "control_missed"};
  const std::set<std::string> nobody = {"clearance_person_min",     "clearance_person_mean", "danger_time_person",
                                        "proxemics_intimate",       "proxemics_personal",    "proxemics_social",
                                        "group_intrusion_time",     "group_intrusions",      "social_work",
                                        "social_work_robot",        "social_work_people",    "pedestrian_progress",
                                        "pedestrian_desired_speed", "pedestrian_speed"};
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
