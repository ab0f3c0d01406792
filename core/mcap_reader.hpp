// SPDX-License-Identifier: MIT
// mcap_reader.hpp: the messages of one channel of an MCAP file, in the order in which they were written.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>

#include "mcap.hpp"

namespace dmrp::core {

using McapMessageSink = std::function<void(std::int64_t log_time_ns, std::span<const std::uint8_t> message)>;

// Goes through `file`, the bytes of a file, and hands out the messages whose channel is called `topic`. Returns whether
// the file is whole: one that was cut short ends with its last whole chunk. Throws TraceError where it is damaged.
// Takes chunks that are not compressed or by zstd.
bool read_mcap(std::span<const std::uint8_t> file, std::string_view topic, const McapMessageSink& sink);

}  // namespace dmrp::core
