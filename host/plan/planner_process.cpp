// SPDX-License-Identifier: MIT
#include "host/plan/planner_process.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <new>
#include <nlohmann/json.hpp>

#include "host/process/child_process.hpp"
#include "host/process/memory_file.hpp"
#include "host/process/watchdog.hpp"
#include "host/trial/instance_pool.hpp"

namespace dmrp::host {

namespace {

constexpr std::int64_t second_ns = 1'000'000'000;
constexpr std::int64_t call_grace_ns = 5 * second_ns;      // after should_stop() has returned true
constexpr std::int64_t least_limit_ns = 15 * second_ns;    // for all functions but plan()
constexpr std::int64_t process_grace_ns = 60 * second_ns;  // for everything outside calls, such as loading

// The child returns its answer in a file in memory: a line of JSON, then the waypoints of all robots as structs.
void write_answer(const MemoryFile& file, const nlohmann::json& head, const PlannedPaths& paths) {
  // texts of plugins need not be UTF-8: invalid bytes are replaced
  file.append(head.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
  for (const auto& path : paths)
    file.append({reinterpret_cast<const char*>(path.data()), path.size() * sizeof(dmrp_waypoint)});
}

nlohmann::json head_of(const PlannerAnswer& answer) {
  nlohmann::json statistics = nlohmann::json::array();
  for (const PlanStatistic& statistic : answer.statistics) statistics.push_back({statistic.name, statistic.value});
  nlohmann::json counts = nlohmann::json::array();
  for (const auto& path : answer.paths) counts.push_back(path.size());
  return {{"status", answer.status},
          {"planning_ns", answer.planning_ns},
          {"text", answer.text},
          {"statistics", std::move(statistics)},
          {"counts", std::move(counts)}};
}

// Nothing if the bytes are not an answer: the plugin may have overwritten them.
std::optional<PlannerAnswer> answer_of(const nlohmann::json& head, std::string_view waypoints) {
  PlannerAnswer answer;
  answer.status = head.at("status").get<std::int32_t>();
  answer.planning_ns = head.at("planning_ns").get<std::int64_t>();
  answer.text = head.at("text").get<std::string>();
  for (const nlohmann::json& statistic : head.at("statistics"))
    if (statistic.at(1).is_number())  // JSON has no infinity: such a number is none
      answer.statistics.push_back({statistic.at(0).get<std::string>(), statistic.at(1).get<double>()});
  for (const nlohmann::json& count : head.at("counts")) {
    const auto bytes = count.get<std::size_t>() * sizeof(dmrp_waypoint);
    if (bytes > waypoints.size()) return std::nullopt;
    auto& path = answer.paths.emplace_back(count.get<std::size_t>());
    if (bytes > 0) std::memcpy(path.data(), waypoints.data(), bytes);
    waypoints.remove_prefix(bytes);
  }
  return waypoints.empty() ? std::optional(std::move(answer)) : std::nullopt;
}

nlohmann::json head_of(const char* fault, const std::string& detail) {
  return {{"fault", fault}, {"detail", detail}};
}

void log_to_stderr(std::int32_t level, const std::string& plugin, const std::string& text) {
  if (level != DMRP_LOG_DEBUG) std::fprintf(stderr, "%s: %s\n", plugin.c_str(), text.c_str());
}

// In the child.
void plan(const Experiment& experiment, const PlanTask& task, CallNote& note, const MemoryFile& file) {
  try {
    CallGuard guard(note);
    InstancePool pool(experiment.libraries, guard, &log_to_stderr);
    try {
      Instance& planner = pool.get(experiment.global_planners[0], DMRP_NO_ROBOT);
      planner.start(task.world(), experiment.seed, task.problem.c.time_budget_ns);
      const PlannerAnswer answer = call_planner(planner, task.problem.c, 0);
      write_answer(file, head_of(answer), answer.paths);
    } catch (const PluginFault& fault) {
      write_answer(file, head_of(fault.kind(), fault.text()), {});
      if (fault.fatal()) _exit(0);  // no function of the library may be called again
    }
  } catch (const PluginFault& fault) {
    write_answer(file, head_of(fault.kind(), fault.text()), {});
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    write_answer(file, head_of(fault_kind::abi_breach, error.what()), {});
  }
}

// Describes the end of a child that gave no answer. `call`: the last that it noted.
void explain(const ProcessEnding& ending, bool hung, const NotedCall& call, const Experiment& experiment,
             PlannerRun& run) {
  run.fault = hung ? fault_kind::hang : ending.fault_kind();
  const std::string text = hung ? fmt::format("did not stop when its time of {} s was over, and was killed",
                                              experiment.limits.planner_time_s)
                                : ending.explain(experiment.limits.memory_mb);
  run.detail =
      call.inside ? call_text(call.plugin, call.function, text) : experiment.global_planners[0].info.id + ": " + text;
}

// Fills in the answer, or the fault that the child found.
void read_answer(const std::string& text, std::size_t line_end, PlannerRun& run) {
  const auto head = nlohmann::json::parse(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(line_end));
  if (head.contains("fault")) {
    run.detail = head.at("detail").get<std::string>();
    run.fault = head.at("fault").get<std::string>();
  } else {
    run.answer = answer_of(head, std::string_view(text).substr(line_end + 1));
  }
}

}  // namespace

PlannerRun run_planner(const Experiment& experiment, const PlanTask& task) {
  const MemoryFile file;
  const SharedCallNote note(make_call_note());
  const std::int64_t start_ns = monotonic_ns();
  ChildProcess child = ChildProcess::fork({experiment.limits.memory_mb, experiment.limits.processes},
                                          [&] { plan(experiment, task, note.note(), file); });

  Watchdog watchdog;
  NotedCall call;
  const std::int64_t limit_ns = task.problem.c.time_budget_ns + call_grace_ns;
  child.allow_cpu(processor_time_s(static_cast<double>(limit_ns + process_grace_ns) * 1e-9));
  const bool ended = watchdog.wait(child.ended().number(), [&] {
    call = note.read();
    return watchdog.elapsed_ns(start_ns) > limit_ns + process_grace_ns ||
           watchdog.is_overdue(call, start_ns, call.function == "plan" ? limit_ns : std::max(limit_ns, least_limit_ns));
  });
  if (ended)
    call = note.read();
  else
    child.kill();
  const ProcessEnding& ending = child.wait();

  PlannerRun run;
  run.peak_rss_mb = ending.peak_rss_mb;
  const std::string text = file.read();
  const std::size_t line_end = std::min(text.find('\n'), text.size());
  if (!ended || !ending.succeeded() || line_end == text.size()) {
    explain(ending, !ended, call, experiment, run);
    return run;
  }
  try {
    read_answer(text, line_end, run);
  } catch (const nlohmann::json::exception&) {
    run.answer.reset();
  }
  if (run.fault == fault_kind::out_of_memory && experiment.limits.memory_mb > 0)
    run.detail += fmt::format(" (its process may take {} MB)", experiment.limits.memory_mb);
  if (!run.answer && run.fault.empty()) {
    run.fault = fault_kind::abi_breach;
    run.detail = experiment.global_planners[0].info.id + ": its process gave an answer that cannot be read";
  }
  return run;
}

}  // namespace dmrp::host
