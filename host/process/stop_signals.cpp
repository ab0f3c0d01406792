// SPDX-License-Identifier: MIT
#include "host/process/stop_signals.hpp"

#include <sys/signalfd.h>
#include <unistd.h>

namespace dmrp::host {

StopSignals::StopSignals() {
  signal(SIGPIPE, SIG_IGN);
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGTERM);
  struct sigaction hangup {};
  sigaction(SIGHUP, nullptr, &hangup);
  if (hangup.sa_handler != SIG_IGN) sigaddset(&set, SIGHUP);
  sigprocmask(SIG_BLOCK, &set, &before_);
  descriptor_ = Descriptor(signalfd(-1, &set, SFD_CLOEXEC | SFD_NONBLOCK));
}

StopSignals::~StopSignals() {
  // signals that have been handled must not end the process once they are unblocked
  for (signalfd_siginfo handled; read(descriptor_.number(), &handled, sizeof(handled)) > 0;) {
  }
  sigprocmask(SIG_SETMASK, &before_, nullptr);
}

}  // namespace dmrp::host
