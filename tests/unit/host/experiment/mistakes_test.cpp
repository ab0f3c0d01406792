// SPDX-License-Identifier: MIT
// Every mistake is told in one line, at its place, and says what to do; all of a file: all_mistakes_test.
#include "host/errors/mistakes.hpp"

#include <catch2/catch.hpp>

#include "tests/unit/host/experiment/experiment_example.hpp"

namespace {

using namespace dmrp::test;
using dmrp::host::InputError;

std::string message_of(const std::string& experiment, const std::string& scenario) {
  write_file("hall/scenario.toml", scenario);
  try {
    load(experiment);
  } catch (const dmrp::host::InputErrors& errors) {
    std::string all;  // a mistake is told once, and nothing that follows from it
    for (const InputError& mistake : errors.mistakes()) all += std::string(mistake.what()) + "\n";
    return all;
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

struct Mistake {
  const char* from;
  const char* to;
  const char* message;
};

}  // namespace

TEST_CASE("mistakes in an experiment file") {
  const ExperimentFolder folder;
  const Mistake mistakes[] = {
      // syntax and structure
      {"[experiment]\n", "",
       "experiment.toml:1:1: unknown key 'name' (it is a key of [experiment])\n"
       "experiment.toml:1:1: the file needs [experiment]\n"
       "experiment.toml:2:1: unknown key 'seed' (it is a key of [experiment])\n"
       "experiment.toml:3:1: unknown key 'trials' (it is a key of [experiment])\n"
       "experiment.toml:4:1: unknown key 'plugins' (it is a key of [experiment])\n"},
      {"[experiment]", "[experimant]", "experiment.toml:1:2: unknown key 'experimant' (did you mean 'experiment'?)"},
      {"seed", "sed", "experiment.toml:3:1: unknown key 'sed' in [experiment] (did you mean 'seed'?)"},
      {"seed = 7", "seed = 7\nseed = 8",
       "experiment.toml:4:8: Error while parsing key-value pair: "
       "cannot redefine existing integer 'seed'"},
      {"plugins = [\"./libfake.so\"]\n", "", "experiment.toml:1:1: [experiment] needs 'plugins'"},
      {"plugins = [\"./libfake.so\"]", "plugins = []",
       "experiment.toml:5:11: 'plugins' must name at least one library"},
      {"plugins = [\"./libfake.so\"]", "plugins = \"./libfake.so\"",
       "experiment.toml:5:11: 'plugins' must be an array, not a string"},
      {"plugins = [\"./libfake.so\"]", "plugins = [1]",
       "experiment.toml:5:12: 'plugins' must be a string, not an integer"},
      {"[[scenario]]", "[scenario]", "experiment.toml:7:1: 'scenario' must be written as [[scenario]]"},
      {"[[scenario]]\nuse = \"./hall/scenario.toml\"\n", "",
       "experiment.toml:1:1: the experiment needs a [[scenario]]"},
      {"[[global_planner]]\nuse = \"test.planner\"\nparams = { weight = 1.5 }\n", "",
       "experiment.toml:1:1: the experiment needs a [[global_planner]]"},
      {"[[local_controller]]\nuse = \"test.controller\"\n", "",
       "experiment.toml:1:1: the experiment needs a [[local_controller]]"},
      {"[[pedestrian_model]]\nuse = \"test.model\"\n", "",
       "experiment.toml:8:7: scenario 'hall' has 2 people: the experiment needs a [[pedestrian_model]]"},
      // [experiment]
      {"\"test\"", "\"a/b\"",
       "experiment.toml:2:8: 'name' is the name of the run directory: it must not contain '/' or begin with '.'"},
      {"\"test\"", "\"..\"",
       "experiment.toml:2:8: 'name' is the name of the run directory: it must not contain '/' or begin with '.'"},
      {"\"test\"", "\"\"", "experiment.toml:2:8: 'name' must not be empty"},
      {"\"test\"", "\"a\\nb\"", "experiment.toml:2:8: 'name' must not have line breaks or other control characters"},
      {"seed = 7", "seed = -1", "experiment.toml:3:8: 'seed' must be at least 0, not -1"},
      {"seed = 7", "seed = 7.5", "experiment.toml:3:8: 'seed' must be an integer, not a float"},
      {"trials = 3", "trials = 0", "experiment.toml:4:10: 'trials' must be at least 1, not 0"},
      {"trials = 3", "trials = \"3\"", "experiment.toml:4:10: 'trials' must be an integer, not a string"},
      // libraries
      {"./libfake.so", "./libfke.so", "experiment.toml:5:12: no library './libfke.so' (there is no file libfke.so)"},
      {"./libfake.so", "./libbad.so", "experiment.toml:5:12: ./libbad.so: not a dmrp v1 plugin"},
      {"./libfake.so", "libfake.so",
       "experiment.toml:5:12: no library 'libfake.so' in the plugin path (did you mean './libfake.so'?)"},
      {"\"./libfake.so\"", "\"./libfake.so\", \"./libfake.so\"",
       "experiment.toml:5:28: ./libfake.so: the library is named twice"},
      {"\"./libfake.so\"", "\"./libfake.so\", \"./libtwin.so\"",
       "experiment.toml:5:28: ./libtwin.so: has test.model, which is in ./libfake.so already"},
      {"\"./libfake.so\"", "\"./libsick.so\"", "experiment.toml:5:12: ./libsick.so: its init() failed: no licence"},
      {"\"./libfake.so\"", "\"./libfake.so\", \"./librival.so\"",
       "experiment.toml:5:11: two metrics give a value 'length': test.length and rival.length"},
      // scenarios
      {"./hall/scenario.toml", "./hal/scenario.toml",
       "experiment.toml:8:7: no scenario './hal/scenario.toml' (there is no such file beside the experiment file)"},
      {"scenario.toml\"", "scenario.toml\"\nrobots = [1, -1]",
       "experiment.toml:9:14: 'robots' must be at least 0, not -1"},
      {"scenario.toml\"", "scenario.toml\"\nrobots = []",
       "experiment.toml:9:10: 'robots' must have at least one number"},
      {"scenario.toml\"", "scenario.toml\"\nrobots = [1, 1]", "experiment.toml:9:14: scenario 'hall/1' occurs twice"},
      {"scenario.toml\"", "scenario.toml\"\nrobot = 1",
       "experiment.toml:9:1: unknown key 'robot' in [[scenario]] (did you mean 'robots'?)"},
      // keys of other tables
      {"[[scenario]]", "[simulation]\nactuation_latency_s = 0.1\n[[scenario]]",
       "experiment.toml:8:1: unknown key 'actuation_latency_s' in [simulation] (it is a key of [robot])"},
      {"[[scenario]]", "[robot]\nplanning_latency_s = 0.1\n[[scenario]]",
       "experiment.toml:8:1: unknown key 'planning_latency_s' in [robot] (it is a key of [simulation])"},
      {"[[scenario]]", "[robot]\nradius_m = 0.3\n[[scenario]]",
       "experiment.toml:8:1: unknown key 'radius_m' in [robot] (it is a key of [robot.footprint])"},
      {"seed = 7", "lidar = 7", "experiment.toml:3:1: unknown key 'lidar' in [experiment] (it is a key of [robot])"},
      {"weight = 1.5", "v_max = 1.5",
       "experiment.toml:12:12: unknown key 'v_max' for test.planner (it is a key of [robot])"},
      {"[experiment]", "trials = 2\n[experiment]",
       "experiment.toml:1:1: unknown key 'trials' (it is a key of [experiment])"},
      // plugins
      {"use = \"test.planner\"\n", "", "experiment.toml:10:1: [[global_planner]] needs 'use'"},
      {"\"test.planner\"", "\"test.planer\"",
       "experiment.toml:11:7: no global_planner 'test.planer' in the loaded libraries (there: test.planner) (did you "
       "mean 'test.planner'?)"},
      {"\"test.planner\"", "\"test.model\"",
       "experiment.toml:11:7: test.model is a pedestrian_model, not a global_planner"},
      {"\"test.controller\"", "\"test.psychic\"",
       "experiment.toml:15:7: test.psychic needs the extension org.example.telepathy/1, which this host does not "
       "offer to a local_controller (offered: dmrp.annotate/1, dmrp.lidar/1, dmrp.local_costmap/1, "
       "dmrp.distance_field/1, dmrp.obstacle_clusters/1, dmrp.timing/1)"},
      {"[[local_controller]]", "[[global_planner]]\nuse = \"test.planner\"\n[[local_controller]]",
       "experiment.toml:15:7: two of [[global_planner]] are called 'Planner': give one another 'label'"},
      {"[[local_controller]]",
       "[[metric]]\nuse = \"test.length\"\n[[metric]]\nuse = \"test.length\"\nlabel = \"again\"\n[[local_controller]]",
       "experiment.toml:17:7: two metrics give a value 'length': Length and again"},
      // parameters
      {"weight = 1.5", "wieght = 1.5",
       "experiment.toml:12:12: unknown key 'wieght' for test.planner (did you mean 'weight'?)"},
      {"weight = 1.5", "weight = true", "experiment.toml:12:21: 'weight' must be a number, not a boolean"},
      {"weight = 1.5", "weight = 0.5", "experiment.toml:12:21: 'weight' must be from 1 to 10 m, not 0.5"},
      {"weight = 1.5", "weight = nan", "experiment.toml:12:21: 'weight' must be finite"},
      {"weight = 1.5", "expansions = 0", "experiment.toml:12:25: 'expansions' must be at least 1, not 0"},
      {"weight = 1.5", "expansions = 1.0", "experiment.toml:12:25: 'expansions' must be an integer, not a float"},
      {"weight = 1.5", "greedy = 1", "experiment.toml:12:21: 'greedy' must be true or false, not an integer"},
      {"weight = 1.5", "order = \"lst\"",
       "experiment.toml:12:20: 'order' must be one of first, last, not 'lst' (did you mean 'last'?)"},
      {"weight = 1.5", "table = \"tabel.csv\"", "experiment.toml:12:20: 'table' names no file: 'tabel.csv'"},
      {"weight = 1.5", "gains = [1, -1]", "experiment.toml:12:24: 'gains' must be at least 0, not -1"},
      {"weight = 1.5", "names = [1]", "experiment.toml:12:21: 'names' must be a string, not an integer"},
      {"params = { weight = 1.5 }", "params = 3", "experiment.toml:12:10: 'params' must be a table, not an integer"},
      {"params = { weight = 1.5 }", "sweep = { weight = 2 }",
       "experiment.toml:12:20: 'weight' must be an array, not an integer"},
      {"params = { weight = 1.5 }", "sweep = { weight = [] }", "experiment.toml:12:20: 'weight' sweeps over no values"},
      {"params = { weight = 1.5 }", "sweep = { weight = [2, 2.0] }",
       "experiment.toml:12:24: 'weight 2' twice in a sweep"},
      {"params = { weight = 1.5 }", "params = { weight = 1.5 }\nsweep = { weight = [2] }",
       "experiment.toml:13:11: 'weight' is already set in 'params'"},
      {"params = { weight = 1.5 }", "sweep = { weigth = [2] }",
       "experiment.toml:12:11: unknown key 'weigth' for test.planner (did you mean 'weight'?)"},
      // in the order of the file, whatever is read first
      {"params = { weight = 1.5 }", "params = { zeal = 1, weight = 0, above = 2 }",
       "experiment.toml:12:12: unknown key 'zeal' for test.planner\n"
       "experiment.toml:12:31: 'weight' must be from 1 to 10 m, not 0\n"
       "experiment.toml:12:34: unknown key 'above' for test.planner\n"},
  };
  for (const Mistake& mistake : mistakes) {
    INFO(mistake.to);
    CHECK(message_of(with(experiment_text, mistake.from, mistake.to), scenario_text) == mistake.message);
  }
}

TEST_CASE("mistakes in a parameter file") {
  const ExperimentFolder folder;
  const auto told = [](const std::string& lines) {
    write_file("set.toml", lines);
    return message_of(with(experiment_text, "params = {", "params_file = \"set.toml\"\nparams = {"), scenario_text);
  };
  CHECK(told("weight = 2") == "no error");
  CHECK(told("greedy = true\n wieght = 2") ==
        "set.toml:2:2: unknown key 'wieght' for test.planner (did you mean 'weight'?)");
  CHECK(told("# heavy\nweight = 20") == "set.toml:2:10: 'weight' must be from 1 to 10 m, not 20");
  CHECK(told("weight = [2, 3]") ==
        "set.toml:1:10: 'weight' must be one value, not an array (for variants, the experiment has "
        "sweep = { weight = [...] })");
  CHECK(told("[params]\nweight = 2") == "set.toml:1:2: unknown key 'params' for test.planner");
  CHECK(told("table = \"tabel.csv\"") == "set.toml:1:9: 'table' names no file: 'tabel.csv'");
  CHECK(told("weight = = 2").substr(0, 14) == "set.toml:1:10:");

  const auto unnamed = [](const std::string& value) {
    return message_of(with(experiment_text, "params = {", "params_file = " + value + "\nparams = {"), scenario_text);
  };
  CHECK(unnamed("3") == "experiment.toml:12:15: 'params_file' must be a string, not an integer");
  CHECK(unnamed("\"\"") == "experiment.toml:12:15: 'params_file' must not be empty");
  CHECK(unnamed("\"sit.toml\"")
            .find("experiment.toml:12:15: no parameter file 'sit.toml' beside the experiment file "
                  "(shipped: ") == 0);
}

TEST_CASE("mistakes in an experiment's settings") {
  const ExperimentFolder folder;
  const std::pair<const char*, const char*> mistakes[] = {
      {"[simulation]\nstep_s = 0", "20:10: 'step_s' must be at least 0.001, not 0"},
      {"[simulation]\nstep_s = 0.03",
       "20:10: 'control_period_s' must be a multiple of 'step_s': 0.1 s is none of 0.03 s"},
      {"[simulation]\nstep_s = 0.03\ncontrol_period_s = 0.1",
       "21:20: 'control_period_s' must be a multiple of 'step_s': 0.1 s is none of 0.03 s"},
      {"[simulation]\ntime_limit = 3", "20:1: unknown key 'time_limit' in [simulation] (did you mean 'time_limit_s'?)"},
      {"[simulation]\ngrid_resolution_m = 0.01", "20:21: 'grid_resolution_m' must be at least 0.05, not 0.01"},
      {"[simulation]\ntracking = \"some\"",
       "20:12: 'tracking' must be one of none, visible, all, not 'some' (did you mean 'none'?)"},
      {"[simulation]\ntracking_range_m = 0", "20:20: 'tracking_range_m' must be positive, not 0"},
      {"[simulation]\ngoal_tolerance_m = inf", "20:20: 'goal_tolerance_m' must be finite"},
      {"[simulation]\ndispatch = \"waypoints\"",
       "20:12: 'dispatch' must be one of full_path, waypoint, not 'waypoints' (did you mean 'waypoint'?)"},
      {"[simulation]\nexecution = \"orderd\"",
       "20:13: 'execution' must be one of free, ordered, not 'orderd' (did you mean 'ordered'?)"},
      {"[simulation]\nreplan_period_s = 0.05",
       "20:19: 'replan_period_s' must be 0 (never) or at least 'control_period_s', 0.1 s"},
      {"[simulation]\nreplan_stall_s = 0.05",
       "20:18: 'replan_stall_s' must be 0 (never) or at least 'control_period_s', 0.1 s"},
      {"[simulation]\nreplan_stray_m = -1", "20:18: 'replan_stray_m' must be at least 0, not -1"},
      {"[recovery]\nretrys = 6", "20:1: unknown key 'retrys' in [recovery] (did you mean 'retries'?)"},
      {"[recovery]\nretries = -1", "20:11: 'retries' must be at least 0, not -1"},
      {"[recovery]\nsteps = [\"wait\", \"back_up\"]",
       "20:18: 'steps' must be one of clear_costmap, spin, wait, backup, replan, not 'back_up' (did you mean "
       "'backup'?)"},
      {"[recovery]\nsteps = []", "20:9: 'steps' needs one step at least (no recoveries: retries = 0)"},
      {"[navigation]\nroute = \"arround\"",
       "20:9: 'route' must be one of path, around, not 'arround' (did you mean 'around'?)"},
      {"[navigation]\nmonitr = true", "20:1: unknown key 'monitr' in [navigation] (did you mean 'monitor'?)"},
      {"[[simulation]]", "19:1: 'simulation' must be a table, not an array"},
      {"[robot]\nfootprint = { radius = 0.3 }",
       "20:15: unknown key 'radius' in 'footprint' (did you mean 'radius_m'?)"},
      {"[robot]\nfootprint = { radius_m = \"wide\" }", "20:26: 'radius_m' must be a number, not a string"},
      {"[robot]\nv_min = 0.1", "20:9: 'v_min' must be at most 0, not 0.1"},
      {"[robot]\nv_max = -1", "20:9: 'v_max' must be positive, not -1"},
      {"[robot]\nlidar = { beams = 0 }", "20:19: 'beams' must be at least 1, not 0"},
      {"[robot]\nlidar = { range_min_m = 12 }", "20:9: 'lidar' needs range_min_m < range_max_m, not 12 and 10"},
      {"[robot]\nlidar = { noise_sd_m = -1 }", "20:24: 'noise_sd_m' must be at least 0, not -1"},
      {"[robot]\nlidar = { dropout_share = 1 }", "20:27: 'dropout_share' must be at most 0.9, not 1"},
      {"[simulation]\ntracking_velocity_noise_sd = -0.1",
       "20:30: 'tracking_velocity_noise_sd' must be at least 0, not -0.1"},
      {"[record]\nannotations = 1", "20:15: 'annotations' must be true or false, not an integer"},
      {"[robot]\ncostmap = { window_m = 50, resolution_m = 0.01 }",
       "20:11: 'costmap' can have at most 2000 cells along a side: a window of 50 m at 0.01 m has 5000"},
      {"[record]\ntraces = \"some\"",
       "20:10: 'traces' must be one of all, failed, none, not 'some' (did you mean "
       "'none'?)"},
      {"[limits]\nmemory_mb = -1", "20:13: 'memory_mb' must be at least 0, not -1"},
      {"[limits]\nvisible = [\"nowhere\"]", "20:12: 'visible' names no file or folder: 'nowhere'"},
      {"[limits]\nvisible = [\"/\"]", "20:12: 'visible' must not be '/' (plugins that see everything: --no-box)"},
      {"[limits]\nvisible = [\"/tmp\"]", "20:12: 'visible' must not be '/tmp': plugins have their own"},
      {"[limits]\nplanner_time_s = 0", "20:18: 'planner_time_s' must be at least 0.001, not 0"},
  };
  for (const auto& [text, message] : mistakes) {
    INFO(text);
    CHECK(message_of(std::string(experiment_text) + text + "\n", scenario_text) ==
          std::string("experiment.toml:") + message);
  }
}

TEST_CASE("mistakes in a scenario file") {
  const ExperimentFolder folder;
  const Mistake mistakes[] = {
      {"name = \"hall\"", "name = \"mall\"", "2:8: 'name' must be that of the folder, 'hall', not 'mall'"},
      {"title = \"Hall\"\n", "", "1:1: [scenario] needs 'title'"},
      {"size_m = [10.0, 8.0]", "size_m = [10.0, 0]", "5:10: 'size_m' must be positive, not [10, 0]"},
      {"size_m = [10.0, 8.0]", "size_m = [10.0]", "5:10: 'size_m' must be [x, y], not 1 number"},
      {"size_m = [10.0, 8.0]", "size_m = [10.0, 20000]", "5:10: 'size_m' must be at most [10000, 10000]"},
      {"size_m = [10.0, 8.0]", "size_m = [9000, 9000]",
       "5:10: the world is too large: the planning grid with cells of 1 m would have 81000000 cells, at most 16777216"},
      {"size_m = [10.0, 8.0]", "size_m = [2000, 2000]",
       "5:10: the world is too large: the grid for people with cells of 0.25 m would have 64000000 cells, at most "
       "16777216"},
      {"[[box]]", "[[boks]]", "7:3: unknown key 'boks' (did you mean 'box'?)"},
      {"name = \"wall\"\n", "", "7:1: [[box]] needs 'name'"},
      {"name = \"pillar\"", "name = \"wall\"", "13:8: there are two shapes 'wall'"},
      {"radius_m = 0.3", "radius_m = 0", "15:12: 'radius_m' must be positive, not 0"},
      {"radius_m = 0.3", "radius = 0.3", "15:1: unknown key 'radius' in [[circle]] (did you mean 'radius_m'?)"},
      {"radius_m = 0.3", "size_m = [0.3, 0.3]",
       "12:1: [[circle]] needs 'radius_m'\n"
       "hall/scenario.toml:15:1: unknown key 'size_m' in [[circle]] (it is a key of [scenario], [[box]])\n"},
      {"people = 2", "speed_mean = 1.4",
       "40:1: [[flow]] needs 'people'\n"
       "hall/scenario.toml:44:1: unknown key 'speed_mean' in [[flow]] (it is a key of [people])\n"},
      {"[[1.0, 6.0], [1.5, 7.0], [2.0, 6.0]]", "[[1.0, 6.0], [1.5, 7.0]]",
       "19:14: 'vertices_m' must have at least 3 points"},
      {"[[1.0, 6.0], [1.5, 7.0], [2.0, 6.0]]", "[[1.0, 6.0], [1.5, 7.0], [2.0, 8.0]]",
       "19:14: 'vertices_m' must go round a convex polygon"},
      {"[[1.0, 6.0], [1.5, 7.0], [2.0, 6.0]]", "[[1, 6], [2, 6], [1.5, 6.2], [1.5, 7]]",
       "19:14: 'vertices_m' must go round a convex polygon"},
      {"start = [0.5, 0.5]\n", "", "21:1: [[robot]] needs 'start'"},
      {"goal = [9.5, 0.5]", "", "21:1: [[robot]] needs 'goal'"},
      {"goal = [9.5, 0.5]", "goal = [9.5]", "23:8: 'goal' must be [x, y] or [x, y, theta], not 1 number"},
      // degrees
      {"start = [0.5, 0.5]", "start = [0.5, 0.5, 90]",
       "22:20: 'start' has the angle 90, more than a turn: angles are in radians, 90 degrees are 1.5708"},
      {"[3.5, 7.5, 0.0]", "[3.5, 7.5, -180.0]",
       "28:33: 'goals' has the angle -180, more than a turn: angles are in radians, -180 degrees are -3.1416"},
      {"size_m = [0.2, 4.0]", "size_m = [0.2, 4.0]\nangle_rad = 45",
       "11:13: 'angle_rad' has the angle 45, more than a turn: angles are in radians, 45 degrees are 0.7854"},
      {"goals = ", "goal = [1, 1]\ngoals = ", "28:1: a robot has either 'goal' or 'goals'"},
      {"goals = [[9.5, 3.5], [3.5, 7.5, 0.0]]", "goals = []", "28:9: 'goals' must have at least one"},
      {"start = [0.5, 0.5]", "start = [0.5, \"north\"]", "22:15: 'start' must be a number, not a string"},
      {"name = \"east\"", "name = \"west\"", "36:8: there are two regions 'west'"},
      {"upper_m = [1.5, 3.0]", "upper_m = [0.4, 3.0]", "30:1: region 'west' needs lower_m <= upper_m"},
      {"to = \"east\"", "to = \"est\"", "43:6: no region 'est' (there: west, east) (did you mean 'west'?)"},
      {"people = 2", "people = -2", "44:10: 'people' must be at least 0, not -2"},
      {"people = 2", "people = 2\n[people]\nspeed_min = 3",
       "45:1: [people] needs speed_min <= speed_mean <= speed_max, not 3, 1.2, 2"},
      {"people = 2", "people = 2\ngroup_size = 0", "45:14: 'group_size' must be at least 1, not 0"},
      {"people = 2", "people = 2\ngroup_size = 3", "45:14: 'group_size' must be at most 'people', 2, not 3"},
      {"people = 2", "people = 2\ngroup_size = 1.5", "45:14: 'group_size' must be an integer, not a float"},
      {"people = 2", "people = 2\ngroupsize = 2",
       "45:1: unknown key 'groupsize' in [[flow]] (did you mean 'group_size'?)"},
      {"people = 2", "people = 2\n[[recording]]\nfile = \"crowd.csv\"\ngroup_size = 2",
       "47:1: unknown key 'group_size' in [[recording]] (it is a key of [[flow]])"},
      // the world itself
      {"start = [0.5, 0.5]", "start = [5.0, 4.0]",
       "21:1: robot 0 starts inside 'wall' (clearance 0.00 m, needs 0.35 m)"},
      {"start = [0.5, 0.5]", "start = [4.75, 4.5]",
       "21:1: robot 0 starts too near to 'wall' (clearance 0.15 m, needs 0.35 m)"},
      {"start = [0.5, 0.5]", "start = [0.1, 0.5]",
       "21:1: robot 0 starts too near to the border (clearance 0.10 m, needs 0.35 m)"},
      {"start = [0.5, 0.5]", "start = [-1, 0.5]", "21:1: robot 0 starts outside the world, at (-1, 0.5)"},
      {"goal = [9.5, 0.5]", "goal = [8.0, 5.9]",
       "21:1: robot 0 has its goal inside 'pillar' (clearance 0.00 m, needs 0.35 m)"},
      {"goal = [9.5, 0.5]", "goal = [1.2, 6.8]",
       "21:1: robot 0 has its goal too near to 'stall' (clearance 0.18 m, needs 0.35 m)"},
      {"goal = [9.5, 0.5]",
       "goal = [0.5, 3.6]\n[[box]]\nname = \"bar\"\ncenter_m = [0.75, 2.5]\nsize_m = [1.5, 0.1]\n"
       "[[box]]\nname = \"lid\"\ncenter_m = [0.75, 4.5]\nsize_m = [1.5, 0.1]\n"
       "[[box]]\nname = \"side\"\ncenter_m = [1.5, 3.5]\nsize_m = [0.1, 2.1]",
       "21:1: robot 0 cannot reach its goal (0.5, 3.6) from its start (0.5, 0.5) on the planning grid; "
       "neither smaller cells nor a smaller planning_margin_m would do\n"
       "hall/scenario.toml:37:1: robot 1 cannot reach its goal (9.5, 3.5) from its start (0.5, 3.5) on the planning "
       "grid; neither smaller cells nor a smaller planning_margin_m would do\n"},
      {"start = [0.5, 3.5, 1.5]", "start = [0.8, 0.5]",
       "25:1: robot 1 overlaps robot 0 at its start (distance 0.30 m, needs 0.50 m)"},
      {"start = [0.5, 3.5, 1.5]", "start = [0.7, 0.99]",
       "25:1: robot 1 has its start on the same planning cell as robot 0"},
      {"[[flow]]",
       "[[region]]\nname = \"in the wall\"\nlower_m = [5, 3]\nupper_m = [5, 5]\n[[flow]]\nvia = [\"in the wall\"]",
       "40:1: region 'in the wall' has no free place for a person"},
      {"[[flow]]",
       "[[box]]\nname = \"a\"\ncenter_m = [2.2, 2.0]\nsize_m = [0.2, 2.2]\n"
       "[[box]]\nname = \"b\"\ncenter_m = [1.2, 3.1]\nsize_m = [2.2, 0.1]\n"
       "[[box]]\nname = \"c\"\ncenter_m = [1.2, 0.95]\nsize_m = [2.2, 0.1]\n"
       "[[box]]\nname = \"d\"\ncenter_m = [0.15, 2.0]\nsize_m = [0.3, 2.2]\n[[flow]]",
       "56:1: flow 'across': nobody can walk from 'west' to 'east'"},
      {"upper_m = [1.5, 3.0]\n\n[[region]]\nname = \"east\"\nlower_m = [8.0, 1.0]\nupper_m = [9.5, 3.0]\n\n[[flow]]",
       "upper_m = [0.7, 1.6]\n[[region]]\nname = \"east\"\nlower_m = [8.0, 1.0]\nupper_m = [9.5, 3.0]\n[[flow]]\n"
       "group_size = 2",
       "38:1: flow 'across': no room in region 'west' for a group of 2"},
  };
  for (const Mistake& mistake : mistakes) {
    INFO(mistake.to);
    CHECK(message_of(experiment_text, with(scenario_text, mistake.from, mistake.to)) ==
          std::string("hall/scenario.toml:") + mistake.message);
  }
}

TEST_CASE("robots must not overlap on the centres of their cells") {
  const ExperimentFolder folder;
  const std::string fine_cells = std::string(experiment_text) + "[simulation]\ngrid_resolution_m = 0.4\n";
  CHECK(message_of(fine_cells, with(scenario_text, "start = [0.5, 3.5, 1.5]", "start = [1.01, 0.5]")) ==
        "hall/scenario.toml:25:1: robot 1 has its start on a cell that overlaps robot 0 on its own (centres 0.40 m "
        "apart, "
        "radii 0.25 and 0.25 m)");
}

TEST_CASE("ordered execution needs conflict-free plans on cells") {
  const ExperimentFolder folder;
  const auto message = [](std::uint32_t connectivity, std::uint32_t flags) -> std::string {
    write_file("experiment.toml", std::string(experiment_text) + "[simulation]\nexecution = \"ordered\"\n");
    try {
      dmrp::host::load_experiment("experiment.toml", 0,
                                  [&](const std::filesystem::path& file, const dmrp::host::VisiblePaths& visible) {
                                    dmrp::host::Probe probe = fake_probe(file, visible);
                                    probe.plugins.front().connectivity = connectivity;
                                    probe.plugins.front().flags = flags;
                                    return probe;
                                  });
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  CHECK(message(DMRP_CONNECTIVITY_4, 0).empty());
  CHECK(message(DMRP_CONNECTIVITY_8, 0).empty());
  CHECK(message(DMRP_CONNECTIVITY_4, DMRP_FLAG_UNCOORDINATED) ==
        "experiment.toml:20:13: 'execution' = 'ordered' needs plans without conflicts, which test.planner does not "
        "make");
  CHECK(message(DMRP_CONNECTIVITY_ANY, 0) ==
        "experiment.toml:20:13: 'execution' = 'ordered' needs plans from cell to cell, which test.planner does not "
        "make");
}

TEST_CASE("a plugin that needs what the host lacks is refused where it is used") {
  const ExperimentFolder folder;
  const auto message = [](std::size_t plugin, const auto& change) -> std::string {
    write_file("experiment.toml", experiment_text);
    try {
      dmrp::host::load_experiment("experiment.toml", 0,
                                  [&](const std::filesystem::path& file, const dmrp::host::VisiblePaths& visible) {
                                    dmrp::host::Probe probe = fake_probe(file, visible);
                                    change(probe.plugins.at(plugin));
                                    return probe;
                                  });
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  using dmrp::host::PluginInfo;
  CHECK(message(0, [](PluginInfo& planner) { planner.needs = {"dmrp.anotate/1"}; }) ==
        "experiment.toml:11:7: test.planner needs the extension dmrp.anotate/1, which this host does not offer to a "
        "global_planner (offered: dmrp.annotate/1, dmrp.timing/1) (did you mean 'dmrp.annotate/1'?)");
  CHECK(message(1, [](PluginInfo& controller) { controller.kinematics = 1u << DMRP_KINEMATICS_ACKERMANN; }) ==
        "experiment.toml:15:7: test.controller cannot drive robots with a differential drive");
}

TEST_CASE("keys of many parts are refused, and long names are cut in messages") {
  const ExperimentFolder folder;
  const auto many = [](const std::string& part) {
    std::string key = "a";
    for (int i = 0; i < 50'000; ++i) key += part;
    return key;
  };
  const auto message = [](const std::string& experiment) -> std::string {
    write_file("experiment.toml", experiment);
    try {
      load(experiment);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  CHECK(message("[" + many(".a") + "]\n") == "experiment.toml:1:2: a key of more than 1000 parts");
  CHECK(message("\n" + many(" . \"b\"") + " = 1\n") == "experiment.toml:2:1: a key of more than 1000 parts");
  CHECK(message("x = [1, {" + many(".'c'") + " = 1}]\n") == "experiment.toml:1:10: a key of more than 1000 parts");
  CHECK(message(many("b") + " = 1\n").size() < 2100);
}
