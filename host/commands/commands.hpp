// SPDX-License-Identifier: MIT
// commands.hpp: the commands of `dmrp-host`. Each returns the exit status, and throws InputError, MachineError,
// std::system_error or std::runtime_error, which main() reports.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "host/evaluate/evaluation.hpp"
#include "host/results/manifest.hpp"

namespace dmrp::host {

namespace exit_status {
inline constexpr int done = 0;
inline constexpr int faults = 1;  // some trials ended in a fault
inline constexpr int bad_input = 2;
inline constexpr int machine_failed = 3;  // a full disk, an I/O error, no memory
inline constexpr int findings = 1;        // check: a case failed or crashed
inline constexpr int different = 1;       // verify: a trial has other bits
inline constexpr int worse = 1;           // compare --fail-if: a condition holds
inline constexpr int undecided = 4;       // compare --fail-if: the trials cannot decide
inline constexpr int interrupted = 130;
}  // namespace exit_status

struct RunOptions {
  std::filesystem::path experiment;
  std::filesystem::path out;  // empty: runs/NAME, or runs/NAME-2, ...
  unsigned jobs = 1;
  bool resume = false;
  bool retry_faults = false;  // resume: trials with faults, too
  Shard shard;
  std::uint32_t trials = 0;  // 0: as the file says
  bool quiet = false;
  bool json = false;             // results as JSON, without progress
  std::filesystem::path bundle;  // to be written afterwards; empty: none
};
int run_command(const RunOptions& options, const std::vector<std::string>& command_line);

// Runs one trial in this process, without limits of time or a box, and prints its values: for debuggers.
int debug_command(const std::filesystem::path& experiment, std::uint32_t trials, std::uint64_t trial);

int validate_command(const std::filesystem::path& experiment);

// Without names, all libraries of the plugin path.
enum class PluginsFormat { text, json, markdown };
int plugins_command(const std::vector<std::string>& libraries, PluginsFormat format);

struct CheckOptions {
  std::string library;
  std::string only;  // a regular expression; empty: all cases
  std::uint64_t seed = 1;
  bool json = false;
};
int check_command(const CheckOptions& options);

struct DrawOptions {
  std::string scenario;
  std::uint32_t agents = 0;  // random robots that replace the scenario's; 0: keep the scenario's
  std::uint64_t seed = 1;
  std::optional<std::uint32_t> conflicts_min;  // of random robots (core/tasks/task_generator.hpp), as the next two
  std::optional<std::uint32_t> conflicts_max;
  bool in_corridors = false;
  std::string planner;                // id; empty: no plan
  std::vector<std::string> plugins;   // libraries, in addition to the plugin path
  std::vector<std::string> settings;  // key=value for the planner
  std::filesystem::path svg;          // empty: standard output; also a .png or .pdf
  std::filesystem::path png;          // instead of `svg`
};
int draw_command(const DrawOptions& options);

struct VideoOptions {
  std::filesystem::path run_directory;
  std::uint64_t trial = 0;
  std::filesystem::path out;  // its ending is the format
};
int video_command(const VideoOptions& options);

struct PlanOptions {
  std::filesystem::path map;  // either a MovingAI map, its tasks and a number of agents
  std::filesystem::path tasks;
  std::uint32_t agents = 0;
  std::uint32_t drawn = 0;  // or so many tasks drawn on the map
  std::string scenario;     // or a scenario: a name, or the path of a scenario.toml; `agents` then draws robots
  std::string planner;      // id
  std::vector<std::string> plugins;
  std::vector<std::string> settings;
  double time_limit_s = 60.0;
  std::int64_t memory_mb = 4096;  // 0: no limit
  std::uint64_t seed = 1;
  std::filesystem::path paths;  // CSV; empty: none
  bool json = false;
};
int plan_command(const PlanOptions& options);

// Writes report.html into the run directory. `replayed`: trials to replay, besides those that the report chooses.
int report_command(const std::filesystem::path& run_directory, const std::vector<std::uint64_t>& replayed);

enum class ExportFormat { latex, csv, table, svg, thresholds, map };
inline constexpr const char* own_table = "own";

struct ExportOptions {
  std::filesystem::path run_directory;
  ExportFormat format = ExportFormat::latex;
  std::vector<std::string> rows;     // labels; empty with the others: the tables of the report
  std::vector<std::string> columns;  // labels
  std::vector<std::string> metrics;
  std::string table;            // table: one of the report's, or own_table, of rows, columns and metrics
  std::string over = "robots";  // svg: what the metric is drawn over
  std::uint64_t trial = 0;      // map: the trial
  std::filesystem::path out;    // empty: standard output; figures also to a .png or .pdf
};
int export_command(const ExportOptions& options);

struct CompareOptions {
  std::vector<std::filesystem::path> runs;  // at least two; each is compared with the first
  std::vector<std::string> metrics;         // empty: those that the report compares
  std::vector<std::string> fail_if;         // "success < -0.02"
  std::filesystem::path report;             // empty: no page is written
};
int compare_command(const CompareOptions& options);

// Lists the tables and keys of experiment or of scenario files.
int keys_command(const std::string& format);

struct NewOptions {
  std::string kind;  // a folder of the templates
  std::string id;    // of the new plugin
  std::filesystem::path folder;
};
int new_command(const NewOptions& options);

struct DiscriminateOptions {
  std::vector<std::filesystem::path> runs;  // of the same tasks
  std::string declared = "success";         // the effect that counts, declared beforehand: or "time"
  std::string factor;                       // not empty: prints a row of a Markdown table, with this name of the factor
  std::vector<std::string> contrast;        // not empty: two entries; prints their difference instead
};
int discriminate_command(const DiscriminateOptions& options);

struct EvaluateOptions {
  EvaluationChoice choice;
  std::vector<std::uint64_t> trials;  // empty: all
  std::filesystem::path csv;          // empty: standard output
};
int evaluate_command(const EvaluateOptions& options);

struct MergeOptions {
  std::filesystem::path out;
  std::vector<std::filesystem::path> runs;
};
int merge_command(const MergeOptions& options, const std::vector<std::string>& command_line);

struct BundleOptions {
  std::filesystem::path source;  // a run directory or an experiment
  std::filesystem::path out;     // empty: NAME-bundle
  bool with_plugins = false;     // copies those that come with dmrp-host, too
};
int bundle_command(const BundleOptions& options);

// Of a run directory that no other process works on.
void bundle_run(const std::filesystem::path& run, const std::filesystem::path& out, bool with_plugins);
void check_new_bundle(const std::filesystem::path& out);  // throws InputError if something is there

struct VerifyOptions {
  std::filesystem::path directory;  // of a run, or a bundle of one
  std::size_t trials = 10;          // at most
  std::uint64_t seed = 1;           // chooses the trials and their order
  unsigned jobs = 1;
};
int verify_command(const VerifyOptions& options);

}  // namespace dmrp::host
