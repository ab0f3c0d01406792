// SPDX-License-Identifier: MIT
#include "core/trace/trace_file.hpp"

#include <string>

namespace dmrp::core {

TraceFileWriter::TraceFileWriter(const std::filesystem::path& path)
    : mcap_(path),
      channel_(mcap_.add_channel({trace_topic, "dmrp", 0, {{"version", std::to_string(trace_format_version)}}})),
      foxglove_(mcap_) {}

}  // namespace dmrp::core
