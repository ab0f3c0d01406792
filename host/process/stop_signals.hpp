// SPDX-License-Identifier: MIT
// stop_signals.hpp: SIGINT, SIGTERM and SIGHUP (unless nohup ignores it) as a descriptor to poll.
#pragma once

#include <signal.h>

#include "host/process/descriptor.hpp"

namespace dmrp::host {

// Blocks the signals while it lives. Also ignores SIGPIPE, for good: a child that ended is noticed by its closed pipe.
class StopSignals {
 public:
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  // Readable once a signal has come.
  int descriptor() const { return descriptor_.number(); }

 private:
  sigset_t before_{};
  Descriptor descriptor_;
};

}  // namespace dmrp::host
