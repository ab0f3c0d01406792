// SPDX-License-Identifier: MIT
// An encoder, and the trace that it has written so far.
#pragma once

#include <cstdint>
#include <span>

#include "core/trace/trace_encoder.hpp"

namespace dmrp::test {

class TraceInMemory {
 public:
  explicit TraceInMemory(const dmrp_world& world)
      : encoder_(world, [this](std::int64_t, std::span<const std::uint8_t> record) {
          bytes_.insert(bytes_.end(), record.begin(), record.end());
        }) {}
  TraceInMemory(const TraceInMemory&) = delete;
  TraceInMemory& operator=(const TraceInMemory&) = delete;

  core::TraceEncoder& operator*() { return encoder_; }
  core::TraceEncoder* operator->() { return &encoder_; }
  const core::TraceBytes& bytes() const { return bytes_; }

 private:
  core::TraceBytes bytes_;
  core::TraceEncoder encoder_;
};

}  // namespace dmrp::test
