// SPDX-License-Identifier: MIT
#include "host/experiment/read_plugin_uses.hpp"

#include <dmrp/robot_event.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string_view>
#include <utility>

#include "host/errors/mistakes.hpp"
#include "host/experiment/read_libraries.hpp"
#include "host/experiment/read_parameters.hpp"
#include "host/plugins/offered_extensions.hpp"
#include "host/toml/nearest_name.hpp"
#include "host/toml/setting.hpp"

namespace dmrp::host {

namespace {

bool label_taken(const std::vector<PluginUse>& uses, const std::string& label) {
  return std::any_of(uses.begin(), uses.end(), [&](const PluginUse& use) { return use.label == label; });
}

// The results identify values by their names.
void check_value_names(const TomlValue& at, const std::vector<PluginUse>& others, const PluginUse& metric) {
  for (const PluginUse& other : others)
    for (const MetricValueSpec& known : other.info.values)
      for (const MetricValueSpec& value : metric.info.values)
        if (known.name == value.name)
          at.fail(fmt::format("two metrics give a value '{}': {} and {}", value.name,
                              other.info.id == metric.info.id ? other.label : other.info.id,
                              other.info.id == metric.info.id ? metric.label : metric.info.id));
}

struct FoundPlugin {
  std::uint32_t library;
  const PluginInfo* info;
};

// The plugin of that id; none if it may be in a library that could not be read.
std::optional<FoundPlugin> find_plugin(const TomlValue& use, const std::string& id, std::uint32_t kind,
                                       bool all_libraries, Experiment& experiment) {
  const std::vector<LibraryUse>& libraries = experiment.libraries;
  std::vector<std::string> same_kind;
  for (std::uint32_t i = 0; i < libraries.size(); ++i)
    for (const PluginInfo& info : libraries[i].plugins) {
      if (info.id == id && info.kind != kind)
        use.fail(fmt::format("{} is a {}, not a {}", id, kind_name(info.kind), kind_name(kind)));
      if (info.id == id) return FoundPlugin{i, &info};
      if (info.kind == kind) same_kind.push_back(info.id);
    }
  if (!all_libraries) return std::nullopt;
  const std::string why =
      fmt::format("no {} '{}' in the loaded libraries{}", kind_name(kind), id, among(id, same_kind));
  if (experiment.unloadable.empty()) use.fail(why);
  leave_out(use, why, experiment);
  return std::nullopt;
}

void check_extensions(const TomlValue& use, const PluginInfo& info) {
  if (const std::string missing = missing_extension(info); !missing.empty()) use.fail(info.id + " " + missing);
}

// Only a controller has one.
std::optional<std::int64_t> read_control_latency(const TomlTable& table) {
  const auto value = table.find("control_latency_s");
  if (!value) return {};
  std::int64_t latency_ns = 0;
  latency(value->key(), latency_ns).read(*value);
  return latency_ns;
}

const std::vector<std::string> bounds = {"lower", "upper"};

// Only a controller is one.
Bound read_bound(const TomlTable& table) {
  const auto value = table.find("bound");
  if (!value) return Bound::none;
  return value->choice(bounds) == "lower" ? Bound::lower : Bound::upper;
}

// The variants of a use; sets its parameter file.
std::vector<ParameterVariant> read_variants(const TomlTable& table, const PluginInfo& info,
                                            const std::filesystem::path& base, std::filesystem::path& parameter_file) {
  std::vector<ParameterVariant> variants;
  Mistakes mistakes;
  mistakes.attempt([&] { parameter_file = find_parameter_file(table, base); });
  mistakes.attempt([&] { variants = read_parameters(table, info, base, parameter_file); });
  mistakes.end();
  return variants;
}

// Results of two shipped sets do not share a label.
std::string default_label(const PluginUse& use) {
  const std::string set = shipped_set_of(use.parameter_file);
  return set.empty() ? use.info.name : fmt::format("{} ({})", use.info.name, set);
}

// The key that says what is used.
TomlValue source_of(const TomlTable& table) {
  const auto file = table.title() == "[[global_planner]]" ? table.find("file") : std::nullopt;
  return file ? *file : table.need("use");
}

// The number in the place of {repetition}, with leading zeros or without.
std::optional<std::uint32_t> repetition_of(const std::string& name, const std::string& before,
                                           const std::string& behind) {
  if (name.size() <= before.size() + behind.size() || !name.starts_with(before) || !name.ends_with(behind)) return {};
  std::uint32_t number = 0;
  const char* const end = name.data() + name.size() - behind.size();
  const auto read = std::from_chars(name.data() + before.size(), end, number);
  return read.ec == std::errc() && read.ptr == end ? std::optional(number) : std::nullopt;
}

PlanFiles find_plan_files(const TomlValue& value, const std::filesystem::path& base) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path written = fs::absolute(base) / value.line();
  PlanFiles plans{fs::canonical(written.parent_path(), error) / written.filename()};
  if (!plans.is_one_each()) {
    if (error || !fs::is_regular_file(plans.name, error))
      value.fail(fmt::format("'{}': there is no such file beside the experiment file", value.text()));
    return plans;
  }
  const std::string name = plans.name.filename().string();
  const std::size_t at = name.find(PlanFiles::placeholder);
  const std::string behind = name.substr(at + std::string_view(PlanFiles::placeholder).size());
  for (fs::directory_iterator entry(plans.name.parent_path(), error), end; !error && entry != end;
       entry.increment(error)) {
    const auto repetition = repetition_of(entry->path().filename(), name.substr(0, at), behind);
    if (!repetition) continue;
    if (const auto [known, is_new] = plans.by_repetition.try_emplace(*repetition, entry->path()); !is_new)
      value.fail(fmt::format("'{}': two files are those of repetition {}", value.text(), *repetition));
  }
  if (plans.by_repetition.empty())
    value.fail(fmt::format("'{}': there is no such file with a number for {}", value.text(), PlanFiles::placeholder));
  return plans;
}

// "cbs" of cbs.csv, of cbs_{repetition}.csv, and of cbs/{repetition}.csv.
std::string label_of(const PlanFiles& plans) {
  std::string label = plans.name.stem().string();
  if (const std::size_t at = label.find(PlanFiles::placeholder); at != std::string::npos) {
    label.erase(at, std::string_view(PlanFiles::placeholder).size());
    while (!label.empty() && std::string_view(" ._-").find(label.back()) != std::string_view::npos) label.pop_back();
  }
  return label.empty() ? plans.name.parent_path().filename().string() : label;
}

// `any_angle`: as the table says.
PluginUse read_plan_use(const TomlTable& table, const TomlValue& file, bool any_angle,
                        const std::filesystem::path& base) {
  PluginUse made;
  Mistakes mistakes;
  for (const char* const key : {"use", "params_file", "params", "sweep"})
    if (const auto other = table.find(key))
      mistakes.attempt(
          [&] { other->fail_at_key(fmt::format("'{}' is of a plugin: beside 'file' there is none", key)); });
  mistakes.attempt([&] { made.plans = find_plan_files(file, base); });
  mistakes.end();
  made.info.id = file.text();
  made.info.kind = DMRP_KIND_GLOBAL_PLANNER;
  made.info.name = label_of(made.plans);
  made.info.connectivity = any_angle ? DMRP_CONNECTIVITY_ANY : DMRP_CONNECTIVITY_8;
  return made;
}

// Only a planner's use has it.
bool read_any_angle(const TomlTable& table) {
  const auto value = table.find("any_angle");
  if (!value) return false;
  const bool any_angle = value->boolean();
  if (!table.find("file")) value->fail_at_key("'any_angle' is of plans from a 'file': a planner says it itself");
  return any_angle;
}

// Tables and results name a use by its label, and a value by its name.
void check_names(const TomlTable& table, std::uint32_t kind, const std::vector<PluginUse>& others,
                 const PluginUse& made) {
  const TomlValue use = source_of(table);
  if (label_taken(others, made.label))
    table.find("label").value_or(use).fail(
        fmt::format("two of [[{}]] are called '{}': give one another 'label'", kind_name(kind), made.label));
  if (kind == DMRP_KIND_METRIC) check_value_names(use, others, made);
}

void check_bound(const TomlTable& table, const std::vector<PluginUse>& others, const PluginUse& made) {
  if (made.bound == Bound::none) return;
  for (const PluginUse& other : others)
    if (other.bound == made.bound)
      table.need("bound").fail(fmt::format("'{}' and '{}' cannot both be the {} bound", other.label, made.label,
                                           made.bound == Bound::lower ? "lower" : "upper"));
}

// Where an experiment names its bounds. A place between them needs both.
class NamedBounds {
 public:
  void add(const TomlTable& table, const PluginUse& made) {
    if (made.bound == Bound::none) return;
    ++count_;
    place_ = table.need("bound").place();
    is_lower_ = made.bound == Bound::lower;
  }

  void warn_of_one(Experiment& experiment) const {
    if (count_ != 1) return;  // two are never the same bound
    const char* const other = is_lower_ ? "upper" : "lower";
    experiment.warnings.push_back(
        fmt::format("{}: no controller is the {} bound, so no result says where the others stand between the two: give "
                    "another [[local_controller]] bound = \"{}\"",
                    place_, other, other));
  }

 private:
  int count_ = 0;
  std::string place_;
  bool is_lower_ = false;
};

}  // namespace

std::optional<TomlValue> naming(const TomlTable& table, const PluginUse& use) {
  const auto name = table.find(use.plans.is_given() ? "file" : "use");
  return name && name->text() == use.info.id ? name : std::nullopt;
}

std::vector<TomlKey> plugin_use_keys(std::uint32_t kind) {
  std::vector<TomlKey> keys = {{"use"}, {"label"}, {"params_file"}, {"params"}, {"sweep"}};
  if (kind == DMRP_KIND_GLOBAL_PLANNER) {
    keys.push_back({"file"});
    keys.push_back({"any_angle", boolean_text});
  }
  std::int64_t unused = 0;
  if (kind == DMRP_KIND_LOCAL_CONTROLLER) {
    keys.push_back({"control_latency_s", latency("control_latency_s", unused).range});
    keys.push_back({"bound", choices_text(bounds)});
  }
  return keys;
}

void read_plugin_uses(const TomlTable& root, std::uint32_t kind, bool all_libraries, Experiment& experiment,
                      std::vector<PluginUse>& uses) {
  NamedBounds named_bounds;
  root.read_tables(kind_name(kind), [&](const TomlTable& table) {
    Mistakes mistakes;
    PluginUse common;
    std::string name;
    bool any_angle = false;
    std::vector<ParameterVariant> variants;
    mistakes.attempt([&] { table.allow_only_keys(plugin_use_keys(kind)); });
    mistakes.attempt([&] {
      if (const auto label = table.find("label")) name = label->line();
    });
    mistakes.attempt([&] { any_angle = read_any_angle(table); });
    mistakes.attempt([&] { common.control_latency_ns = read_control_latency(table); });
    mistakes.attempt([&] { common.bound = read_bound(table); });
    mistakes.attempt([&] {
      const TomlValue use = source_of(table);
      if (use.key() == "file") {
        common = read_plan_use(table, use, any_angle, experiment.file.parent_path());
        variants.resize(1);
        return;
      }
      const auto found = find_plugin(use, use.text(), kind, all_libraries, experiment);
      if (!found) return;
      check_extensions(use, *found->info);
      common.library = found->library;
      common.info = *found->info;
      variants = read_variants(table, *found->info, experiment.file.parent_path(), common.parameter_file);
    });
    mistakes.end();
    if (name.empty()) name = default_label(common);
    for (ParameterVariant& variant : variants) {
      PluginUse made = common;
      made.label = with_swept(name, variant.swept);
      made.swept = std::move(variant.swept);
      made.parameters = std::move(variant.values);
      check_names(table, kind, uses, made);
      check_bound(table, uses, made);
      named_bounds.add(table, made);
      uses.push_back(std::move(made));
    }
  });
  named_bounds.warn_of_one(experiment);
}

void read_fallback_planners(const TomlTable& root, bool all_libraries, Experiment& experiment) {
  for (const ScenarioVariant& variant : experiment.scenarios) {
    const std::string& id = simulation_of(experiment, variant).replan.fallback;
    const auto is_it = [&](const PluginUse& use) { return use.info.id == id; };
    auto& fallbacks = experiment.fallback_planners;
    if (id.empty() || std::any_of(fallbacks.begin(), fallbacks.end(), is_it)) continue;
    const TomlTable simulation = *root.find_table("simulation");
    const auto sweep = simulation.find_table("sweep");
    const auto swept = sweep ? sweep->find("replan_fallback") : std::nullopt;
    const TomlValue place = swept ? *swept : simulation.need("replan_fallback");
    const auto found = find_plugin(place, id, DMRP_KIND_GLOBAL_PLANNER, all_libraries, experiment);
    if (!found) continue;
    check_extensions(place, *found->info);
    PluginUse use;
    use.library = found->library;
    use.info = *found->info;
    use.label = use.info.name;
    for (const ParameterSpec& spec : use.info.parameters) use.parameters.push_back(spec.fallback);
    fallbacks.push_back(std::move(use));
  }
}

// Whether robots of a scenario do something by themselves: recover, or brake where the collision monitor says so.
static bool robots_act_alone(const Experiment& experiment) {
  return std::any_of(experiment.scenarios.begin(), experiment.scenarios.end(), [&](const ScenarioVariant& variant) {
    const core::SimulationSettings& settings = simulation_of(experiment, variant);
    return settings.recovery.retries > 0 || settings.navigation.monitor;
  });
}

void use_every_metric(const TomlValue& at, Experiment& experiment) {
  for (std::uint32_t i = 0; i < experiment.libraries.size(); ++i)
    for (const PluginInfo& info : experiment.libraries[i].plugins) {
      if (info.kind != DMRP_KIND_METRIC) continue;
      if ((info.channels & DMRP_CHANNEL_RECOVERIES) && !robots_act_alone(experiment)) continue;
      check_extensions(at, info);
      PluginUse use;
      use.library = i;
      use.info = info;
      use.label = label_taken(experiment.metrics, info.name) ? info.id : info.name;
      for (const ParameterSpec& spec : info.parameters) use.parameters.push_back(spec.fallback);
      check_value_names(at, experiment.metrics, use);
      experiment.metrics.push_back(std::move(use));
    }
}

}  // namespace dmrp::host
