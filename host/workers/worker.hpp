// SPDX-License-Identifier: MIT
// worker.hpp: the worker process: loads the plugins and runs trials until its supervisor closes the channel.
#pragma once

#include <cstdint>
#include <filesystem>

namespace dmrp::host {

// `trials`: repetitions, as in load_experiment(). `read_end`, `write_end`: the channel; `note`: the shared call note.
// Returns the exit status.
int run_worker(const std::filesystem::path& experiment, std::uint32_t trials, int read_end, int write_end, int note);

}  // namespace dmrp::host
