// SPDX-License-Identifier: MIT
// record_cursor.hpp: reads the body of a record of either format version. Internal to traces.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/bytes/trace_bytes.hpp"

namespace dmrp::core {

class RecordCursor : public ByteCursor {
 public:
  RecordCursor(std::span<const std::uint8_t> body, std::size_t origin, std::uint32_t format_version)
      : ByteCursor(body, origin), version_(format_version) {}

  std::uint32_t version() const { return version_; }  // of the format

  // Passes a cursor over the next block to `take`, and goes to the end of the block whatever was taken. Format version
  // 1 has no lengths: `take` gets this cursor.
  template <class TakeFields>
  void take_block(TakeFields&& take) {
    if (version_ == 1) return take(*this);
    const auto length = this->take<std::uint32_t>();
    const std::size_t begin = position();
    RecordCursor block(take_bytes(length), begin, version_);
    take(block);
  }

 private:
  std::uint32_t version_;
};

}  // namespace dmrp::core
