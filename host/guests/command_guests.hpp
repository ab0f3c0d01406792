// SPDX-License-Identifier: MIT
// command_guests.hpp: the guests of a command that asks plugins outside of a run: `plan`, `draw`, `evaluate`.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "host/experiment/experiment.hpp"
#include "host/guests/guest_process.hpp"
#include "host/guests/guests.hpp"

namespace dmrp::host {

class CommandGuests {
 public:
  // Log lines of the plugins from this level on (DMRP_LOG_*) go to standard error. `libraries` outlives it. Throws
  // MachineError.
  CommandGuests(const std::vector<LibraryUse>& libraries, const RunLimits& limits, std::int32_t log_level);
  ~CommandGuests();
  CommandGuests(const CommandGuests&) = delete;
  CommandGuests& operator=(const CommandGuests&) = delete;

  // A trial begins. `spool`: of its trace, if that is too large for memory; otherwise -1.
  void begin_trial(std::uint64_t number, int spool);

  // Why a guest is ended now; "": it is not. Asked ten times a second, while a guest is.
  void watch(GuestProcess::CheckLimits check_limits) { check_limits_ = std::move(check_limits); }

  Guests& all() { return guests_; }

  // Ends the guest of a library. The most memory that it had, in MB; 0 if it has ended already.
  double end(std::uint32_t library);

 private:
  const ForkServer& fork_server_;
  GuestLimits limits_;
  int spool_ = -1;
  GuestProcess::CheckLimits check_limits_ = [] { return ""; };
  Guests guests_;
};

}  // namespace dmrp::host
