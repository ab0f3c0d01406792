// SPDX-License-Identifier: MIT
// reference_run.hpp: results that were published without their database: a folder with manifest.json and trials.csv, as
// a run directory has them, of which columns of metrics may be missing.
#pragma once

#include <filesystem>
#include <span>

#include "host/report/data/report_run.hpp"

namespace dmrp::host {

// Whether the folder has no database but a table of trials.
bool is_reference_run(const std::filesystem::path& directory);

// `metrics`: those that can be read, with their units; of the run that it is compared with. Throws InputError with file,
// line and column.
ReportRun read_reference_run(const std::filesystem::path& directory, std::span<const MetricColumn> metrics);

}  // namespace dmrp::host
