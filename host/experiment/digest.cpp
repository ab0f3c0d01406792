// SPDX-License-Identifier: MIT
#include "host/experiment/digest.hpp"

#include "host/files/sha256.hpp"

namespace dmrp::host {

std::string experiment_digest(const Experiment& experiment) {
  std::string all = effective_toml(experiment);
  for (const LibraryUse& library : experiment.libraries) all += sha256_of_file(library.file);
  for (const ScenarioVariant& variant : experiment.scenarios) {
    all += sha256_of_file(variant.file);
    for (const std::filesystem::path& file : variant.files) all += sha256_of_file(file);
  }
  for (const auto* uses :
       {&experiment.global_planners, &experiment.local_controllers, &experiment.pedestrian_models, &experiment.metrics})
    for (const PluginUse& use : *uses) {
      if (!use.parameter_file.empty()) all += sha256_of_file(use.parameter_file);
      for (const ParameterValue& value : use.parameters)
        if (value.type == DMRP_PARAM_PATH && !value.text.empty()) all += sha256_of_file(value.text);
    }
  return sha256_of_bytes(all);
}

}  // namespace dmrp::host
