// SPDX-License-Identifier: MIT
// experiment_example.hpp: an experiment on disk with a scenario, and plugins that exist on paper only.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>

#include "host/experiment/experiment.hpp"
#include "host/experiment/identity.hpp"

namespace dmrp::test {

inline const char* const experiment_text = R"([experiment]
name = "test"
seed = 7
trials = 3
plugins = ["./libfake.so"]

[[scenario]]
use = "./hall/scenario.toml"

[[global_planner]]
use = "test.planner"
params = { weight = 1.5 }

[[local_controller]]
use = "test.controller"

[[pedestrian_model]]
use = "test.model"
)";

inline const char* const scenario_text = R"([scenario]
name = "hall"
title = "Hall"
description = "a wall in the middle, open at both ends"
size_m = [10.0, 8.0]

[[box]]
name = "wall"
center_m = [5.0, 4.0]
size_m = [0.2, 4.0]

[[circle]]
name = "pillar"
center_m = [8.0, 6.0]
radius_m = 0.3

[[polygon]]
name = "stall"
vertices_m = [[1.0, 6.0], [1.5, 7.0], [2.0, 6.0]]

[[robot]]
start = [0.5, 0.5]
goal = [9.5, 0.5]

[[robot]]
name = "second"
start = [0.5, 3.5, 1.5]
goals = [[9.5, 3.5], [3.5, 7.5, 0.0]]

[[region]]
name = "west"
lower_m = [0.5, 1.0]
upper_m = [1.5, 3.0]

[[region]]
name = "east"
lower_m = [8.0, 1.0]
upper_m = [9.5, 3.0]

[[flow]]
name = "across"
from = "west"
to = "east"
people = 2
)";

inline host::PluginInfo plugin(const std::string& id, std::uint32_t kind, const std::string& name) {
  host::PluginInfo info;
  info.id = id;
  info.kind = kind;
  info.name = name;
  return info;
}

inline host::ParameterSpec parameter(const std::string& key, std::uint32_t type) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  host::ParameterSpec spec;
  spec.fallback.key = key;
  spec.fallback.type = type;
  spec.minimum = -infinity;
  spec.maximum = infinity;
  return spec;
}

// A planner with a parameter of each type, a controller, a model, and two metrics.
inline std::vector<host::PluginInfo> fake_plugins() {
  host::PluginInfo planner = plugin("test.planner", DMRP_KIND_GLOBAL_PLANNER, "Planner");
  planner.connectivity = DMRP_CONNECTIVITY_4;
  host::ParameterSpec weight = parameter("weight", DMRP_PARAM_DOUBLE);
  weight.fallback.number = 1.0;
  weight.minimum = 1.0;
  weight.maximum = 10.0;
  weight.unit = "m";
  host::ParameterSpec expansions = parameter("expansions", DMRP_PARAM_INT);
  expansions.fallback.integer = 1000;
  expansions.minimum = 1;
  host::ParameterSpec greedy = parameter("greedy", DMRP_PARAM_BOOL);
  host::ParameterSpec note = parameter("note", DMRP_PARAM_STRING);
  note.fallback.text = "a \"note\"\n";
  host::ParameterSpec order = parameter("order", DMRP_PARAM_CHOICE);
  order.fallback.text = "first";
  order.choices = {"first", "last"};
  host::ParameterSpec table = parameter("table", DMRP_PARAM_PATH);
  host::ParameterSpec gains = parameter("gains", DMRP_PARAM_DOUBLE_ARRAY);
  gains.fallback.numbers = {0.1, 1e-300};
  gains.minimum = 0.0;
  host::ParameterSpec names = parameter("names", DMRP_PARAM_STRING_ARRAY);
  host::ParameterSpec horizon = parameter("horizon", DMRP_PARAM_DOUBLE);
  horizon.fallback.number = std::numeric_limits<double>::infinity();
  planner.parameters = {weight, expansions, greedy, note, order, table, gains, names, horizon};

  host::PluginInfo controller = plugin("test.controller", DMRP_KIND_LOCAL_CONTROLLER, "Controller");
  controller.needs = {"dmrp.lidar/1"};
  controller.kinematics = 1u << DMRP_KINEMATICS_DIFFERENTIAL;
  host::PluginInfo blind = plugin("test.psychic", DMRP_KIND_LOCAL_CONTROLLER, "Psychic");
  blind.kinematics = controller.kinematics;
  blind.needs = {"org.example.telepathy/1"};
  host::PluginInfo model = plugin("test.model", DMRP_KIND_PEDESTRIAN_MODEL, "Model");
  host::PluginInfo metric = plugin("test.length", DMRP_KIND_METRIC, "Length");
  metric.values = {{"length", "m", "", DMRP_DIRECTION_LOWER, 1, false, false}};
  host::PluginInfo other = plugin("test.time", DMRP_KIND_METRIC, "Time");
  other.values = {{"time", "s", "", DMRP_DIRECTION_LOWER, 1, false, false}};
  return {planner, controller, blind, model, metric, other};
}

// libfake.so has the plugins above; libtwin.so one of them too; libbad.so does not load, libsick.so not start; others
// have none.
inline host::Probe fake_probe(const std::filesystem::path& file, const host::VisiblePaths&) {
  const std::string name = file.filename().string();
  if (name == "libbad.so") throw std::runtime_error("not a dmrp v1 plugin");
  if (name == "libfake.so") return {fake_plugins()};
  if (name == "libtwin.so") return {{plugin("test.model", DMRP_KIND_PEDESTRIAN_MODEL, "Model")}};
  if (name == "libsick.so") return {fake_plugins(), {}, {}, "its init() failed: no licence"};
  if (name == "librival.so") {
    host::PluginInfo metric = plugin("rival.length", DMRP_KIND_METRIC, "Length");
    metric.values = {{"length", "m", "", DMRP_DIRECTION_LOWER, 1, false, false}};
    return {{metric}, {"changes the rounding mode"}};
  }
  return {};
}

inline void write_file(const std::filesystem::path& file, const std::string& text) {
  std::filesystem::create_directories(std::filesystem::absolute(file).parent_path());
  std::ofstream(file, std::ios::binary) << text;
}

// A folder of its own, where the process stands as long as this lives.
class ExperimentFolder {
 public:
  ExperimentFolder() : before_(std::filesystem::current_path()) {
    std::string name = (std::filesystem::temp_directory_path() / "dmrp_experiment_XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
    path_ = std::filesystem::canonical(name);
    std::filesystem::current_path(path_);
    for (const char* library : {"libfake.so", "libtwin.so", "libbad.so", "libsick.so", "librival.so"})
      write_file(library, library);
    write_file("table.csv", "1,2\n");
    write_file("hall/scenario.toml", scenario_text);
    write_file("experiment.toml", experiment_text);
    unsetenv("DMRP_SCENARIO_PATH");
    unsetenv("DMRP_PLUGIN_PATH");
  }
  ~ExperimentFolder() {
    std::filesystem::current_path(before_);
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ExperimentFolder(const ExperimentFolder&) = delete;
  ExperimentFolder& operator=(const ExperimentFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path before_;
  std::filesystem::path path_;
};

inline host::Experiment load(std::uint32_t trials = 0) {
  return host::load_experiment("experiment.toml", trials, &fake_probe);
}

inline host::Experiment load(const std::string& text) {
  write_file("experiment.toml", text);
  return load();
}

inline std::string identity_digest(const host::Experiment& experiment) {
  return host::digest_of(host::identity_of(experiment));
}

// `text` with its one `from` replaced.
inline std::string with(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("the example has no '" + from + "'");
  return text.replace(at, from.size(), to);
}

}  // namespace dmrp::test
