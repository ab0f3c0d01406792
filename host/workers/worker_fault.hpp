// SPDX-License-Identifier: MIT
// worker_fault.hpp: the fault of a plugin that ended its worker, as its supervisor sees it.
#pragma once

#include <cstdint>
#include <string>

#include "host/process/call_note.hpp"
#include "host/results/trial_record.hpp"
#include "host/workers/worker_process.hpp"

namespace dmrp::host {

// With the plugin and the function that ran. If none ran, those that ran last, and a detail that begins by saying so. The
// caller appends the reason.
FaultRecord fault_at(const NotedCall& call);

// Of a worker that has ended.
FaultRecord fault_of_end(WorkerProcess& worker, std::int64_t memory_mb);

// "crash in org.example.controller step(): Segmentation fault"
std::string text_of(const FaultRecord& fault);

}  // namespace dmrp::host
