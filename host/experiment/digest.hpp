// SPDX-License-Identifier: MIT
// digest.hpp: a fingerprint of an experiment, equal in all processes and runs of the same experiment.
#pragma once

#include <string>

#include "host/experiment/experiment.hpp"

namespace dmrp::host {

// SHA-256, hexadecimal, over the effective experiment and the contents of its libraries, scenario and parameter files.
std::string experiment_digest(const Experiment& experiment);

}  // namespace dmrp::host
