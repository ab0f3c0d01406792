// SPDX-License-Identifier: MIT
// one_processor.hpp: a worker and its guests, of which one runs at a time, stay on one processor: to wake a process on
// another one takes twenty times as long.
#pragma once

#include <sched.h>
#include <sys/types.h>

namespace dmrp::host {

class OneProcessor {
 public:
  // Puts this process on one of the processors that it may use. `wanted`: a processor's number; the next one that it may use
  // takes its place.
  explicit OneProcessor(unsigned wanted);

  // Puts another process there.
  void add(pid_t process) const;

 private:
  cpu_set_t own_{};
};

}  // namespace dmrp::host
