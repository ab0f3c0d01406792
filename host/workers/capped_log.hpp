// SPDX-License-Identifier: MIT
// capped_log.hpp: what a worker prints goes through a pipe into log.txt, up to a limit: a plugin cannot fill the disk.
#pragma once

#include <cstddef>
#include <string>

#include "host/process/descriptor.hpp"

namespace dmrp::host {

class CappedLog {
 public:
  static constexpr std::size_t most_bytes = 16u << 20;  // of one worker

  explicit CappedLog(Descriptor read_end);

  // To wait for; -1 once the worker has closed its end.
  int read_end() const { return read_end_.number(); }

  // Copies the whole lines that are there to `log`, without waiting. False when there is nothing.
  bool copy(const Descriptor& log);

  // The same for all that an ended worker has left.
  void copy_rest(const Descriptor& log);

 private:
  void write(std::string_view text, const Descriptor& log);

  Descriptor read_end_;
  std::string line_;  // that has no end yet
  std::size_t written_ = 0;
};

}  // namespace dmrp::host
