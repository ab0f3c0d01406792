// SPDX-License-Identifier: MIT
// static_variables.hpp: what a library keeps beside its instances, seen from outside.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace dmrp::host {

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
