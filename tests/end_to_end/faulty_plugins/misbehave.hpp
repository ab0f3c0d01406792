// SPDX-License-Identifier: MIT
// misbehave.hpp: faults that any plugin can have in any function.
#pragma once

#include <fenv.h>

#include <csignal>
#include <cstdlib>
#include <dmrp/plugin.hpp>
#include <list>
#include <memory>
#include <stdexcept>
#include <string>

namespace dmrp::test {

// Other faults belong to one kind of plugin: wrong outputs.
inline dmrp::Status misbehave(const std::string& fault) {
  if (fault == "crash") std::raise(SIGSEGV);
  if (fault == "abort") std::abort();
  if (fault == "exit") std::exit(0);
  if (fault == "throw") throw std::runtime_error("thrown on purpose");
  if (fault == "throw_number") throw 42;
  if (fault == "rounding") std::fesetround(FE_UPWARD);
  if (fault == "unknown_status") return static_cast<dmrp::Status>(99);
  if (fault == "hang")
    for (volatile bool on = true; on;) {
    }
  if (fault == "memory") {
    constexpr std::size_t chunk = 16u << 20;
    // not written to: on a loaded machine, that could take longer than the call may
    for (std::list<std::unique_ptr<char[]>> all;;) all.emplace_back(new char[chunk]);
  }
  return dmrp::Status::ok;
}

}  // namespace dmrp::test
