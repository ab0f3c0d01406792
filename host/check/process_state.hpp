// SPDX-License-Identifier: MIT
// process_state.hpp: what a plugin may not change in its process.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace dmrp::host {

struct ProcessState {
  std::string locale;
  std::string folder;                    // working directory
  std::vector<std::string> environment;  // sorted
  std::vector<const void*> handlers;     // of signals
  std::vector<std::string> descriptors;  // "3: file 17 of device 1", sorted
  unsigned file_mode_mask = 0;

  static ProcessState now();

  // The first difference from `before`, in one line; "" if there is none.
  std::string change_since(const ProcessState& before) const;
};

// Threads of this process.
std::size_t thread_count();

// What a library keeps beside its instances, seen from outside.
class StaticVariables {
 public:
  // Those of a library that this process has loaded, with their present values.
  explicit StaticVariables(const std::filesystem::path& library);

  // Returns where in the library bytes have changed since, in order.
  std::vector<std::uintptr_t> changed() const;

 private:
  struct Range {
    const std::uint8_t* begin;
    std::vector<std::uint8_t> values;
  };
  std::uintptr_t base_ = 0;
  std::vector<Range> ranges_;
};

}  // namespace dmrp::host
