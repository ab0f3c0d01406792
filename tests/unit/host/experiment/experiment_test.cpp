// SPDX-License-Identifier: MIT
// Good experiment files, what follows from them, and that no file whatsoever brings the reader down.
#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/polygon.hpp>
#include <dmrp/toolkit/random.hpp>

#include "host/errors/input_error.hpp"
#include "host/results/trace_path.hpp"
#include "host/toml/nearest_name.hpp"
#include "tests/unit/host/experiment/experiment_example.hpp"

namespace experiment_test {

using namespace dmrp::test;
using namespace dmrp::host;

const ParameterValue& value_of(const PluginUse& use, const std::string& key) {
  for (const ParameterValue& value : use.parameters)
    if (value.key == key) return value;
  throw std::logic_error("no parameter " + key);
}

std::vector<std::string> labels_of(const std::vector<PluginUse>& uses) {
  std::vector<std::string> labels;
  for (const PluginUse& use : uses) labels.push_back(use.label);
  return labels;
}

// Everything that an experiment file can say.
std::string full_experiment() {
  return with(with(experiment_text, "params = { weight = 1.5 }",
                   "label = \"W\\\"é\"\n"
                   "sweep = { weight = [1.25, 2], greedy = [true, false] }\n"
                   "params = { expansions = 12345678901, order = \"last\", table = \"table.csv\", gains = [0.1, 3],"
                   " names = [\"a\", \"b\\\\c\"], note = \"line\\nbreak\" }"),
              "./hall/scenario.toml\"", "./hall/scenario.toml\"\nrobots = [2, 1]") +
         R"(
[[metric]]
use = "test.time"

[simulation]
step_s = 0.05
control_period_s = 0.1
time_limit_s = 33.3
grid_resolution_m = 0.5
step_duration_s = 1.7
planning_margin_m = 0.05
tracking = "all"
tracking_range_m = 7.7
tracking_velocity_noise_sd = 0.15
goal_tolerance_m = 0.3
goal_tolerance_rad = 0.4
goal_tolerance_speed = 0.5
goal_settle_s = 0
dispatch = "waypoint"
execution = "ordered"
replan_period_s = 2.5
replan_stray_m = 1.5
replan_stall_s = 6
replan_min_interval_s = 0.5

[recovery]
retries = 3
steps = ["backup", "wait"]
required_movement_radius_m = 0.4
movement_time_allowance_s = 8
failure_tolerance_s = 0
spin_dist_rad = 3
wait_duration_s = 2
backup_dist_m = 0.2
backup_speed = 0.1

[robot]
footprint = { radius_m = 0.2 }
v_min = -0.1
recovery_v_min = -0.2
v_max = 1.1
omega_max = 2
a_max = 3
alpha_max = 4
lidar = { beams = 90, field_of_view_rad = 3.1, range_min_m = 0.1, range_max_m = 9, noise_sd_m = 0.02, dropout_share = 0.05 }
costmap = { resolution_m = 0.1, window_m = 5, obstacle_range_m = 3, raytrace_range_m = 3.5, inflation_radius_m = 0.6, cost_scaling = 6 }

[record]
traces = "failed"
annotations = true

[limits]
planner_time_s = 1.5
step_time_s = 0.25
trial_wall_time_s = 100
memory_mb = 0
visible = ["table.csv", "/usr"]
)";
}

TEST_CASE("a short experiment is completed by defaults") {
  const ExperimentFolder folder;
  const Experiment experiment = load();
  CHECK(experiment.file == folder.path() / "experiment.toml");
  CHECK(experiment.text == experiment_text);
  CHECK(experiment.name == "test");
  CHECK(experiment.seed == 7);
  CHECK(experiment.trials == 3);
  CHECK(load(5).trials == 5);
  CHECK(experiment.warnings.empty());

  REQUIRE(experiment.libraries.size() == 1);
  CHECK(experiment.libraries[0].written == "./libfake.so");
  CHECK(experiment.libraries[0].file == folder.path() / "libfake.so");
  REQUIRE(experiment.global_planners.size() == 1);
  const PluginUse& planner = experiment.global_planners[0];
  CHECK(planner.label == "Planner");
  REQUIRE(planner.parameters.size() == 9);
  CHECK(planner.parameters[0].key == "weight");
  CHECK(planner.parameters[0].number == 1.5);
  CHECK(planner.parameters[1].integer == 1000);
  CHECK(value_of(planner, "order").text == "first");
  CHECK(value_of(planner, "table").text.empty());
  CHECK(std::isinf(value_of(planner, "horizon").number));
  CHECK(labels_of(experiment.metrics) == std::vector<std::string>{"Length", "Time"});

  CHECK_FALSE(experiment.time_limit_set);
  CHECK(experiment.simulation.step_ns == 20'000'000);
  CHECK(experiment.simulation.control_period_ns == 100'000'000);
  CHECK(experiment.robot.radius_m == 0.25);
  CHECK(experiment.traces == RecordTraces::all);
}

TEST_CASE("a scenario file as data") {
  const ExperimentFolder folder;
  const Experiment experiment = load();
  REQUIRE(experiment.scenarios.size() == 1);
  const ScenarioVariant& variant = experiment.scenarios[0];
  CHECK(variant.label == "hall");
  CHECK(variant.file == folder.path() / "hall/scenario.toml");
  const dmrp::core::Scenario& scenario = variant.scenario;
  CHECK(scenario.title == "Hall");
  CHECK(scenario.upper.x == 10.0);
  CHECK(scenario.upper.y == 8.0);
  CHECK(scenario.time_limit_s == 180.0);

  REQUIRE(scenario.shapes.size() == 3);
  for (const dmrp::core::Shape& shape : scenario.shapes)
    if (shape.kind == dmrp::core::Shape::Kind::polygon) CHECK(dmrp::toolkit::is_convex_ccw(shape.vertices));
  CHECK(dmrp::toolkit::signed_area(scenario.shapes[0].vertices) == Approx(0.8));
  CHECK(scenario.shapes[0].vertices[0].x == Approx(4.9));
  CHECK(scenario.shapes[1].radius_m == 0.3);
  CHECK(dmrp::toolkit::signed_area(scenario.shapes[2].vertices) == Approx(0.5));  // clockwise in the file

  REQUIRE(scenario.robots.size() == 2);
  CHECK(scenario.robots[0].name == "robot 0");
  CHECK(std::isnan(scenario.robots[0].start.theta));
  CHECK(std::isnan(scenario.robots[0].goals[0].theta));
  CHECK(scenario.robots[1].name == "second");
  CHECK(scenario.robots[1].start.theta == 1.5);
  REQUIRE(scenario.robots[1].goals.size() == 2);
  CHECK(scenario.robots[1].goals[1].theta == 0.0);
  REQUIRE(scenario.flows.size() == 1);
  CHECK(scenario.flows[0].regions == std::vector<std::uint32_t>{0, 1});
  CHECK(person_count(scenario) == 2);
}

TEST_CASE("a turned box keeps its size, and an origin moves the world") {
  const ExperimentFolder folder;
  write_file("hall/scenario.toml",
             with(with(scenario_text, "size_m = [10.0, 8.0]", "size_m = [12, 9]\norigin_m = [-1, -1]"),
                  "center_m = [5.0, 4.0]", "center_m = [5.0, 4.0]\nangle_rad = 1.5707963267948966"));
  const dmrp::core::Scenario scenario = load().scenarios[0].scenario;
  CHECK(scenario.lower.x == -1.0);
  CHECK(scenario.upper.x == 11.0);
  CHECK(scenario.upper.y == 8.0);
  // 0.2 x 4 turned by a right angle: the first corner goes from lower left to lower right
  CHECK(scenario.shapes[0].vertices[0].x == Approx(7.0));
  CHECK(scenario.shapes[0].vertices[0].y == Approx(3.9));
}

TEST_CASE("all settings arrive") {
  const ExperimentFolder folder;
  const Experiment e = load(full_experiment());
  CHECK(e.time_limit_set);
  CHECK(e.simulation.step_ns == 50'000'000);
  CHECK(e.simulation.control_period_ns == 100'000'000);
  CHECK(e.simulation.time_limit_ns == 33'300'000'000);
  CHECK(e.simulation.step_duration_ns == 1'700'000'000);
  CHECK(e.simulation.grid_resolution_m == 0.5);
  CHECK(e.simulation.planning_margin_m == 0.05);
  CHECK(e.simulation.tracking == dmrp::core::Tracking::all);
  CHECK(e.simulation.tracking_range_m == 7.7);
  CHECK(e.simulation.tracking_velocity_noise_sd == 0.15);
  CHECK(e.simulation.goal.tolerance_m == 0.3);
  CHECK(e.simulation.goal.tolerance_rad == 0.4);
  CHECK(e.simulation.goal.tolerance_speed == 0.5);
  CHECK(e.simulation.goal.settle_s == 0.0);
  CHECK(e.simulation.dispatch == dmrp::core::Dispatch::waypoint);
  CHECK(e.simulation.execution == dmrp::core::Execution::ordered);
  CHECK(e.simulation.replan.period_ns == 2'500'000'000);
  CHECK(e.simulation.replan.stray_m == 1.5);
  CHECK(e.simulation.replan.stall_ns == 6'000'000'000);
  CHECK(e.simulation.replan.min_interval_ns == 500'000'000);
  const dmrp::core::RecoverySettings& recovery = e.simulation.recovery;
  CHECK(recovery.retries == 3);
  CHECK(recovery.steps == std::vector{dmrp::core::RecoveryStep::backup, dmrp::core::RecoveryStep::wait});
  CHECK(recovery.required_movement_radius_m == 0.4);
  CHECK(recovery.movement_time_allowance_ns == 8'000'000'000);
  CHECK(recovery.failure_tolerance_ns == 0);
  CHECK(recovery.spin_dist_rad == 3.0);
  CHECK(recovery.wait_duration_ns == 2'000'000'000);
  CHECK(recovery.backup_dist_m == 0.2);
  CHECK(recovery.backup_speed == 0.1);
  CHECK(e.robot.radius_m == 0.2);
  CHECK(e.robot.v_min == -0.1);
  CHECK(e.robot.recovery_v_min == -0.2);
  CHECK(e.robot.v_max == 1.1);
  CHECK(e.robot.omega_max == 2.0);
  CHECK(e.robot.a_max == 3.0);
  CHECK(e.robot.alpha_max == 4.0);
  CHECK(e.robot.lidar.beams == 90);
  CHECK(e.robot.lidar.field_of_view_rad == 3.1);
  CHECK(e.robot.lidar.range_min_m == 0.1);
  CHECK(e.robot.lidar.range_max_m == 9.0);
  CHECK(e.robot.lidar.noise_sd_m == 0.02);
  CHECK(e.robot.lidar.dropout_share == 0.05);
  CHECK(e.robot.costmap.resolution_m == 0.1);
  CHECK(e.robot.costmap.window_m == 5.0);
  CHECK(e.robot.costmap.obstacle_range_m == 3.0);
  CHECK(e.robot.costmap.raytrace_range_m == 3.5);
  CHECK(e.robot.costmap.inflation_radius_m == 0.6);
  CHECK(e.robot.costmap.cost_scaling == 6.0);
  CHECK(e.traces == RecordTraces::failed);
  CHECK(e.annotations);
  CHECK(e.limits.planner_time_s == 1.5);
  CHECK(e.limits.step_time_s == 0.25);
  CHECK(e.limits.trial_wall_time_s == 100.0);
  CHECK(e.limits.memory_mb == 0);
  CHECK(e.limits.visible == VisiblePaths{folder.path() / "table.csv", "/usr"});
  // cells of 0.5 m for robots of 0.2 m: 2 sqrt(2) r = 0.566 m
  REQUIRE(e.warnings.size() == 1);
  CHECK(e.warnings[0] ==
        "hall/scenario.toml:5:10: cells of 0.5 m are smaller than 2 sqrt(2) r = 0.566 m: robots can touch on "
        "different cells; plans keep them apart by their footprints");
}

TEST_CASE("a sweep makes a labelled variant of every combination") {
  const ExperimentFolder folder;
  const Experiment e = load(full_experiment());
  CHECK(labels_of(e.global_planners) ==
        std::vector<std::string>{"W\"é (weight 1.25, greedy on)", "W\"é (weight 1.25, greedy off)",
                                 "W\"é (weight 2, greedy on)", "W\"é (weight 2, greedy off)"});
  CHECK(value_of(e.global_planners[2], "weight").number == 2.0);
  CHECK(value_of(e.global_planners[2], "greedy").integer == 1);
  for (const PluginUse& use : e.global_planners) {
    CHECK(value_of(use, "expansions").integer == 12345678901);
    CHECK(value_of(use, "order").text == "last");
    CHECK(value_of(use, "table").text == folder.path() / "table.csv");
    CHECK(value_of(use, "gains").numbers == std::vector<double>{0.1, 3.0});
    CHECK(value_of(use, "names").texts == std::vector<std::string>{"a", "b\\c"});
  }
  CHECK(labels_of(e.metrics) == std::vector<std::string>{"Time"});
}

TEST_CASE("a parameter file gives values that params and sweep override") {
  const ExperimentFolder folder;
  write_file("sets/good.toml", "weight = 4\nexpansions = 7\ngreedy = true\ntable = \"near.csv\"\n");
  write_file("sets/near.csv", "1\n");
  const Experiment e =
      load(with(experiment_text, "params = { weight = 1.5 }",
                "params_file = \"sets/good.toml\"\nparams = { weight = 1.5 }\nsweep = { greedy = [false, true] }"));
  REQUIRE(e.global_planners.size() == 2);
  const PluginUse& use = e.global_planners[0];
  CHECK(use.label == "Planner (greedy off)");
  CHECK(use.parameter_file == folder.path() / "sets/good.toml");
  CHECK(value_of(use, "weight").number == 1.5);
  CHECK(value_of(use, "expansions").integer == 7);
  CHECK(value_of(use, "greedy").integer == 0);
  CHECK(value_of(e.global_planners[1], "greedy").integer == 1);
  CHECK(value_of(use, "table").text == folder.path() / "sets/near.csv");  // relative to the file that names it
  CHECK(value_of(use, "order").text == "first");
  CHECK(e.local_controllers[0].parameter_file.empty());

  // with the values written out it is another file but the same parameters
  const Experiment again = load(effective_toml(e));
  CHECK(effective_toml(again) == effective_toml(e));
  CHECK(again.global_planners[0].parameter_file.empty());

  SECTION("for plugins of every kind, and without values") {
    write_file("empty.toml", "# nothing\n");
    const Experiment all =
        load(with(with(experiment_text, "\"test.controller\"", "\"test.controller\"\nparams_file = \"empty.toml\""),
                  "\"test.model\"", "\"test.model\"\nparams_file = \"./empty.toml\"") +
             "[[metric]]\nuse = \"test.time\"\nparams_file = \"" + (folder.path() / "empty.toml").string() + "\"\n");
    CHECK(all.local_controllers[0].parameter_file == folder.path() / "empty.toml");
    CHECK(all.pedestrian_models[0].parameter_file == folder.path() / "empty.toml");
    CHECK(all.metrics[0].parameter_file == folder.path() / "empty.toml");
  }
}

TEST_CASE("a number of robots selects the first of the list") {
  const ExperimentFolder folder;
  const Experiment e = load(full_experiment());
  REQUIRE(e.scenarios.size() == 2);
  CHECK(e.scenarios[0].label == "hall");
  CHECK(e.scenarios[1].label == "hall/1");
  REQUIRE(e.scenarios[1].scenario.robots.size() == 1);
  CHECK(e.scenarios[1].scenario.robots[0].name == "robot 0");

  // a robot that takes no part may stand in a wall
  write_file("hall/scenario.toml", with(scenario_text, "start = [0.5, 3.5, 1.5]", "start = [5, 4]"));
  CHECK_NOTHROW(load(with(experiment_text, "scenario.toml\"", "scenario.toml\"\nrobots = 1")));
  CHECK_THROWS_AS(load(experiment_text), InputError);
}

TEST_CASE("names and titles have defaults, and a map alone is a scenario") {
  const ExperimentFolder folder;
  std::string bare = scenario_text;
  for (const char* line : {"name = \"hall\"\n", "title = \"Hall\"\n", "name = \"wall\"\n", "name = \"across\"\n",
                           "description = \"a wall in the middle, open at both ends\"\n"})
    bare = with(bare, line, "");
  write_file("hall/scenario.toml", bare);
  const auto hall = load(experiment_text).scenarios[0].scenario;
  CHECK(hall.name == "hall");
  CHECK(hall.title == "hall");
  CHECK(hall.shapes[0].name == "box 1");
  CHECK(hall.flows[0].name == "flow 1");

  std::string map = "type octile\nheight 12\nwidth 30\nmap\n";
  for (int row = 0; row < 12; ++row) map += std::string(30, '.') + "\n";
  write_file("ward.map", map);
  const Experiment on_map =
      load(with(experiment_text, "use = \"./hall/scenario.toml\"", "use = \"ward.map\"\nrobots = 2"));
  CHECK(on_map.scenarios[0].scenario.name == "ward");
  CHECK(on_map.scenarios[0].scenario.upper.x == 30.0);
  CHECK(on_map.scenarios[0].drawn_robots == 2);
  CHECK(on_map.scenarios[0].files.size() == 1);
}

TEST_CASE("a long run keeps the traces of failed trials and of each combination's first, unless it says otherwise") {
  const ExperimentFolder folder;
  CHECK(load(with(experiment_text, "trials = 3", "trials = 100")).traces == RecordTraces::all);
  const std::string many = with(experiment_text, "trials = 3", "trials = 101");
  const Experiment long_run = load(many);
  CHECK(long_run.traces == RecordTraces::some);
  CHECK_THAT(effective_toml(long_run), Catch::Contains("= \"some\""));
  CHECK(load(many + "[record]\ntraces = \"all\"\n").traces == RecordTraces::all);
  TrialRecord trial;
  trial.outcome = trial_outcome::succeeded;
  trial.repetition = 3;
  CHECK(keeps_trace(RecordTraces::all, trial));
  CHECK_FALSE(keeps_trace(RecordTraces::some, trial));
  trial.repetition = 0;
  CHECK(keeps_trace(RecordTraces::some, trial));
  CHECK_FALSE(keeps_trace(RecordTraces::failed, trial));
  trial.outcome = trial_outcome::failed;
  CHECK(keeps_trace(RecordTraces::failed, trial));
  CHECK_FALSE(keeps_trace(RecordTraces::none, trial));
}

TEST_CASE("near starts and libraries with warnings give warnings") {
  const ExperimentFolder folder;
  write_file("hall/scenario.toml", with(scenario_text, "start = [0.5, 3.5, 1.5]", "start = [0.5, 2.5]"));
  const Experiment e = load(with(with(experiment_text, "\"./libfake.so\"", "\"./libfake.so\", \"./librival.so\""),
                                 "[[local_controller]]", "[[metric]]\nuse = \"test.time\"\n[[local_controller]]"));
  REQUIRE(e.warnings.size() == 2);
  CHECK(e.warnings[0] == "experiment.toml:5:28: ./librival.so: changes the rounding mode");
  CHECK(e.warnings[1] ==
        "hall/scenario.toml:25:1: the starts of robots 0 and 1 are 2.00 m apart; the method wants more than 2 m");
}

TEST_CASE("libraries and scenarios are found by name in the folders of the environment") {
  const ExperimentFolder folder;
  std::filesystem::create_directory("lib");
  std::filesystem::rename("libfake.so", "lib/libfake.so");
  setenv("DMRP_PLUGIN_PATH", (folder.path() / "lib").c_str(), 1);
  setenv("DMRP_SCENARIO_PATH", folder.path().c_str(), 1);
  const std::string by_name = with(with(experiment_text, "./libfake.so", "libfake.so"), "./hall/scenario.toml", "hall");
  const Experiment e = load(by_name);
  CHECK(e.libraries[0].file == folder.path() / "lib/libfake.so");
  CHECK(e.scenarios[0].file == folder.path() / "hall/scenario.toml");

  const auto starts = Catch::Matchers::StartsWith(
      "experiment.toml:5:12: no library 'libfak.so' (did you mean 'libfake.so'?) (searched: lib, ");
  const auto ends = Catch::Matchers::EndsWith(")");
  CHECK_THROWS_WITH(load(with(by_name, "libfake.so", "libfak.so")), starts && ends);
  CHECK_THROWS_WITH(
      load(with(by_name, "\"hall\"", "\"hal\"")),
      Catch::Matchers::StartsWith("experiment.toml:8:7: no scenario 'hal' (did you mean 'hall'?) (shipped: ") &&
          Catch::Matchers::EndsWith("DMRP_SCENARIO_PATH is " + folder.path().string() + ")"));
  unsetenv("DMRP_PLUGIN_PATH");
  unsetenv("DMRP_SCENARIO_PATH");
}

TEST_CASE("a missing file") {
  const ExperimentFolder folder;
  CHECK_THROWS_WITH(load_experiment("none.toml", 0, &fake_probe), "none.toml: there is no such experiment file");
  CHECK_THROWS_WITH(load_experiment("hall", 0, &fake_probe), "hall: there is no such experiment file");
}

TEST_CASE("effective.toml reads back as the same experiment, from anywhere") {
  const ExperimentFolder folder;
  const std::string text = GENERATE(std::string(experiment_text), full_experiment());
  const Experiment original = load(text);
  const std::string effective = effective_toml(original);
  write_file("elsewhere/effective.toml", effective);
  const Experiment again = load_experiment("elsewhere/effective.toml", 0, &fake_probe);
  CHECK(effective_toml(again) == effective);
  CHECK(identity_digest(again) == identity_digest(original));
  CHECK(labels_of(again.global_planners) == labels_of(original.global_planners));
  for (std::size_t i = 0; i < original.scenarios.size(); ++i)
    CHECK(again.scenarios[i].label == original.scenarios[i].label);
}

TEST_CASE("plans from files are known by what they hold, wherever they lie") {
  const ExperimentFolder folder;
  const std::string planner = "[[global_planner]]\nuse = \"test.planner\"\nparams = { weight = 1.5 }\n";
  const std::string text = with(experiment_text, planner,
                                "[[global_planner]]\nfile = \"cbs.csv\"\n"
                                "[[global_planner]]\nfile = \"sets/lacam_{repetition}.csv\"\nany_angle = true\n"
                                "[[global_planner]]\nfile = \"sets/{repetition}.csv\"\nlabel = \"theirs\"\n"
                                "[[global_planner]]\nfile = \"sets/{repetition}.txt\"\n");
  for (const char* file :
       {"cbs.csv", "sets/lacam_0.csv", "sets/lacam_2.csv", "sets/lacam_x.csv", "sets/007.csv", "sets/1.txt"})
    write_file(file, file);
  const Experiment e = load(text);
  CHECK(labels_of(e.global_planners) == std::vector<std::string>{"cbs", "lacam", "theirs", "sets"});
  const auto name = [](const std::filesystem::path& file) { return file.filename().string(); };
  CHECK(name(e.global_planners[0].plans.of(5)) == "cbs.csv");
  CHECK(name(e.global_planners[1].plans.of(2)) == "lacam_2.csv");
  CHECK(e.global_planners[1].plans.of(1).empty());
  CHECK(e.global_planners[1].plans.all().size() == 2);
  CHECK(name(e.global_planners[2].plans.of(7)) == "007.csv");
  CHECK(e.global_planners[0].info.connectivity == DMRP_CONNECTIVITY_8);
  CHECK(e.global_planners[1].info.connectivity == DMRP_CONNECTIVITY_ANY);

  write_file("elsewhere/effective.toml", effective_toml(e));
  const Experiment again = load_experiment("elsewhere/effective.toml", 0, &fake_probe);
  CHECK(identity_of(again) == identity_of(e));
  CHECK(effective_toml(again) == effective_toml(e));
  CHECK(identity_of(e).at("global_planner[0].file").size() == 66);
  CHECK_FALSE(identity_of(e).contains("global_planner[0].version"));
  const std::string digest = identity_digest(e);
  const char* const edited = GENERATE("cbs.csv", "sets/lacam_2.csv", "sets/lacam_1.csv");
  write_file(edited, "other");
  CHECK(identity_digest(load(text)) != digest);
  write_file("sets/7.csv", "a second one");
  CHECK_THROWS_WITH(load(text), Catch::Matchers::Contains("two files are those of repetition 7"));
}

TEST_CASE("plans from files are never made anew, which is told where something asks for that") {
  const ExperimentFolder folder;
  const std::string text = std::string(experiment_text) + "[[global_planner]]\nfile = \"table.csv\"\n";
  CHECK(load(text).warnings.empty());
  const auto warnings = load(text + "[simulation]\nreplan_stall_s = 5\n").warnings;
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].starts_with("experiment.toml:20:8: plans from a file are never made anew"));
}

TEST_CASE("an experiment is the same wherever its files lie, and whatever its name and number of trials") {
  const ExperimentFolder folder;
  const Experiment here = load(full_experiment());
  std::filesystem::create_directory("elsewhere");
  for (const char* name : {"hall", "libfake.so", "table.csv"})
    std::filesystem::copy(name, std::filesystem::path("elsewhere") / name, std::filesystem::copy_options::recursive);
  write_file("elsewhere/other_name.toml", with(full_experiment(), "name = \"test\"\n", ""));
  const Experiment there = load_experiment("elsewhere/other_name.toml", 40, &fake_probe);
  CHECK(there.name == "other_name");
  CHECK(there.trials == 40);
  CHECK(identity_of(there) == identity_of(here));
  CHECK(identity_digest(there) == identity_digest(here));
}

TEST_CASE("what an experiment means has a key for everything that can change a value") {
  const ExperimentFolder folder;
  const std::map<std::string, std::string> identity = identity_of(load(full_experiment()));
  CHECK(identity.at("experiment.seed") == "7");
  CHECK(identity.at("simulation.step_s") == "0.05");
  CHECK(identity.at("robot.v_max") == "1.1");
  CHECK(identity.at("scenario[0].use").starts_with("\"hall "));
  CHECK(identity.at("scenario[1].robots") == "1");
  CHECK(identity.at("global_planner[0].use") == "\"test.planner\"");
  CHECK(identity.at("global_planner[0].version") == "\"\"");
  CHECK(identity.at("global_planner[0].params.weight") == "1.25");
  for (const auto& [key, value] : identity)
    CHECK(value.find(folder.path().string()) == std::string::npos);  // no path is part of it
}

TEST_CASE("the digest changes with every file that an experiment reads") {
  const ExperimentFolder folder;
  const std::string digest = identity_digest(load(full_experiment()));
  CHECK(digest.size() == 64);
  CHECK(identity_digest(load(full_experiment())) == digest);
  const auto changed = [&] { return identity_digest(load(full_experiment())) != digest; };
  SECTION("a setting") {
    CHECK(identity_digest(load(with(full_experiment(), "seed = 7", "seed = 8"))) != digest);
  }
  SECTION("a library: that of what processes load, but a plugin is known by id and version") {
    const std::string loaded = loaded_digest(load(full_experiment()));
    write_file("libfake.so", "another");
    CHECK_FALSE(changed());
    CHECK(loaded_digest(load(full_experiment())) != loaded);
  }
  SECTION("a scenario") {
    write_file("hall/scenario.toml", with(scenario_text, "people = 2", "people = 3"));
    CHECK(changed());
  }
  SECTION("a file that a parameter names") {
    write_file("table.csv", "1,3\n");
    CHECK(changed());
  }
  SECTION("a file of parameters, if it has other values") {
    const std::string text = with(experiment_text, "params = {", "params_file = \"set.toml\"\nparams = {");
    write_file("set.toml", "expansions = 7\n");
    const std::string before = identity_digest(load(text));
    write_file("set.toml", "expansions = 7  # seven\n");
    CHECK(identity_digest(load(text)) == before);
    write_file("set.toml", "expansions = 8\n");
    CHECK(identity_digest(load(text)) != before);
  }
}

TEST_CASE("combinations vary the model fastest and need a model only for scenarios with people") {
  const ExperimentFolder folder;
  write_file("empty/scenario.toml",
             with(with(scenario_text, "name = \"hall\"", "name = \"empty\""), "people = 2", "people = 0"));
  const Experiment e = load(with(full_experiment(), "[[global_planner]]",
                                 "[[scenario]]\nuse = \"./empty/scenario.toml\"\n\n[[global_planner]]") +
                            "\n[[pedestrian_model]]\nuse = \"test.model\"\nlabel = \"second\"\n");
  const auto all = combinations(e);
  // two variants of the hall x 4 planners x 1 controller x 2 models, and the empty one x 4
  REQUIRE(all.size() == 20);
  CHECK(all[0].pedestrian_model == 0);
  CHECK(all[1].pedestrian_model == 1);
  CHECK(all[2].global_planner == 1);
  CHECK(all[8].scenario == 1);
  for (std::size_t i = 16; i < 20; ++i) {
    CHECK(all[i].scenario == 2);
    CHECK(all[i].pedestrian_model == -1);
  }
  const TrialId id = trial_id(47, all.size());
  CHECK(id.number == 47);
  CHECK(id.combination == 7);
  CHECK(id.repetition == 2);
}

TEST_CASE("the nearest name") {
  CHECK(nearest_name("wieght", {"height", "weight"}) == "weight");
  CHECK(nearest_name("nothing like it", {"height", "weight"}).empty());
  CHECK(did_you_mean("mal", {"office", "mall"}) == " (did you mean 'mall'?)");
  CHECK(did_you_mean("x", {}).empty());
}

TEST_CASE("damaged files give an error of one line or an experiment") {
  const ExperimentFolder folder;
  const std::string pieces[] = {"[",    "]",   "{",  "}",      "\"",  "=",    "\n",       ".",   ",",
                                "-1",   "1e9", "[]", "{}",     "nan", "true", "\"\\n\"",  "\0",  "[[robot]]",
                                "\xff", "é",   "0",  "'a\tb'", "#",   "99",   "[[flow]]", "use", "1979-05-27"};
  dmrp::toolkit::Stream random(1, "test.damage", 0);
  int errors = 0;
  const int rounds = 600;
  for (int round = 0; round < rounds; ++round) {
    const bool in_scenario = random.below(2) == 0;
    std::string text = in_scenario ? std::string(scenario_text) : full_experiment();
    for (auto damages = 1 + random.below(3); damages > 0; --damages) {
      const auto at = static_cast<std::size_t>(random.below(static_cast<std::uint32_t>(text.size())));
      switch (random.below(3)) {
        case 0:
          text.erase(at, 1 + random.below(12));
          break;
        case 1:
          text.insert(at, pieces[random.below(static_cast<std::uint32_t>(std::size(pieces)))]);
          break;
        default:
          text.insert(at, text.substr(random.below(static_cast<std::uint32_t>(text.size())), random.below(40)));
      }
    }
    write_file("hall/scenario.toml", in_scenario ? text : scenario_text);
    try {
      load(in_scenario ? std::string(experiment_text) : text);
    } catch (const InputError& error) {
      ++errors;
      INFO(text);
      const std::string message = error.what();
      CHECK(message.find('\n') == std::string::npos);
      CHECK((message.starts_with("experiment.toml:") || message.starts_with("hall/scenario.toml:")));
    }
  }
  CHECK(errors > rounds / 3);
  CHECK(errors < rounds);
}

TEST_CASE("what cannot be loaded is left out if the experiment says so") {
  const ExperimentFolder folder;
  const std::string two_bad = with(experiment_text, "plugins = [\"./libfake.so\"]",
                                   "skip_unloadable = true\nplugins = [\"./libbad.so\", \"./libfake.so\", "
                                   "\"./libsick.so\"]");
  const Experiment plain = load(experiment_text);
  const Experiment experiment = load(two_bad + "\n[[local_controller]]\nuse = \"of.libbad\"\n");
  REQUIRE(experiment.libraries.size() == 1);
  CHECK(experiment.libraries[0].written == "./libfake.so");
  CHECK(experiment.unloadable == std::vector{folder.path() / "libbad.so", folder.path() / "libsick.so"});
  CHECK(experiment.left_out ==
        std::vector<std::string>{
            "./libbad.so: not a dmrp v1 plugin", "./libsick.so: its init() failed: no licence",
            "no local_controller 'of.libbad' in the loaded libraries (there: test.controller, test.psychic)"});
  CHECK(experiment.warnings[0] == "experiment.toml:6:12: left out: ./libbad.so: not a dmrp v1 plugin");
  CHECK(identity_digest(experiment) == identity_digest(plain));

  // a source that loads into this process is not asked for a library that fails elsewhere
  std::vector<std::string> asked;
  const auto source = [&](const std::filesystem::path& file, const VisiblePaths& visible) {
    asked.push_back(file.filename());
    return fake_probe(file.filename() == "libfake.so" ? file : "libfake.so", visible);
  };
  CHECK(load_experiment("experiment.toml", 0, source, &fake_probe).left_out == experiment.left_out);
  CHECK(asked == std::vector<std::string>{"libfake.so"});

  const auto refusal = [](const std::string& text) -> std::string {
    try {
      load(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  CHECK_THAT(refusal(with(two_bad, "test.model", "of.libbad")),
             Catch::EndsWith("no [[pedestrian_model]] is in a library that can be loaded"));
  CHECK_THAT(refusal(two_bad + "\n[[metric]]\nuse = \"of.libbad\"\n"),
             Catch::EndsWith("no [[metric]] is in a library that can be loaded"));
  CHECK(refusal(with(two_bad, "\"./libfake.so\", ", "")) == "experiment.toml:6:11: none of 'plugins' can be loaded");
  CHECK(refusal(with(two_bad, "libbad", "libbat")) ==
        "experiment.toml:6:12: no library './libbat.so' (there is no file libbat.so)");
}

}  // namespace experiment_test
