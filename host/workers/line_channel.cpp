// SPDX-License-Identifier: MIT
#include "host/workers/line_channel.hpp"

#include <unistd.h>

#include <array>
#include <cerrno>
#include <nlohmann/json.hpp>

namespace dmrp::host {

LineChannel::~LineChannel() {
  close(read_end_);
  hang_up();
}

void LineChannel::hang_up() {
  if (write_end_ >= 0) close(write_end_);
  write_end_ = -1;
}

bool LineChannel::send(const nlohmann::json& message) {
  // Plugins' texts may be no UTF-8: replaced rather than thrown at.
  const std::string line = message.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
  for (std::size_t sent = 0; sent < line.size();) {
    const ssize_t count = write(write_end_, line.data() + sent, line.size() - sent);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    sent += static_cast<std::size_t>(count);
  }
  return true;
}

bool LineChannel::fill() {
  std::array<char, 65536> chunk;
  ssize_t count;
  do {
    count = read(read_end_, chunk.data(), chunk.size());
  } while (count < 0 && errno == EINTR);
  if (count <= 0) return false;
  buffer_.append(chunk.data(), static_cast<std::size_t>(count));
  return true;
}

std::optional<nlohmann::json> LineChannel::take() {
  const auto end = buffer_.find('\n');
  if (end == std::string::npos) return std::nullopt;
  nlohmann::json message =
      nlohmann::json::parse(buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(end), nullptr, false);
  buffer_.erase(0, end + 1);
  return message;
}

std::optional<nlohmann::json> LineChannel::receive() {
  for (;;) {
    if (auto message = take()) return message->is_discarded() ? std::nullopt : message;
    if (!fill()) return std::nullopt;
  }
}

}  // namespace dmrp::host
