// SPDX-License-Identifier: MIT
// fork_server.hpp: where guests come from: a process that knows nothing, and copies itself. To start a program anew takes ten
// times as long.
#pragma once

#include <memory>

#include "host/guests/inside/guest_program.hpp"
#include "host/process/child_process.hpp"

namespace dmrp::host {

class ForkServer {
 public:
  // Copies this process, which has one thread, adopts orphans (orphans.hpp) and has opened nothing that a plugin may not
  // see. Throws MachineError.
  ForkServer() : ForkServer(false) {}
  ~ForkServer();
  ForkServer(const ForkServer&) = delete;
  ForkServer& operator=(const ForkServer&) = delete;

  // Starts a guest, a child of this process. Throws MachineError.
  std::unique_ptr<ChildProcess> start(const GuestOrder& order) const;

  pid_t number() const { return pid_; }

  // The program of a process that cannot copy itself, as it knows something (`dmrp-host fork-server`). `check_case`: the guest's
  // program of that name. Returns the exit status.
  static int run(int socket, GuestProgram check_case);

 private:
  friend const ForkServer& own_fork_server();
  explicit ForkServer(bool is_program);

  Descriptor socket_;
  pid_t pid_ = -1;
};

// That of a command, a program of its own: made when it is needed. Orphans are adopted from then on. Throws MachineError.
const ForkServer& own_fork_server();
void end_own_fork_server();  // no child of this process is left

}  // namespace dmrp::host
