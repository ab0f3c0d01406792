// SPDX-License-Identifier: MIT
// line_channel.hpp: JSON messages, one a line, over a pair of pipes between supervisor and worker.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

namespace dmrp::host {

class LineChannel {
 public:
  // Owns both descriptors.
  LineChannel(int read_end, int write_end) : read_end_(read_end), write_end_(write_end) {}
  ~LineChannel();
  LineChannel(const LineChannel&) = delete;
  LineChannel& operator=(const LineChannel&) = delete;

  int read_end() const { return read_end_; }

  // Blocks until it is written; false if the other side is gone.
  bool send(const nlohmann::json& message);

  // Says that nothing more will be sent: the other side's receive() ends.
  void hang_up();

  // The next message; blocks for it. Nothing when the other side has closed or sent something that is no JSON.
  std::optional<nlohmann::json> receive();

  // Reads once, what is there. False when the other side has closed.
  bool fill();

  // A whole message that fill() has read, if there is one. Damaged lines are returned as discarded JSON.
  std::optional<nlohmann::json> take();

 private:
  int read_end_;
  int write_end_;
  std::string buffer_;
};

}  // namespace dmrp::host
