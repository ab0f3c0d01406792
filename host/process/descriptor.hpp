// SPDX-License-Identifier: MIT
// descriptor.hpp: file descriptors that close themselves.
#pragma once

#include <string_view>
#include <utility>

namespace dmrp::host {

class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~Descriptor() { close(); }

  int number() const { return number_; }
  bool is_open() const { return number_ >= 0; }
  void close();

  // Blocks until all bytes are written. False on failure, with the reason in errno.
  bool write(std::string_view bytes) const;

 private:
  int number_ = -1;
};

struct Pipe {
  Descriptor read_end;
  Descriptor write_end;
};

// Programs that are executed do not inherit it. Throws MachineError.
Pipe make_pipe();

}  // namespace dmrp::host
