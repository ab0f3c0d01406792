// SPDX-License-Identifier: MIT
// nursery.hpp: where guests come from: a process that knows nothing, and copies itself. To start a program anew takes ten
// times as long.
#pragma once

#include <memory>

#include "host/guests/inside/guest_program.hpp"
#include "host/process/child_process.hpp"

namespace dmrp::host {

class Nursery {
 public:
  // Copies this process, which has one thread, adopts orphans (orphans.hpp) and has opened nothing that a plugin may not
  // see. Throws MachineError.
  Nursery() : Nursery(false) {}
  ~Nursery();
  Nursery(const Nursery&) = delete;
  Nursery& operator=(const Nursery&) = delete;

  // Starts a guest, a child of this process. Throws MachineError.
  std::unique_ptr<ChildProcess> start(const GuestOrder& order) const;

  pid_t number() const { return pid_; }

  // The program of a process that cannot copy itself, as it knows something (`dmrp-host nursery`). `check_case`: the guest's
  // program of that name. Returns the exit status.
  static int run(int socket, GuestProgram check_case);

 private:
  friend const Nursery& own_nursery();
  explicit Nursery(bool is_program);

  Descriptor socket_;
  pid_t pid_ = -1;
};

// That of a command, a program of its own: made when it is needed. Orphans are adopted from then on. Throws MachineError.
const Nursery& own_nursery();
void end_own_nursery();  // no child of this process is left

}  // namespace dmrp::host
