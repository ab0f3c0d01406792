// SPDX-License-Identifier: MIT
#include "host/workers/worker_fault.hpp"

#include <fmt/format.h>
#include <signal.h>

#include <algorithm>
#include <cstring>

#include "host/errors/escaped_text.hpp"
#include "host/process/box.hpp"

namespace dmrp::host {

FaultRecord fault_at(const NotedCall& call) {
  FaultRecord fault;
  if (call.plugin.empty()) return fault;
  fault.plugin = escaped(call.plugin.c_str());
  fault.function = escaped(call.function.c_str());
  fault.step = std::max<std::int64_t>(call.step, 0);
  fault.robot = std::max(call.robot, -1);
  if (!call.inside) fault.detail = fmt::format("after {}() had returned: ", fault.function);
  return fault;
}

FaultRecord fault_of_end(WorkerProcess& worker, std::int64_t memory_mb) {
  FaultRecord fault = fault_at(worker.last_call());
  const ProcessEnding& ending = worker.process().wait();
  fault.kind = ending.fault_kind();
  fault.signal = ending.signal;
  if (ending.exceeded_group)
    fault.detail += fmt::format("more than memory_mb = {} in use; when this is noticed depends on timing", memory_mb);
  else if (ending.killed_from_outside)
    fault.detail += "killed by SIGKILL from outside";
  else if (ending.signal == SIGSYS)
    fault.detail += fmt::format("the box refuses {}", box::name_of(worker.last_call().refused));
  else if (ending.signal == SIGXCPU)
    fault.detail += fmt::format("more than {:.3g} s of processor time", ending.cpu_limit_s);
  else if (ending.signal != 0)
    fault.detail += strsignal(ending.signal);
  else if (ending.exit_status == out_of_memory_exit)
    fault.detail += fmt::format("more than memory_mb = {}", memory_mb);
  else if (ending.exit_status == channel_closed_exit)
    fault.detail += "the channel to the supervisor was closed";
  else
    fault.detail += fmt::format("the process ended with status {}", ending.exit_status);
  return fault;
}

std::string text_of(const FaultRecord& fault) {
  if (fault.plugin.empty()) return fault.kind + ": " + fault.detail;
  return fmt::format("{} in {} {}(): {}", fault.kind, fault.plugin, fault.function, fault.detail);
}

}  // namespace dmrp::host
