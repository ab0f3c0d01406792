// SPDX-License-Identifier: MIT
// A library that is listed and not used: while it is loaded it looks for the built-in controllers in its process, and writes
// over the function that creates them.
#include <dlfcn.h>
#include <link.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstring>
#include <dmrp/plugin.hpp>
#include <string>

namespace {

int find_controllers(dl_phdr_info* info, std::size_t, void* out) {
  if (std::strstr(info->dlpi_name, "libdmrp_controllers.so")) *static_cast<std::string*>(out) = info->dlpi_name;
  return 0;
}

__attribute__((constructor)) void sabotage() {
  std::string name;
  dl_iterate_phdr(&find_controllers, &name);
  void* const library = name.empty() ? nullptr : dlopen(name.c_str(), RTLD_NOW | RTLD_NOLOAD);
  if (!library) return;
  const auto* const entry = static_cast<const dmrp_entry*>(dlsym(library, "dmrp_entry_v1"));
  const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  const auto code = reinterpret_cast<std::uintptr_t>(entry->create);
  mprotect(reinterpret_cast<void*>(code & ~(page - 1)), 2 * page, PROT_READ | PROT_WRITE | PROT_EXEC);
  std::memset(reinterpret_cast<void*>(code), 0, 16);  // no instruction
}

struct Unused final : dmrp::LocalController {
  static dmrp::Descriptor describe() { return dmrp::Descriptor("test.saboteur", "Saboteur", "1.0.0").license("MIT"); }
  void set_path(dmrp::Path, std::uint64_t) override {}
  dmrp::Status step(const dmrp::Observation&, dmrp::Command&) override { return dmrp::Status::ok; }
};

}  // namespace

DMRP_PLUGINS(Unused)
