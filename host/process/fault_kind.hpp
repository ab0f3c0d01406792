// SPDX-License-Identifier: MIT
// fault_kind.hpp: the kinds of faults of plugins, as in results.sqlite.
#pragma once

namespace dmrp::host::fault_kind {

// Found by the parent of the process that ran the plugin.
inline constexpr const char* crash = "crash";
inline constexpr const char* hang = "hang";
inline constexpr const char* exit = "exit";
inline constexpr const char* worker_error = "worker_error";  // its process could not go on, for instance write a file

inline constexpr const char* out_of_memory = "out_of_memory";
inline constexpr const char* bad_output = "bad_output";
inline constexpr const char* abi_breach = "abi_breach";
inline constexpr const char* error_status = "error_status";

// No fault: the plugin says that the trial is not for it.
inline constexpr const char* unsupported = "unsupported";

}  // namespace dmrp::host::fault_kind
