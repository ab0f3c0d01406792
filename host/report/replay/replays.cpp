// SPDX-License-Identifier: MIT
#include "host/report/replay/replays.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

#include "core/trace/trace_reader.hpp"
#include "host/report/replay/page_packing.hpp"
#include "host/report/replay/replay_choice.hpp"
#include "host/report/replay/replay_data.hpp"
#include "host/results/trace_path.hpp"

namespace dmrp::host {
namespace {

namespace fs = std::filesystem;

// Packs replays until the budget is used up.
class ReplayPacker {
 public:
  ReplayPacker(fs::path run_directory, std::size_t budget_bytes)
      : run_directory_(std::move(run_directory)), budget_(budget_bytes) {}

  // Returns the reason for a failure; empty on success.
  std::string pack(const TrialRecord& trial, std::string& packed) {
    const fs::path file = trace_path(run_directory_, trial.id);
    std::error_code no_file;
    const std::uintmax_t trace_bytes = fs::file_size(file, no_file);
    if (no_file) return "no trace was recorded";
    if (!is_trace_of(trial, file)) return "the trace was changed after the run";
    const std::string over_budget = fmt::format("the budget of {} MB for replays is used up", megabytes_);
    // skips the encoding if even the best compression so far would exceed the budget
    if (smallest_share_ && *smallest_share_ * static_cast<double>(trace_bytes) > static_cast<double>(budget_))
      return over_budget;
    try {
      core::TraceReader trace(core::TraceRecords(file), core::TraceExtent::with_scans);
      packed = base64(gzip(replay_json(trace, trial)));
    } catch (const std::runtime_error&) {
      return "the trace cannot be read";
    }
    const double share = static_cast<double>(packed.size()) / static_cast<double>(trace_bytes);
    smallest_share_ = std::min(smallest_share_.value_or(share), share);
    if (packed.size() > budget_) return over_budget;
    budget_ -= packed.size();
    return {};
  }

 private:
  fs::path run_directory_;
  std::size_t budget_;
  double megabytes_ = static_cast<double>(budget_) * 1e-6;
  std::optional<double> smallest_share_;  // smallest ratio of packed replay to trace so far
};

void count(std::vector<OmittedReplays>& omitted, const std::string& why, const std::string& reason) {
  const auto found = std::find_if(omitted.begin(), omitted.end(), [&](const OmittedReplays& entry) {
    return entry.why == why && entry.reason == reason;
  });
  ++(found == omitted.end() ? omitted.emplace_back(OmittedReplays{why, 0, reason}) : *found).trials;
}

}  // namespace

Replays encode_replays(const fs::path& run_directory, std::span<const TrialRecord> trials,
                       std::span<const MetricColumn> metrics, const ReplayPolicy& policy,
                       const std::function<std::vector<MetricEvent>(std::uint64_t)>& events_of) {
  Replays chosen;
  ReplayPacker packer(run_directory, policy.budget_bytes);
  std::map<std::uint64_t, Replay> packed;         // by id
  std::map<std::uint64_t, std::string> failures;  // by id, with the reason
  for (const ReplayCandidate& candidate : replay_candidates(trials, metrics, policy.rank_by, policy.asked)) {
    TrialRecord trial = trials[candidate.trial];
    if (!packed.contains(trial.id) && !failures.contains(trial.id)) {
      if (events_of) trial.events = events_of(trial.id);
      Replay replay{trial.id, {}, {}};
      const std::string reason = packer.pack(trial, replay.packed);
      if (reason.empty())
        packed.emplace(trial.id, std::move(replay));
      else
        failures.emplace(trial.id, reason);
    }
    if (const auto found = packed.find(trial.id); found != packed.end())
      found->second.why.push_back(candidate.why);
    else
      count(chosen.omitted, candidate.why, failures.at(trial.id));
  }
  for (auto& [id, replay] : packed) chosen.replays.push_back(std::move(replay));
  return chosen;
}

}  // namespace dmrp::host
