// SPDX-License-Identifier: MIT
#include "host/guests/probe.hpp"

#include <fmt/format.h>
#include <signal.h>

#include <cstring>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "host/guests/guest_process.hpp"
#include "host/process/orphans.hpp"

namespace dmrp::host {

namespace {

constexpr std::int64_t limit_s = 20;

// What a library does while it is loaded. The function of the end is the stage: "dlopen", "init()".
std::string text_of(const GuestEnd& end) {
  const std::string& stage = end.function();
  if (end.kind() == std::string_view(fault_kind::hang))
    return fmt::format("hangs while it is loaded, in {} ({} s)", stage, limit_s);
  if (end.signal() == SIGSYS)
    return fmt::format("makes a system call while it is loaded, in {}, that the box refuses (see --no-box)", stage);
  if (end.signal() != 0)
    return fmt::format("crashes while it is loaded, in {} (signal {}, {}{})", stage, end.signal(),
                       strsignal(end.signal()), stage == "dlopen" ? "; a truncated file?" : "");
  return "ends the process while it is loaded, in " + stage;
}

}  // namespace

Probe probe_library(const std::filesystem::path& file, const VisiblePaths& visible) {
  GuestLimits limits;
  limits.trial_wall_time_s = static_cast<double>(limit_s);
  limits.plain_log_level = DMRP_LOG_ERROR + 1;  // none
  const std::int64_t start_ns = monotonic_ns();
  const auto check_limits = [&] { return monotonic_ns() - start_ns > limit_s * 1'000'000'000 ? "late" : ""; };
  const ForkServer& fork_server = own_fork_server();
  try {
    GuestProcess guest(
        fork_server, {"", file, {}, {}, visible}, limits, GuestTask::probe, -1, [](pid_t) {}, check_limits);
    const nlohmann::json answer = nlohmann::json::parse(guest.loaded());
    kill_orphans({fork_server.number()});
    return {answer.at("plugins").get<std::vector<PluginInfo>>(), answer.at("warnings").get<std::vector<std::string>>(),
            answer.at("objects").get<std::vector<std::string>>(), answer.at("init_error").get<std::string>(),
            answer.at("runtime").get<std::vector<std::string>>()};
  } catch (const nlohmann::json::exception&) {
    throw std::runtime_error("gives an answer that cannot be read while it is loaded");
  } catch (const GuestEnd& end) {
    kill_orphans({fork_server.number()});
    throw std::runtime_error(text_of(end));
  }
}

}  // namespace dmrp::host
