// SPDX-License-Identifier: MIT
// identity.hpp: what an experiment means, whatever the folders it is read from. Runs with the same identity can be merged,
// and continue each other.
#pragma once

#include <map>
#include <string>

#include "host/experiment/experiment.hpp"

namespace dmrp::host {

// Raised by every change of the host or its plugins that moves values: runs of two behaviours are neither merged nor
// continued. The first key of the identity.
inline constexpr int behaviour = 13;

// Each key with its value as TOML text: "simulation.step_s" -> "0.02", "local_controller[1].use" -> "\"dmrp...\"".
// Scenarios, with the files that they name, files that parameters name and files of plans stand by SHA-256, plugins by id and version, and
// the environment variables that plugins have by their values (host/process/environment.hpp). Not in it: the name of the
// experiment and the number of its trials, so that a run can grow; libraries; what plugins see beside their own.
std::map<std::string, std::string> identity_of(const Experiment& experiment);

// SHA-256, hexadecimal.
std::string digest_of(const std::map<std::string, std::string>& identity);

// Digests all keys but those of planners and controllers: runs with the same protocol gave different entries the same
// tasks under the same rules. SHA-256, hexadecimal.
std::string protocol_of(std::map<std::string, std::string> identity);

// A fingerprint that is equal in all processes of a run: the identity, and the contents of the libraries.
std::string loaded_digest(const Experiment& experiment);

}  // namespace dmrp::host
