// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

#include "host/experiment/check_worlds.hpp"
#include "host/experiment/experiment.hpp"
#include "host/experiment/nearest_name.hpp"
#include "host/experiment/read_parameters.hpp"
#include "host/experiment/read_scenario.hpp"
#include "host/experiment/read_settings.hpp"
#include "host/experiment/toml_document.hpp"
#include "host/input_error.hpp"
#include "host/trial/robot_sensors.hpp"

namespace dmrp::host {

namespace {

namespace fs = std::filesystem;

// A path as a person standing here would write it.
std::string shown(const fs::path& path) {
  const std::string near = path.lexically_proximate(fs::current_path()).string();
  return near.starts_with("..") ? path.string() : near;
}

class Reader {
 public:
  Reader(const fs::path& file, const PluginSource& source) : source_(source), document_(file.string(), read(file)) {
    experiment_.file = fs::canonical(file);
    experiment_.text = text_;
  }

  Experiment take() {
    TomlTable root = document_.root();
    read_header(root);
    read_settings(root, experiment_);
    read_scenarios(root);
    read_uses(root, DMRP_KIND_GLOBAL_PLANNER, experiment_.global_planners);
    read_uses(root, DMRP_KIND_LOCAL_CONTROLLER, experiment_.local_controllers);
    read_uses(root, DMRP_KIND_PEDESTRIAN_MODEL, experiment_.pedestrian_models);
    read_uses(root, DMRP_KIND_METRIC, experiment_.metrics);
    root.finish();
    if (experiment_.metrics.empty()) use_every_metric();
    check_metric_names(root);
    if (experiment_.global_planners.empty()) root.fail("the experiment needs a [[global_planner]]");
    if (experiment_.local_controllers.empty()) root.fail("the experiment needs a [[local_controller]]");
    check_people();
    for (std::size_t i = 0; i < files_.size(); ++i) check_world(files_[i], experiment_);
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

  void read_header(TomlTable& root) {
    auto header = root.find_table("experiment");
    if (!header) root.fail("the file needs [experiment]");
    const auto name = header->find("name");
    experiment_.name = name ? name->text() : experiment_.file.stem().string();
    if (experiment_.name.empty() || experiment_.name.find('/') != std::string::npos)
      name->fail("'name' names the run directory: it must not be empty or have a '/'");
    if (const auto seed = header->find("seed")) experiment_.seed = static_cast<std::uint64_t>(seed->integer(0));
    if (const auto trials = header->find("trials"))
      experiment_.trials = static_cast<std::uint32_t>(trials->integer(1, 1'000'000));
    const TomlValue plugins = header->need("plugins");
    for (const TomlValue& library : plugins.array()) read_library(library);
    if (experiment_.libraries.empty()) plugins.fail("'plugins' must name at least one library");
    header->finish();
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
    } catch (const std::runtime_error& error) {
      value.fail(fmt::format("{}: {}", name, error.what()));
    }
    if (!probe.warning.empty())
      experiment_.warnings.push_back(document_.place(value.position()) + ": " + name + ": " + probe.warning);
    for (const PluginInfo& plugin : probe.plugins)
      for (const LibraryUse& other : experiment_.libraries)
        for (const PluginInfo& known : other.plugins)
          if (known.id == plugin.id) value.fail(fmt::format("{}: {} is in {} too", name, plugin.id, other.written));
    experiment_.libraries.push_back({name, file, probe.plugins});
  }

  [[noreturn]] static void fail_missing_library(const TomlValue& value, const std::string& name) {
    if (name.find('/') != std::string::npos)
      value.fail(fmt::format("no library '{}' (relative to the experiment file)", name));
    std::vector<std::string> known;
    std::string folders;
    for (const fs::path& folder : plugin_path()) {
      folders += (folders.empty() ? "" : ", ") + shown(folder.lexically_normal());
      std::error_code ignored;
      for (const auto& entry : fs::directory_iterator(folder, ignored)) known.push_back(entry.path().filename());
    }
    std::sort(known.begin(), known.end());
    value.fail(fmt::format("no library '{}' in {}{}", name, folders, did_you_mean(name, known)));
  }

  void read_scenarios(TomlTable& root) {
    for (TomlTable& table : root.tables("scenario")) {
      const TomlValue use = table.need("use");
      const fs::path file = find_scenario(use.text(), base());
      if (file.empty()) fail_missing_scenario(use);
      ScenarioFile scenario = read_scenario_file(file, shown(file));
      const std::vector<std::uint32_t> counts = robot_counts(table, scenario.scenario);
      table.finish();
      for (const std::uint32_t count : counts) {
        ScenarioVariant variant;
        variant.scenario = scenario.scenario;
        variant.scenario.robots.resize(count);
        variant.label = variant.scenario.name;
        if (count != scenario.scenario.robots.size()) variant.label += fmt::format("/{}", count);
        variant.file = file;
        for (const ScenarioVariant& other : experiment_.scenarios)
          if (other.label == variant.label) use.fail(fmt::format("scenario '{}' is there twice", variant.label));
        experiment_.scenarios.push_back(std::move(variant));
      }
      files_.push_back(std::move(scenario));
    }
    if (experiment_.scenarios.empty()) root.fail("the experiment needs a [[scenario]]");
  }

  [[noreturn]] static void fail_missing_scenario(const TomlValue& use) {
    const auto shipped = shipped_scenarios();
    const auto more = folders_text();
    use.fail(fmt::format("no scenario '{}' (shipped: {}; {}){}", use.text(), join_names(shipped), more,
                         did_you_mean(use.text(), shipped)));
  }

  static std::string folders_text() {
    const char* path = std::getenv("DMRP_SCENARIO_PATH");
    return path && *path ? std::string("DMRP_SCENARIO_PATH is ") + path : "DMRP_SCENARIO_PATH is empty";
  }

  static std::vector<std::uint32_t> robot_counts(TomlTable& table, const core::Scenario& scenario) {
    const auto listed = static_cast<std::int64_t>(scenario.robots.size());
    const auto value = table.find("robots");
    if (!value) {
      if (listed == 0) table.fail(fmt::format("scenario '{}' lists no robots", scenario.name));
      return {static_cast<std::uint32_t>(listed)};
    }
    std::vector<std::uint32_t> counts;
    for (const TomlValue& count : value->is_array() ? value->array() : std::vector<TomlValue>{*value}) {
      const std::int64_t n = count.integer(1);
      if (n > listed)
        count.fail(fmt::format("scenario '{}' lists {} robots; drawing more is not built yet", scenario.name, listed));
      counts.push_back(static_cast<std::uint32_t>(n));
    }
    if (counts.empty()) value->fail("'robots' must have at least one number");
    return counts;
  }

  void read_uses(TomlTable& root, std::uint32_t kind, std::vector<PluginUse>& uses) {
    for (TomlTable& table : root.tables(kind_name(kind))) {
      const TomlValue use = table.need("use");
      const auto [library, info] = find_plugin(use, kind);
      check_extensions(use, *info);
      const auto label = table.find("label");
      const std::string name = label ? label->text() : info->name;
      for (ParameterVariant& variant : read_parameters(table, *info, base())) {
        PluginUse made;
        made.library = library;
        made.info = *info;
        made.label = variant.label.empty() ? name : fmt::format("{} ({})", name, variant.label);
        made.parameters = std::move(variant.values);
        for (const PluginUse& other : uses)
          if (other.label == made.label)
            (label ? *label : use)
                .fail(fmt::format("two of [[{}]] are called '{}': give one a 'label'", kind_name(kind), made.label));
        uses.push_back(std::move(made));
      }
      table.finish();
    }
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
    static const std::vector<std::string> nothing;
    const auto& offered = info.kind == DMRP_KIND_LOCAL_CONTROLLER ? offered_extensions() : nothing;
    for (const std::string& id : info.needs)
      if (std::find(offered.begin(), offered.end(), id) == offered.end())
        use.fail(fmt::format("{} needs the extension {}, which this host does not offer to a {} (offered: {})", info.id,
                             id, kind_name(info.kind), join_names(offered)));
  }

  void use_every_metric() {
    for (std::uint32_t i = 0; i < experiment_.libraries.size(); ++i)
      for (const PluginInfo& info : experiment_.libraries[i].plugins) {
        if (info.kind != DMRP_KIND_METRIC) continue;
        PluginUse use;
        use.library = i;
        use.info = info;
        use.label = info.name;
        for (const ParameterSpec& spec : info.parameters) use.parameters.push_back(spec.fallback);
        experiment_.metrics.push_back(std::move(use));
      }
  }

  // Values are told apart by name in the results.
  void check_metric_names(const TomlTable& root) const {
    std::set<std::string> names;
    for (const PluginUse& use : experiment_.metrics)
      for (const MetricValueSpec& value : use.info.values)
        if (!names.insert(value.name).second)
          root.fail(fmt::format("two metrics give a value '{}' (one is {})", value.name, use.info.id));
  }

  void check_people() {
    if (!experiment_.pedestrian_models.empty()) return;
    for (const ScenarioVariant& variant : experiment_.scenarios)
      if (const auto count = core::person_count(variant.scenario); count > 0)
        document_.root().fail(fmt::format("scenario '{}' has {} people: the experiment needs a [[pedestrian_model]]",
                                          variant.scenario.name, count));
  }

  const PluginSource& source_;
  std::string text_;
  TomlDocument document_;
  Experiment experiment_;
  std::vector<ScenarioFile> files_;
};

}  // namespace

Experiment load_experiment(const fs::path& file, std::uint32_t trials, const PluginSource& source) {
  Experiment experiment = Reader(file, source).take();
  if (trials > 0) experiment.trials = trials;
  return experiment;
}

}  // namespace dmrp::host
