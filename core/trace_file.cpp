// SPDX-License-Identifier: MIT
#include "trace_file.hpp"

#include <cerrno>
#include <fstream>
#include <string>
#include <system_error>

#include "mcap_reader.hpp"

namespace dmrp::core {
namespace {

constexpr const char* trace_topic = "dmrp/trace";

TraceBytes bytes_of_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file) throw std::system_error(errno, std::generic_category(), path.string());
  TraceBytes bytes(static_cast<std::size_t>(file.tellg()));
  file.seekg(0);
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!file) throw std::system_error(errno, std::generic_category(), path.string());
  return bytes;
}

}  // namespace

TraceFileWriter::TraceFileWriter(const std::filesystem::path& path)
    : mcap_(path),
      channel_(mcap_.add_channel({trace_topic, "dmrp", 0, {{"version", std::to_string(trace_format_version)}}})),
      foxglove_(mcap_) {}

TraceBytes read_trace_file(const std::filesystem::path& path) {
  TraceBytes trace;
  read_mcap(bytes_of_file(path), trace_topic, [&](std::int64_t, std::span<const std::uint8_t> record) {
    trace.insert(trace.end(), record.begin(), record.end());
  });
  return trace;
}

}  // namespace dmrp::core
