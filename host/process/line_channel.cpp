// SPDX-License-Identifier: MIT
#include "host/process/line_channel.hpp"

#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <nlohmann/json.hpp>

namespace dmrp::host {

LineChannel::LineChannel(Descriptor read_end, Descriptor write_end)
    : read_end_(std::move(read_end)), write_end_(std::move(write_end)) {}

bool LineChannel::send(const nlohmann::json& message) {
  // texts of plugins need not be UTF-8: invalid bytes are replaced
  return write_end_.write(message.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

bool LineChannel::has_input() const {
  pollfd watched = {read_end_.number(), POLLIN, 0};
  return poll(&watched, 1, 0) > 0;
}

bool LineChannel::fill() {
  std::array<char, 65536> chunk;
  ssize_t count;
  do {
    count = read(read_end_.number(), chunk.data(), chunk.size());
  } while (count < 0 && errno == EINTR);
  if (count <= 0) return false;
  buffer_.append(chunk.data(), static_cast<std::size_t>(count));
  return true;
}

std::optional<nlohmann::json> LineChannel::take() {
  const auto end = buffer_.find('\n', searched_);
  searched_ = end == std::string::npos ? buffer_.size() : 0;
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
