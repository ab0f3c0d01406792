// SPDX-License-Identifier: MIT
// line_channel.hpp: JSON messages, one per line, over a pair of pipes between parent and child.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "host/process/descriptor.hpp"

namespace dmrp::host {

class LineChannel {
 public:
  // Either end may be missing: the channel then only sends, or only receives.
  LineChannel(Descriptor read_end, Descriptor write_end);

  int read_end() const { return read_end_.number(); }

  // Blocks until the message is written; false if the other side has closed.
  bool send(const nlohmann::json& message);

  // Whether fill() would not block.
  bool has_input() const;

  // Closes the write end: receive() of the other side returns nothing.
  void close_write_end() { write_end_.close(); }

  // The next message; blocks. Nothing when the other side has closed, or when it sent a line that is not JSON.
  std::optional<nlohmann::json> receive();

  // Reads once, as many bytes as there are. False when the other side has closed.
  bool fill();

  // The next whole message that fill() has read, if there is one. A line that is not JSON is returned as discarded JSON.
  std::optional<nlohmann::json> take();

 private:
  Descriptor read_end_;
  Descriptor write_end_;
  std::string buffer_;
  std::size_t searched_ = 0;  // so many bytes of the buffer have no line end
};

}  // namespace dmrp::host
