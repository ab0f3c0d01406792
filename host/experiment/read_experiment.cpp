// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "host/errors/input_error.hpp"
#include "host/experiment/check_worlds.hpp"
#include "host/experiment/experiment.hpp"
#include "host/experiment/read_parameters.hpp"
#include "host/experiment/read_settings.hpp"
#include "host/files/read_file.hpp"
#include "host/plugins/offered_extensions.hpp"
#include "host/scenario/find_scenario.hpp"
#include "host/scenario/read_scenario.hpp"
#include "host/toml/nearest_name.hpp"
#include "host/toml/toml_document.hpp"

namespace dmrp::host {

namespace {

namespace fs = std::filesystem;

constexpr std::int64_t most_robots = 10'000;

const std::vector<std::string> header_keys = {"name", "seed", "trials", "plugins"};
const std::vector<std::string> scenario_keys = {"use", "robots", "tasks"};
const std::vector<std::string> plugin_keys = {"use", "label", "params_file", "params", "sweep"};

std::vector<TomlKeys> keys_of_tables(const TomlTable& root) {
  std::vector<TomlKeys> tables = settings_keys(root);
  tables.push_back({"[experiment]", header_keys});
  tables.push_back({"[[scenario]]", scenario_keys});
  for (const std::uint32_t kind :
       {DMRP_KIND_GLOBAL_PLANNER, DMRP_KIND_LOCAL_CONTROLLER, DMRP_KIND_PEDESTRIAN_MODEL, DMRP_KIND_METRIC})
    tables.push_back({fmt::format("[[{}]]", kind_name(kind)), plugin_keys});
  return tables;
}

class Reader {
 public:
  // `trials` > 0 replaces the file's number.
  Reader(const fs::path& file, std::uint32_t trials, const PluginSource& source)
      : trials_(trials), source_(source), document_(file.string(), read(file)) {
    experiment_.file = fs::canonical(file);
    experiment_.text = text_;
    document_.know(keys_of_tables(document_.root()));
  }

  Experiment take() {
    const TomlTable root = document_.root();
    read_header(root);
    std::vector<TomlTable::KeyReader> readers = settings_readers(root, experiment_);
    readers.emplace_back("experiment", [](const TomlValue&) {});
    readers.emplace_back("scenario", [&](const TomlValue&) { read_scenarios(root); });
    for (const auto& [kind, uses] : std::initializer_list<std::pair<std::uint32_t, std::vector<PluginUse>*>>{
             {DMRP_KIND_GLOBAL_PLANNER, &experiment_.global_planners},
             {DMRP_KIND_LOCAL_CONTROLLER, &experiment_.local_controllers},
             {DMRP_KIND_PEDESTRIAN_MODEL, &experiment_.pedestrian_models},
             {DMRP_KIND_METRIC, &experiment_.metrics}})
      readers.emplace_back(kind_name(kind),
                           [this, &root, kind = kind, uses = uses](const TomlValue&) { read_uses(root, kind, *uses); });
    root.read(readers);
    check_complete(root);
    check_order(root);
    if (experiment_.metrics.empty()) use_every_metric(root);
    for (const Entry& entry : entries_) check_world(entry.file, experiment_, entry.drawn);
    return std::move(experiment_);
  }

 private:
  std::string read(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream content;
    content << stream.rdbuf();
    std::error_code ignored;
    if (!stream || !fs::is_regular_file(file, ignored))
      throw InputError(file.string() + ": there is no such experiment file");
    text_ = content.str();
    return text_;
  }

  fs::path base() const { return experiment_.file.parent_path(); }

  void read_header(const TomlTable& root) {
    const auto header = root.find_table("experiment");
    if (!header) {
      for (const TomlValue& entry : root.entries())
        if (const std::string meant = did_you_mean(entry.key(), {"experiment"}); !meant.empty())
          entry.fail_at_key(fmt::format("unknown key '{}'{}", entry.key(), meant));
      root.fail("the file needs [experiment]");
    }
    header->allow_only(header_keys);
    experiment_.name = experiment_.file.stem().string();
    if (const auto name = header->find("name")) {
      experiment_.name = name->line();
      if (experiment_.name.find('/') != std::string::npos || experiment_.name.front() == '.')
        name->fail("'name' names the run directory: it can have no '/' and not begin with '.'");
    }
    if (const auto seed = header->find("seed")) experiment_.seed = static_cast<std::uint64_t>(seed->integer(0));
    if (const auto trials = header->find("trials"))
      experiment_.trials = static_cast<std::uint32_t>(trials->integer(1, 1'000'000));
    if (trials_ > 0) experiment_.trials = trials_;
    const TomlValue plugins = header->need("plugins");
    for (const TomlValue& library : plugins.array()) read_library(library);
    if (experiment_.libraries.empty()) plugins.fail("'plugins' must name at least one library");
  }

  void read_library(const TomlValue& value) {
    const std::string name = value.text();
    const fs::path file = find_library(name, base());
    if (file.empty()) fail_missing_library(value, name);
    for (const LibraryUse& other : experiment_.libraries)
      if (other.file == file) value.fail(fmt::format("{}: the library is named twice", name));
    Probe probe;
    try {
      probe = source_(file);
    } catch (const std::exception& error) {
      value.fail(fmt::format("{}: {}", name, error.what()));
    }
    if (!probe.init_error.empty()) value.fail(fmt::format("{}: {}", name, probe.init_error));
    if (!probe.warning.empty())
      experiment_.warnings.push_back(document_.place(value.position()) + ": " + name + ": " + probe.warning);
    experiment_.libraries.push_back({name, file, probe.plugins});
    for (std::size_t i = 0; i < probe.plugins.size(); ++i) check_new_id(value, name, i);
  }

  // Whether the plugin `index` of the last library is the first of its id.
  void check_new_id(const TomlValue& value, const std::string& name, std::size_t index) const {
    const std::string& id = experiment_.libraries.back().plugins[index].id;
    for (const LibraryUse& other : experiment_.libraries) {
      const bool is_last = &other == &experiment_.libraries.back();
      for (std::size_t i = 0; i < (is_last ? index : other.plugins.size()); ++i)
        if (other.plugins[i].id == id)
          value.fail(is_last ? fmt::format("{}: has {} twice", name, id)
                             : fmt::format("{}: has {}, which is in {} already", name, id, other.written));
    }
  }

  [[noreturn]] void fail_missing_library(const TomlValue& value, const std::string& name) const {
    if (name.empty()) value.fail("a library's name must not be empty");
    if (name.find('/') != std::string::npos)
      value.fail(fmt::format("no library '{}' (there is no file {})", name, shown((base() / name).lexically_normal())));
    if (std::error_code ignored; fs::is_regular_file(base() / name, ignored))
      value.fail(fmt::format("no library '{0}' in the plugin path (did you mean './{0}'?)", name));
    std::vector<std::string> known;
    std::string folders;
    for (const fs::path& folder : plugin_path()) {
      folders += (folders.empty() ? "" : ", ") + shown(folder.lexically_normal());
      std::error_code ignored;
      for (const auto& entry : fs::directory_iterator(folder, ignored)) known.push_back(entry.path().filename());
    }
    std::sort(known.begin(), known.end());
    value.fail(fmt::format("no library '{}' (searched: {}){}", name, folders, did_you_mean(name, known)));
  }

  void read_scenarios(const TomlTable& root) {
    for (const TomlTable& table : root.tables("scenario")) {
      table.allow_only(scenario_keys);
      const TomlValue use = table.need("use");
      const fs::path file = find_scenario(use.text(), base());
      if (file.empty()) fail_missing_scenario(use);
      Entry entry = {read_scenario_file(file, shown(file)), {}};
      const std::vector<RobotCount> counts = robot_counts(table, use, entry.file.scenario);
      std::size_t most_listed = 0;
      for (const RobotCount& count : counts) {
        if (count.drawn && count.robots > entry.drawn.most) entry.drawn = {count.robots, count.value};
        if (!count.drawn) most_listed = std::max(most_listed, count.robots);
      }
      for (const RobotCount& count : counts) add_variant(file, use, entry, count);
      keep_listed(entry.file.scenario, most_listed);
      entries_.push_back(std::move(entry));
    }
  }

  // A [[scenario]].
  struct Entry {
    ScenarioFile file;
    DrawnRobots drawn;
  };

  struct RobotCount {
    std::size_t robots;
    bool drawn;
    bool all_drawn;   // of this [[scenario]]
    TomlValue value;  // where it is asked for
  };

  // The others take no part, so nothing is asked of them; but people keep clear of their starts.
  static void keep_listed(core::Scenario& scenario, std::size_t count) {
    for (std::size_t i = count; i < scenario.robots.size(); ++i)
      scenario.other_starts.push_back({scenario.robots[i].start.x, scenario.robots[i].start.y});
    scenario.robots.resize(count);
  }

  void add_variant(const fs::path& file, const TomlValue& use, const Entry& entry, const RobotCount& count) {
    ScenarioVariant variant;
    variant.scenario = entry.file.scenario;
    auto& robots = variant.scenario.robots;
    const std::size_t listed = robots.size();
    const std::size_t kept = count.drawn ? 0 : count.robots;
    for (std::size_t i = kept; i < listed; ++i)
      variant.scenario.other_starts.push_back({robots[i].start.x, robots[i].start.y});
    robots.resize(kept);
    variant.label = variant.scenario.name;
    if (count.robots != listed || count.drawn) variant.label += fmt::format("/{}", count.robots);
    variant.file = file;
    variant.files = entry.file.files;
    variant.drawn_robots = static_cast<std::uint32_t>(count.drawn ? count.robots : 0);
    variant.most_drawn = static_cast<std::uint32_t>(entry.drawn.most);
    variant.entry = static_cast<std::uint32_t>(entries_.size());
    variant.all_drawn = count.all_drawn;
    for (const ScenarioVariant& other : experiment_.scenarios)
      if (other.scenario.name == variant.scenario.name && robot_count(other) == count.robots)
        count.value.fail(fmt::format("scenario '{}' is there twice", variant.label));
    scenario_uses_.push_back(use);
    experiment_.scenarios.push_back(std::move(variant));
  }

  [[noreturn]] static void fail_missing_scenario(const TomlValue& use) {
    const std::string name = use.text();
    if (name.find('/') != std::string::npos || name.ends_with(".toml"))
      use.fail(fmt::format("no scenario '{}' (there is no such file beside the experiment file)", name));
    const auto shipped = shipped_scenarios();
    use.fail(fmt::format("no scenario '{}' (shipped: {}; {}){}", name, join_names(shipped), folders_text(),
                         did_you_mean(name, known_scenarios())));
  }

  static std::string folders_text() {
    const char* path = std::getenv("DMRP_SCENARIO_PATH");
    return path && *path ? std::string("DMRP_SCENARIO_PATH is ") + path : "DMRP_SCENARIO_PATH is empty";
  }

  static std::vector<RobotCount> robot_counts(const TomlTable& table, const TomlValue& use,
                                              const core::Scenario& scenario) {
    const std::size_t listed = scenario.robots.size();
    const bool people = core::person_count(scenario) > 0;
    const auto value = table.find("robots");
    const auto tasks = table.find("tasks");
    const std::string from = tasks ? tasks->choice({"listed", "drawn"}) : "";
    if (from == "drawn" && !value) tasks->fail_at_key("'tasks' = 'drawn' needs 'robots', how many");
    if (!value && listed == 0 && !people)
      use.fail(fmt::format("scenario '{}' lists neither robots nor people", scenario.name));
    if (!value) return {{listed, false, false, use}};
    std::vector<RobotCount> counts;
    for (const TomlValue& count : value->is_array() ? value->array() : std::vector<TomlValue>{*value}) {
      const auto robots = static_cast<std::size_t>(count.integer(0, most_robots));
      if (robots == 0 && !people)
        count.fail(fmt::format("without robots nobody is there: scenario '{}' has no people", scenario.name));
      if (robots > listed && from == "listed")
        count.fail(fmt::format("scenario '{}' lists {} robot{}, not {} ('tasks' = 'drawn' draws them)", scenario.name,
                               listed, listed == 1 ? "" : "s", robots));
      const bool drawn = robots > 0 && (robots > listed || from == "drawn");
      counts.push_back({robots, drawn, from == "drawn", count});
    }
    if (counts.empty()) value->fail("'robots' must have at least one number");
    return counts;
  }

  void read_uses(const TomlTable& root, std::uint32_t kind, std::vector<PluginUse>& uses) {
    for (const TomlTable& table : root.tables(kind_name(kind))) {
      table.allow_only(plugin_keys);
      const TomlValue use = table.need("use");
      const auto [library, info] = find_plugin(use, kind);
      check_extensions(use, *info);
      const auto label = table.find("label");
      const std::string name = label ? label->line() : info->name;
      const fs::path file = find_parameter_file(table, base());
      for (ParameterVariant& variant : read_parameters(table, *info, base(), file)) {
        PluginUse made;
        made.library = library;
        made.info = *info;
        made.label = variant.label.empty() ? name : fmt::format("{} ({})", name, variant.label);
        made.parameters = std::move(variant.values);
        made.parameter_file = file;
        if (label_taken(uses, made.label))
          (label ? *label : use)
              .fail(
                  fmt::format("two of [[{}]] are called '{}': give one another 'label'", kind_name(kind), made.label));
        if (kind == DMRP_KIND_METRIC) check_value_names(use, made);
        uses.push_back(std::move(made));
      }
    }
  }

  static bool label_taken(const std::vector<PluginUse>& uses, const std::string& label) {
    return std::any_of(uses.begin(), uses.end(), [&](const PluginUse& use) { return use.label == label; });
  }

  // Values are told apart by name in the results.
  void check_value_names(const TomlValue& at, const PluginUse& metric) const {
    for (const PluginUse& other : experiment_.metrics)
      for (const MetricValueSpec& known : other.info.values)
        for (const MetricValueSpec& value : metric.info.values)
          if (known.name == value.name)
            at.fail(fmt::format("two metrics give a value '{}': {} and {}", value.name,
                                other.info.id == metric.info.id ? other.label : other.info.id,
                                other.info.id == metric.info.id ? metric.label : metric.info.id));
  }

  std::pair<std::uint32_t, const PluginInfo*> find_plugin(const TomlValue& use, std::uint32_t kind) const {
    const std::string id = use.text();
    std::vector<std::string> same_kind;
    for (std::uint32_t i = 0; i < experiment_.libraries.size(); ++i)
      for (const PluginInfo& info : experiment_.libraries[i].plugins) {
        if (info.id == id && info.kind != kind)
          use.fail(fmt::format("{} is a {}, not a {}", id, kind_name(info.kind), kind_name(kind)));
        if (info.id == id) return {i, &info};
        if (info.kind == kind) same_kind.push_back(info.id);
      }
    use.fail(fmt::format("no {} '{}' in the loaded libraries (there: {}){}", kind_name(kind), id, join_names(same_kind),
                         did_you_mean(id, same_kind)));
  }

  static void check_extensions(const TomlValue& use, const PluginInfo& info) {
    const std::vector<std::string> offered = offered_extensions(info.kind);
    for (const std::string& id : info.needs)
      if (std::find(offered.begin(), offered.end(), id) == offered.end())
        use.fail(fmt::format("{} needs the extension {}, which this host does not offer to a {} (offered: {})", info.id,
                             id, kind_name(info.kind), join_names(offered)));
  }

  void use_every_metric(const TomlTable& root) {
    const TomlValue plugins = root.find_table("experiment")->need("plugins");
    for (std::uint32_t i = 0; i < experiment_.libraries.size(); ++i)
      for (const PluginInfo& info : experiment_.libraries[i].plugins) {
        if (info.kind != DMRP_KIND_METRIC) continue;
        check_extensions(plugins, info);
        PluginUse use;
        use.library = i;
        use.info = info;
        use.label = label_taken(experiment_.metrics, info.name) ? info.id : info.name;
        for (const ParameterSpec& spec : info.parameters) use.parameters.push_back(spec.fallback);
        check_value_names(plugins, use);
        experiment_.metrics.push_back(std::move(use));
      }
  }

  void check_complete(const TomlTable& root) const {
    if (experiment_.scenarios.empty()) root.fail("the experiment needs a [[scenario]]");
    const bool robots = std::any_of(experiment_.scenarios.begin(), experiment_.scenarios.end(),
                                    [](const ScenarioVariant& variant) { return robot_count(variant) > 0; });
    if (robots && experiment_.global_planners.empty()) root.fail("the experiment needs a [[global_planner]]");
    if (robots && experiment_.local_controllers.empty()) root.fail("the experiment needs a [[local_controller]]");
    if (!experiment_.pedestrian_models.empty()) return;
    for (std::size_t i = 0; i < experiment_.scenarios.size(); ++i)
      if (const auto count = core::walker_count(experiment_.scenarios[i].scenario); count > 0)
        scenario_uses_[i].fail(fmt::format("scenario '{}' has {} {}: the experiment needs a [[pedestrian_model]]",
                                           experiment_.scenarios[i].scenario.name, count,
                                           count == 1 ? "person" : "people"));
  }

  // The order in which robots pass cells comes from plans that keep them apart, cell by cell.
  void check_order(const TomlTable& root) const {
    if (experiment_.simulation.execution != core::Execution::ordered) return;
    const TomlValue execution = root.find_table("simulation")->need("execution");
    for (const PluginUse& planner : experiment_.global_planners) {
      if ((planner.info.planner_flags & DMRP_PLANNER_UNCOORDINATED) != 0)
        execution.fail(fmt::format("'execution' = 'ordered' needs plans without conflicts, which {} does not make",
                                   planner.info.id));
      if (planner.info.connectivity == DMRP_CONNECTIVITY_ANY)
        execution.fail(fmt::format("'execution' = 'ordered' needs plans from cell to cell, which {} does not make",
                                   planner.info.id));
    }
  }

  std::uint32_t trials_;
  const PluginSource& source_;
  std::string text_;
  TomlDocument document_;
  Experiment experiment_;
  std::vector<Entry> entries_;
  std::vector<TomlValue> scenario_uses_;  // parallel to experiment_.scenarios
};

}  // namespace

Experiment load_experiment(const fs::path& file, std::uint32_t trials, const PluginSource& source) {
  return Reader(file, trials, source).take();
}

}  // namespace dmrp::host
