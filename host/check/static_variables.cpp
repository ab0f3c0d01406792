// SPDX-License-Identifier: MIT
#include "host/check/static_variables.hpp"

#include <link.h>

#include <algorithm>
#include <cstring>

namespace dmrp::host {

StaticVariables::StaticVariables(const std::filesystem::path& library) {
  struct Search {
    const std::filesystem::path& library;
    StaticVariables& self;
  } search{library, *this};
  dl_iterate_phdr(
      [](dl_phdr_info* object, std::size_t, void* data) {
        auto& [wanted, self] = *static_cast<Search*>(data);
        if (wanted != object->dlpi_name) return 0;
        self.base_ = object->dlpi_addr;
        // what the loader has made read-only begins the writable segment
        std::uintptr_t relocated_end = 0;
        for (int i = 0; i < object->dlpi_phnum; ++i)
          if (const auto& part = object->dlpi_phdr[i]; part.p_type == PT_GNU_RELRO)
            relocated_end = self.base_ + part.p_vaddr + part.p_memsz;
        for (int i = 0; i < object->dlpi_phnum; ++i) {
          const auto& part = object->dlpi_phdr[i];
          if (part.p_type != PT_LOAD || (part.p_flags & PF_W) == 0) continue;
          const std::uintptr_t begin = std::max(self.base_ + part.p_vaddr, relocated_end);
          const std::uintptr_t end = self.base_ + part.p_vaddr + part.p_memsz;
          if (begin >= end) continue;
          const auto* const first = reinterpret_cast<const std::uint8_t*>(begin);
          self.ranges_.push_back({first, {first, first + (end - begin)}});
        }
        return 1;
      },
      &search);
}

std::vector<std::uintptr_t> StaticVariables::changed() const {
  std::vector<std::uintptr_t> places;
  for (const Range& range : ranges_)
    for (std::size_t i = 0; i < range.values.size(); ++i)
      if (range.begin[i] != range.values[i])
        places.push_back(reinterpret_cast<std::uintptr_t>(range.begin) + i - base_);
  return places;
}

}  // namespace dmrp::host
