// SPDX-License-Identifier: MIT
#include "host/guests/command_guests.hpp"

#include "host/process/orphans.hpp"

namespace dmrp::host {

namespace {

GuestLimits limits_of(const RunLimits& limits, std::int32_t log_level) {
  GuestLimits out;
  out.memory_mb = limits.memory_mb;
  out.trial_wall_time_s = limits.trial_wall_time_s;
  out.plain_log_level = log_level;
  return out;
}

}  // namespace

CommandGuests::CommandGuests(const std::vector<LibraryUse>& libraries, const RunLimits& limits, std::int32_t log_level)
    : fork_server_(own_fork_server()),
      limits_(limits_of(limits, log_level)),
      guests_(libraries, [this](const LibraryUse& library, std::uint32_t) {
        return std::make_unique<GuestProcess>(
            fork_server_, library, limits_, GuestTask::load, spool_, [](pid_t) {}, [this] { return check_limits_(); });
      }) {}

CommandGuests::~CommandGuests() {
  guests_.end_all();
  kill_orphans({fork_server_.number()});
}

void CommandGuests::begin_trial(std::uint64_t number, int spool) {
  if (spool >= 0 || spool_ >= 0) guests_.end_all();  // a guest has its spool from its start
  spool_ = spool;
  guests_.begin_trial({number, 0});
}

double CommandGuests::end(std::uint32_t library) {
  double peak_mb = 0.0;
  guests_.visit(library, [&](Guest& guest) { peak_mb = static_cast<GuestProcess&>(guest).end_process(); });
  guests_.end(library);
  return peak_mb;
}

}  // namespace dmrp::host
