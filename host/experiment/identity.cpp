// SPDX-License-Identifier: MIT
#include "host/experiment/identity.hpp"

#include <fmt/format.h>

#include <sstream>

#include "host/files/sha256.hpp"
#include "host/process/environment.hpp"
#include "host/toml/toml_text.hpp"

namespace dmrp::host {

namespace {

namespace fs = std::filesystem;

// "mall 52a1..., map.yaml 81d0..., map.png 7c3e..."
std::string content_of(const ScenarioVariant& variant) {
  std::string out = variant.scenario.name + " " + sha256_of_file(variant.file);
  for (const fs::path& file : variant.files)
    out += fmt::format(", {} {}", file.filename().string(), sha256_of_file(file));
  return out;
}

// One digest for all plans of a name with {repetition}: trials can grow as far as files were there from the start.
std::string content_of(const PlanFiles& plans) {
  if (!plans.is_one_each()) return sha256_of_file(plans.name);
  std::string all;
  for (const auto& [repetition, file] : plans.by_repetition)
    all += fmt::format("{} {}\n", repetition, sha256_of_file(file));
  return sha256_of_bytes(all);
}

// The files of an experiment, by content.
class ContentNames {
 public:
  explicit ContentNames(const Experiment& experiment) {
    for (const LibraryUse& library : experiment.libraries) names_[library.file] = "";
    for (const ScenarioVariant& variant : experiment.scenarios)
      if (std::string& name = names_[variant.file]; name.empty()) name = content_of(variant);
    for (const PluginUse& planner : experiment.global_planners)
      if (planner.plans.is_given()) names_[planner.plans.name] = content_of(planner.plans);
  }

  std::string operator()(const fs::path& file) {
    const auto known = names_.find(file);
    return known != names_.end() ? known->second : sha256_of_file(file);
  }

 private:
  std::map<fs::path, std::string> names_;
};

std::string trimmed(const std::string& text) {
  return text.substr(0, text.find_last_not_of(' ') + 1);
}

// The keys of effective_toml(), in full.
class KeyReader {
 public:
  void read(const std::string& line) {
    if (line.starts_with("[["))
      begin_element(line.substr(2, line.size() - 4));
    else if (line.starts_with("["))
      begin_table(line.substr(1, line.size() - 2));
    else if (const auto equals = line.find(" = "); equals != std::string::npos && !line.starts_with("#"))
      keys_[table_ + "." + trimmed(line.substr(0, equals))] = line.substr(equals + 3);
  }

  std::map<std::string, std::string> take() { return std::move(keys_); }

 private:
  void begin_element(const std::string& name) {
    element_ = name;
    table_ = element_path_ = fmt::format("{}[{}]", name, counts_[name]++);
  }

  void begin_table(const std::string& name) {
    const bool is_of_element = !element_.empty() && name.starts_with(element_ + ".");
    table_ = is_of_element ? element_path_ + name.substr(element_.size()) : name;
  }

  std::map<std::string, std::string> keys_;
  std::map<std::string, std::size_t> counts_;  // of [[name]] so far
  std::string element_;                        // the last [[name]]
  std::string element_path_;                   // "name[1]"
  std::string table_;
};

}  // namespace

std::map<std::string, std::string> identity_of(const Experiment& experiment) {
  std::istringstream lines(effective_toml(experiment, ContentNames(experiment)));
  KeyReader reader;
  for (std::string line; std::getline(lines, line);) reader.read(line);
  std::map<std::string, std::string> identity = reader.take();
  identity["behaviour"] = std::to_string(behaviour);
  for (const char* key :
       {"experiment.name", "experiment.trials", "experiment.plugins", "limits.visible", "benchmark.smallest_effect"})
    identity.erase(key);
  if (const std::vector<std::string> variables = passed_environment(); !variables.empty())
    identity["environment"] = toml_text(variables);
  for (const LibraryUse& library : experiment.libraries)
    if (!library.runtime.empty()) identity["python " + library.file.filename().string()] = toml_text(library.runtime);
  for (const auto* uses :
       {&experiment.global_planners, &experiment.local_controllers, &experiment.pedestrian_models, &experiment.metrics})
    for (std::size_t i = 0; i < uses->size(); ++i) {
      const PluginInfo& info = (*uses)[i].info;
      if ((*uses)[i].plans.is_given()) continue;
      identity[fmt::format("{}[{}].version", kind_name(info.kind), i)] = toml_text(info.version);
    }
  for (const PluginUse& use : experiment.fallback_planners)
    identity[fmt::format("fallback {}.version", use.info.id)] = toml_text(use.info.version);
  return identity;
}

std::string digest_of(const std::map<std::string, std::string>& identity) {
  std::string all;
  for (const auto& [key, value] : identity) all += key + " = " + value + "\n";
  return sha256_of_bytes(all);
}

std::string protocol_of(std::map<std::string, std::string> identity) {
  std::erase_if(identity, [](const auto& entry) {
    for (const char* of_entry : {"global_planner[", "local_controller[", "fallback ", "python ", "environment"})
      if (entry.first.starts_with(of_entry)) return true;
    return false;
  });
  return digest_of(identity);
}

std::string loaded_digest(const Experiment& experiment) {
  std::string all = digest_of(identity_of(experiment));
  for (const LibraryUse& library : experiment.libraries) {
    all += sha256_of_file(library.file);
    for (const std::string& object : library.objects) all += sha256_of_file(object);
  }
  return sha256_of_bytes(all);
}

}  // namespace dmrp::host
