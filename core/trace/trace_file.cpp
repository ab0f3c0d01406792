// SPDX-License-Identifier: MIT
#include "core/trace/trace_file.hpp"

#include <string>

#include "core/trace/trace_schema.hpp"

namespace dmrp::core {

TraceFileWriter::TraceFileWriter(const std::filesystem::path& path)
    : mcap_(path),
      channel_(mcap_.add_channel({trace_topic,
                                  "dmrp",
                                  mcap_.add_schema({trace_schema_name, trace_schema_encoding, trace_schema()}),
                                  {{"version", std::to_string(trace_format_version)}}})),
      foxglove_(mcap_) {}

}  // namespace dmrp::core
