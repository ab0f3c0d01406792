// SPDX-License-Identifier: MIT
#include "host/evaluate/evaluation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <system_error>

#include "host/errors/input_error.hpp"
#include "host/experiment/adhoc_use.hpp"
#include "host/experiment/read_parameters.hpp"
#include "host/experiment/settings_tables.hpp"
#include "host/files/read_file.hpp"
#include "host/guests/probe.hpp"
#include "host/plugins/elf_file.hpp"
#include "host/plugins/offered_extensions.hpp"
#include "host/program/version.hpp"
#include "host/results/manifest.hpp"
#include "host/toml/nearest_name.hpp"
#include "host/toml/toml_document.hpp"

namespace dmrp::host {

namespace {

namespace fs = std::filesystem;

struct Candidate {
  LibraryUse library;
  Probe probe;
  bool of_run = false;
};

struct Found {
  const Candidate* candidate;
  const PluginInfo* info;
};

class EvaluationPlanner {
 public:
  explicit EvaluationPlanner(const EvaluationChoice& choice)
      : choice_(choice),
        effective_file_(choice.run_directory / "effective.toml"),
        effective_(shown(effective_file_), read_effective()),
        root_(effective_.root()) {}

  Evaluation take() {
    Experiment settings;
    read_run_settings(root_, settings);
    evaluation_.limits = settings.limits;
    evaluation_.traces = settings.traces;

    find_libraries();
    if (!choice_.metric.empty()) {
      use(find_metric(choice_.metric));
    } else {
      for (const TomlTable& metric : root_.tables(kind_name(DMRP_KIND_METRIC)))
        use(find_metric(metric.need("use").text()));
      use_others();
    }
    warn_of_changes();
    return std::move(evaluation_);
  }

 private:
  std::string read_effective() const {
    if (std::error_code ignored; !fs::is_regular_file(effective_file_, ignored))
      throw InputError(
          fmt::format("{}: is no run directory (there is no effective.toml)", choice_.run_directory.string()));
    return read_file(effective_file_, shown(effective_file_));
  }

  void find_libraries() {
    for (const std::string& name : choice_.plugins) {
      const fs::path file = find_library(name, fs::current_path());
      if (file.empty()) throw InputError(fmt::format("--plugin {}: there is no such library", name));
      try {
        add(name, file, false);
      } catch (const std::runtime_error& error) {
        throw InputError(fmt::format("--plugin {}: {}", name, error.what()));
      }
    }
    for (const TomlValue& value : root_.find_table("experiment")->need("plugins").array()) add_of_run(value.text());
  }

  // A run may come from a machine where its libraries are in other folders.
  void add_of_run(const std::string& path) {
    const fs::path known = choice_.run_directory / path;  // within it, if it is a bundle
    const fs::path file = fs::exists(known) ? known : find_library(fs::path(path).filename(), {});
    if (file.empty()) return missing_.push_back(fmt::format("the run's library {} is gone", path));
    try {
      add(path, file, true);
    } catch (const std::runtime_error& error) {
      missing_.push_back(fmt::format("the run's library {}: {}", file.string(), error.what()));
    }
  }

  void add(const std::string& written, const fs::path& file, bool of_run) {
    for (const Candidate& other : candidates_)
      if (other.library.file == file) return;
    Candidate candidate;
    candidate.probe = probe_library(file);
    candidate.library = {written, file, candidate.probe.plugins};
    candidate.of_run = of_run;
    candidates_.push_back(std::move(candidate));
  }

  // " (the run's library ... is gone)"; "" if all libraries of the run were searched.
  std::string missing_note() const { return missing_.empty() ? "" : fmt::format(" ({})", fmt::join(missing_, "; ")); }

  Found find_metric(const std::string& id) const {
    std::vector<std::string> known;
    for (const Candidate& candidate : candidates_)
      for (const PluginInfo& info : candidate.probe.plugins) {
        if (info.id == id && info.kind != DMRP_KIND_METRIC)
          throw InputError(fmt::format("--metric {}: is a {}, not a metric", id, kind_name(info.kind)));
        if (info.id == id) return {&candidate, &info};
        if (info.kind == DMRP_KIND_METRIC) known.push_back(info.id);
      }
    if (choice_.metric.empty())
      throw InputError(fmt::format("{}: the run's metric {} is in none of its libraries{}",
                                   choice_.run_directory.string(), id, missing_note()));
    throw InputError(fmt::format("--metric {}: no such metric{}{}", id, among(id, known), missing_note()));
  }

  void use_others() {
    for (const Candidate& candidate : candidates_)
      for (const PluginInfo& info : candidate.probe.plugins)
        if (!candidate.of_run && info.kind == DMRP_KIND_METRIC && !is_used(info.id)) use({&candidate, &info});
  }

  bool is_used(const std::string& id) const {
    return std::any_of(evaluation_.metrics.begin(), evaluation_.metrics.end(),
                       [&](const PluginUse& use) { return use.info.id == id; });
  }

  void use(const Found& found) {
    const PluginInfo& info = *found.info;
    if (const std::string missing = missing_extension(info); !missing.empty())
      throw InputError(info.id + " " + missing);
    PluginUse made;
    made.library = library(*found.candidate);
    made.info = info;
    made.label = info.name;
    made.parameters = parameters(info);
    evaluation_.metrics.push_back(std::move(made));
  }

  std::uint32_t library(const Candidate& candidate) {
    auto& libraries = evaluation_.libraries;
    for (std::uint32_t i = 0; i < libraries.size(); ++i)
      if (libraries[i].file == candidate.library.file) return i;
    const std::string file = candidate.library.file.string();
    if (!candidate.probe.init_error.empty()) throw InputError(file + ": " + candidate.probe.init_error);
    for (const std::string& warning : candidate.probe.warnings) evaluation_.warnings.push_back(file + ": " + warning);
    libraries.push_back(candidate.library);
    if (candidate.of_run) libraries_of_run_.push_back(candidate.library);
    return static_cast<std::uint32_t>(libraries.size() - 1);
  }

  std::vector<ParameterValue> parameters(const PluginInfo& info) const {
    std::vector<ParameterValue> values;
    for (const ParameterSpec& spec : info.parameters) values.push_back(spec.fallback);
    for (const TomlTable& metric : root_.tables(kind_name(DMRP_KIND_METRIC)))
      if (metric.need("use").text() == info.id)
        values = read_parameters(metric, info, choice_.run_directory, {}).front().values;
    if (choice_.metric.empty()) return values;
    return adhoc_parameters(choice_.settings, choice_.parameter_file, info, std::move(values));
  }

  // Warns of changes since the run: values may differ.
  void warn_of_changes() {
    const Manifest before = read_manifest(choice_.run_directory / "manifest.json");
    Manifest now = new_manifest(version, {}, std::chrono::system_clock::now());
    now.files = before.files;
    for (const std::string& difference : differences(before, now))
      evaluation_.warnings.push_back("changed since the run: " + difference);
    for (const LibraryUse& library : libraries_of_run_) {
      // by name: the library of an installation stands elsewhere
      const bool same = std::any_of(before.files.begin(), before.files.end(), [&](const HashedFile& file) {
        return file.role == "plugin library" &&
               std::filesystem::path(file.path).filename() == library.file.filename() &&
               file.code == code_digest(library.file);
      });
      if (!same)
        evaluation_.warnings.push_back(
            fmt::format("{} has changed since the run: values may differ from the run's", library.file.string()));
    }
  }

  const EvaluationChoice& choice_;
  fs::path effective_file_;
  TomlDocument effective_;
  TomlTable root_;
  std::vector<Candidate> candidates_;  // libraries to search, in this order
  std::vector<std::string> missing_;   // libraries of the run that cannot be searched, with the reason
  std::vector<LibraryUse> libraries_of_run_;
  Evaluation evaluation_;
};

}  // namespace

Evaluation plan_evaluation(const EvaluationChoice& choice) {
  if (choice.metric.empty() && !(choice.settings.empty() && choice.parameter_file.empty()))
    throw InputError("evaluate: --set and --params-file are for one metric: name it by --metric");
  return EvaluationPlanner(choice).take();
}

}  // namespace dmrp::host
