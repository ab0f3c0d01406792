// SPDX-License-Identifier: MIT
#include "host/workers/capped_log.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <string_view>

namespace dmrp::host {

namespace {
constexpr std::size_t longest_line = 65536;
constexpr int most_reads = 64;  // a copy of the worker may go on printing
}  // namespace

CappedLog::CappedLog(Descriptor read_end) : read_end_(std::move(read_end)) {
  fcntl(read_end_.number(), F_SETFL, O_NONBLOCK);
}

bool CappedLog::copy(const Descriptor& log) {
  std::array<char, 65536> chunk;
  const ssize_t count = read(read_end_.number(), chunk.data(), chunk.size());
  if (count == 0) read_end_.close();
  if (count <= 0) return false;
  line_.append(chunk.data(), static_cast<std::size_t>(count));
  std::size_t whole = line_.rfind('\n') + 1;  // 0 if there is none
  if (line_.size() - whole > longest_line) whole = line_.size();
  write(std::string_view(line_).substr(0, whole), log);
  line_.erase(0, whole);
  return true;
}

void CappedLog::copy_rest(const Descriptor& log) {
  for (int i = 0; i < most_reads && copy(log); ++i) {
  }
  if (!line_.empty()) write(line_ + "\n", log);
  line_.clear();
}

void CappedLog::write(std::string_view text, const Descriptor& log) {
  if (written_ > most_bytes) return;
  written_ += text.size();
  log.write(text);
  if (written_ > most_bytes)
    log.write(fmt::format("[warning] dmrp-host: a worker printed more than {} MB; what follows is left out\n",
                          most_bytes >> 20));
}

}  // namespace dmrp::host
