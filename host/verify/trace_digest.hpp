// SPDX-License-Identifier: MIT
// trace_digest.hpp: a fingerprint of what happened in a trial.
#pragma once

#include <filesystem>
#include <string>

namespace dmrp::host {

// SHA-256, hexadecimal, over all messages of the channel dmrp/trace in the order of the file: the log time of each, and
// its record without the times that a clock measured (core/trace/clock_times.hpp). Not in it: how
// the messages are spread over compressed chunks, and the channels for people to look at.
// Throws InputError where the trace is damaged, was cut short or has no such message, and std::system_error.
std::string trace_digest(const std::filesystem::path& trace);

}  // namespace dmrp::host
