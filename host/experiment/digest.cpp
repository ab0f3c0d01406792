// SPDX-License-Identifier: MIT
#include "host/experiment/digest.hpp"

#include "host/results/sha256.hpp"

namespace dmrp::host {

std::string experiment_digest(const Experiment& experiment) {
  std::string all = effective_toml(experiment);
  for (const LibraryUse& library : experiment.libraries) all += sha256_of_file(library.file);
  for (const ScenarioVariant& variant : experiment.scenarios) all += sha256_of_file(variant.file);
  return sha256_of_bytes(all);
}

}  // namespace dmrp::host
