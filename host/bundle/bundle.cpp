// SPDX-License-Identifier: MIT
#include "host/bundle/bundle.hpp"

#include <fmt/format.h>

#include "host/errors/input_error.hpp"
#include "host/experiment/identity.hpp"
#include "host/files/atomic_file.hpp"
#include "host/guests/probe.hpp"
#include "host/process/box.hpp"

namespace dmrp::host {

namespace {

namespace fs = std::filesystem;

void copy_files(const BundleLayout& layout, const fs::path& folder) {
  for (const auto& [place, file] : layout.copies()) {
    fs::create_directories((folder / place).parent_path());
    fs::copy_file(file, folder / place);
  }
}

std::string readme(const Manifest& manifest) {
  return fmt::format(
      R"(# {0}: a bundle of dmrp-host

dmrp-host {1}, commit {2}, wrote this folder. It has all files that the experiment reads; libraries of plugins that are
not in plugins/ come with dmrp-host.

    dmrp-host experiment.toml       runs it
    dmrp-host verify .              runs some of its trials again, and compares values and traces to the bit

| file | content |
| --- | --- |
| experiment.toml, effective.toml | the experiment with all values written out |
| original.toml | the experiment as it was written, with its comments |
| scenarios, parameters, plan_files, plugins | the files that it names, as they were |
| manifest.json | program, machine, the SHA-256 of all files, and what the experiment means, key by key |
| results.sqlite, trace_digests.txt | where it was run: its results, and fingerprints of its traces |
| plans | where it was run: the plans that its trials were given |
)",
      manifest.experiment.name, manifest.dmrp_version, manifest.commit);
}

bool is_inside(const fs::path& file, const fs::path& folder) {
  const fs::path relative = file.lexically_relative(folder);
  return !relative.empty() && *relative.begin() != "..";
}

void check_bundle(const Experiment& original, const fs::path& folder) {
  const Experiment read = load_experiment(folder / "experiment.toml", 0, &probe_library);
  const fs::path root = fs::canonical(folder);
  for (const ScenarioVariant& variant : read.scenarios)
    for (const fs::path& file : variant.files)
      if (!is_inside(file, root))
        throw InputError(
            fmt::format("scenario '{}' names {} by an absolute path: name it relative to the file that "
                        "names it, so that a bundle can hold it",
                        variant.scenario.name, file.string()));
  if (const auto keys = differences(identity_of(original), identity_of(read)); !keys.empty())
    throw InputError(fmt::format("the bundle is another experiment: {} was {}, is {} in it", keys[0].key,
                                 keys[0].before, keys[0].now));
}

}  // namespace

void write_bundle(const Experiment& experiment, const std::string& original, Manifest manifest,
                  const BundleLayout& layout, const fs::path& folder) {
  copy_files(layout, folder);
  const std::string text = effective_toml(experiment, [&](const fs::path& file) { return layout.name_of(file); });
  write_file_atomically(folder / "experiment.toml", text);
  write_file_atomically(folder / "effective.toml", text);
  write_file_atomically(folder / "original.toml", original);
  write_file_atomically(folder / "README.md", readme(manifest));
  for (HashedFile& file : manifest.files) file.path = layout.name_of(file.path);
  write_file_atomically(folder / "manifest.json", to_json_text(manifest));
  check_bundle(experiment, folder);
}

void check_strangers(const fs::path& folder) {
  std::error_code ignored;
  if (box::kind() != "calls" || !fs::exists(folder / "original.toml", ignored) ||
      !fs::exists(folder / "plugins", ignored))
    return;
  throw InputError(
      fmt::format("{}: its plugins would see your files, as this kernel gives them no namespaces ({}): --trust "
                  "runs them",
                  folder.string(), view::gap()));
}

}  // namespace dmrp::host
