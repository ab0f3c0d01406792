// SPDX-License-Identifier: MIT
// bundle.hpp: a folder with what an experiment reads, which runs where it is copied to. Beside results, it is a run
// directory too.
#pragma once

#include <filesystem>
#include <string>

#include "host/bundle/bundle_layout.hpp"
#include "host/experiment/experiment.hpp"
#include "host/results/manifest.hpp"

namespace dmrp::host {

// Copies the files and writes experiment.toml, effective.toml (the same), original.toml, manifest.json and README.md to
// `folder`, which is empty. `original`: the text of the experiment as its author wrote it. Then reads it again: throws
// InputError if that is not the same experiment from the folder's files alone, and MachineError.
void write_bundle(const Experiment& experiment, const std::string& original, Manifest manifest,
                  const BundleLayout& layout, const std::filesystem::path& folder);

// Throws InputError if `folder` is a bundle that has plugins, and the kernel gives these no view of their own: they are
// somebody else's, and would see the user's files.
void check_strangers(const std::filesystem::path& folder);

}  // namespace dmrp::host
