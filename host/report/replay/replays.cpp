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

namespace dmrp::host {
namespace {

namespace fs = std::filesystem;

// Fills the page's room as long as there is some.
class ReplayPacker {
 public:
  ReplayPacker(fs::path traces, std::size_t budget_bytes) : traces_(std::move(traces)), room_(budget_bytes) {}

  // Why it could not be done; empty if it was.
  std::string pack(const TrialRecord& trial, std::string& packed) {
    const fs::path file = traces_ / fmt::format("trial_{:06}.mcap", trial.id);
    std::error_code no_file;
    const std::uintmax_t trace_bytes = fs::file_size(file, no_file);
    if (no_file) return "no trace was recorded";
    const std::string no_room = fmt::format("the {} MB for replays were full", megabytes_);
    // spares the work where by all experience there is no room
    if (smallest_share_ && *smallest_share_ * static_cast<double>(trace_bytes) > static_cast<double>(room_))
      return no_room;
    try {
      core::TraceReader trace(core::TraceRecords(file), core::TraceExtent::with_scans);
      packed = base64(gzip(replay_json(trace, trial)));
    } catch (const std::runtime_error&) {
      return "the trace cannot be read";
    }
    const double share = static_cast<double>(packed.size()) / static_cast<double>(trace_bytes);
    smallest_share_ = std::min(smallest_share_.value_or(share), share);
    if (packed.size() > room_) return no_room;
    room_ -= packed.size();
    return {};
  }

 private:
  fs::path traces_;
  std::size_t room_;
  double megabytes_ = static_cast<double>(room_) * 1e-6;
  std::optional<double> smallest_share_;  // of a replay in its trace's bytes, so far
};

void count(std::vector<ReplaysLeftOut>& left_out, const std::string& why, const std::string& reason) {
  const auto found = std::find_if(left_out.begin(), left_out.end(), [&](const ReplaysLeftOut& entry) {
    return entry.why == why && entry.reason == reason;
  });
  ++(found == left_out.end() ? left_out.emplace_back(ReplaysLeftOut{why, 0, reason}) : *found).trials;
}

}  // namespace

Replays choose_and_encode_replays(const fs::path& run_directory, std::span<const TrialRecord> trials,
                                  std::span<const MetricColumn> metrics, const ReplayPolicy& policy) {
  Replays chosen;
  ReplayPacker packer(run_directory / "traces", policy.budget_bytes);
  std::map<std::uint64_t, Replay> packed;           // by id
  std::map<std::uint64_t, std::string> impossible;  // by id, with the reason
  for (const ReplayWish& wish : wished_replays(trials, metrics, policy.rank_by, policy.asked)) {
    const TrialRecord& trial = trials[wish.trial];
    if (!packed.contains(trial.id) && !impossible.contains(trial.id)) {
      Replay replay{trial.id, {}, {}};
      const std::string reason = packer.pack(trial, replay.packed);
      if (reason.empty())
        packed.emplace(trial.id, std::move(replay));
      else
        impossible.emplace(trial.id, reason);
    }
    if (const auto found = packed.find(trial.id); found != packed.end())
      found->second.why.push_back(wish.why);
    else
      count(chosen.left_out, wish.why, impossible.at(trial.id));
  }
  for (auto& [id, replay] : packed) chosen.replays.push_back(std::move(replay));
  return chosen;
}

}  // namespace dmrp::host
