// SPDX-License-Identifier: MIT
// memory_file.hpp: a file in memory, by which a child returns an answer of any length.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "host/process/descriptor.hpp"

namespace dmrp::host {

class MemoryFile {
 public:
  MemoryFile();                                                     // throws MachineError
  explicit MemoryFile(Descriptor file) : file_(std::move(file)) {}  // another process has made it

  void append(std::string_view bytes) const;  // throws MachineError
  std::string read() const;
  int descriptor() const { return file_.number(); }

 private:
  Descriptor file_;
};

}  // namespace dmrp::host
