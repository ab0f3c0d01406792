// SPDX-License-Identifier: MIT
// record_cursor.hpp: reads the body of a record. Internal to traces.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/bytes/trace_bytes.hpp"

namespace dmrp::core {

class RecordCursor : public ByteCursor {
 public:
  using ByteCursor::ByteCursor;

  // Passes a cursor over the next block to `take`, and goes to the end of the block whatever was taken.
  template <class TakeFields>
  void take_block(TakeFields&& take) {
    const auto length = this->take<std::uint32_t>();
    const std::size_t begin = position();
    RecordCursor block(take_bytes(length), begin);
    take(block);
  }
};

}  // namespace dmrp::core
