// SPDX-License-Identifier: MIT
#include "host/check/case_process.hpp"

#include <fmt/format.h>
#include <signal.h>

#include <new>
#include <nlohmann/json.hpp>
#include <optional>

#include "host/check/memory_file.hpp"
#include "host/errors/escaped_text.hpp"
#include "host/process/box.hpp"
#include "host/process/call_note.hpp"
#include "host/process/child_process.hpp"
#include "host/process/orphans.hpp"
#include "host/process/sanitized.hpp"
#include "host/process/watchdog.hpp"

namespace dmrp::host {

namespace {

constexpr std::int64_t memory_mb = 2048;
constexpr std::int64_t file_mb = 16;  // what a plugin prints is kept in memory

std::int64_t case_limit_s() {
  return sanitizer_is_loaded() ? 300 : 30;
}

bool is_late(const ChildProcess& child, std::int64_t elapsed_ns) {
  return child.is_late(elapsed_ns, 0, case_limit_s() * 1'000'000'000);
}

// A line of the answer. Texts of plugins need not be UTF-8: invalid bytes are replaced.
void send(const MemoryFile& answer, const nlohmann::json& message) {
  answer.append(message.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

// In the child.
void examine(const CheckCase& check_case, const std::filesystem::path& file, const PluginInfo* plugin,
             std::uint64_t seed, CallNote& note, const MemoryFile& answer) {
  const auto progress = [&](const std::string& what) { send(answer, {{"at", what}}); };
  // in memory that is never freed: after a fatal fault no function of the library may be called
  auto* const examination = new Examination(file, plugin, seed, note, progress);
  CheckResult result = CheckResult::pass;
  try {
    check_case.run(*examination);
    examination->deinit();
  } catch (const Skipped& skipped) {
    return send(answer, {{"result", CheckResult::skip}, {"text", skipped.reason}});
  } catch (const PluginFault& fault) {
    examination->fail(fault.text());
  } catch (const std::bad_alloc&) {
    examination->fail(fmt::format("needs more than {} MB of memory", memory_mb));
  } catch (const std::exception& error) {
    examination->fail(error.what());
  }
  result = examination->result();
  send(answer, {{"result", result}, {"text", examination->text()}});
}

struct Answer {
  std::string at;  // what was tried last
  std::optional<CheckResult> result;
  std::string text;
};

// A plugin can have written to the file: what cannot be read is ignored.
Answer read_answer(const std::string& text) {
  Answer answer;
  std::size_t begin = 0;
  for (std::size_t end = text.find('\n'); end != std::string::npos; begin = end + 1, end = text.find('\n', begin)) {
    const auto line = nlohmann::json::parse(text.begin() + static_cast<std::ptrdiff_t>(begin),
                                            text.begin() + static_cast<std::ptrdiff_t>(end), nullptr, false);
    if (!line.is_object()) continue;
    if (line.contains("at") && line["at"].is_string()) answer.at = line["at"].get<std::string>();
    if (!line.contains("result") || !line["result"].is_number_integer()) continue;
    const auto result = line["result"].get<std::int64_t>();
    if (result < 0 || result > static_cast<std::int64_t>(CheckResult::crash)) continue;
    answer.result = static_cast<CheckResult>(result);
    answer.text = line.value("text", "");
  }
  return answer;
}

// How a child ended that gave no answer.
std::string explain(const ProcessEnding& ending, bool hung, bool too_large, const NotedCall& call,
                    const Answer& answer) {
  std::string text = too_large ? fmt::format("needs more than {} MB of memory", memory_mb)
                     : hung    ? fmt::format("does not end within {} s", case_limit_s())
                               : ending.explain(memory_mb);
  if (ending.signal == SIGSYS) text = "makes a system call that the box refuses: " + box::name_of(call.refused);
  if (call.inside) text = call_text(call.plugin, call.function, text);
  return answer.at.empty() ? text : answer.at + ": " + text;
}

}  // namespace

CaseOutcome run_case(const CheckCase& check_case, const std::filesystem::path& file, const PluginInfo* plugin,
                     std::uint64_t seed) {
  adopt_orphans();
  const MemoryFile answer_file;
  const MemoryFile output;
  const SharedCallNote note(make_call_note());
  const std::int64_t start_ns = monotonic_ns();
  const bool counts_resident = plugin && plugin->has_flag(DMRP_FLAG_RESIDENT_MEMORY);
  ChildProcess child = ChildProcess::fork({counts_resident ? 0 : memory_mb, false, file_mb},
                                          [&] { examine(check_case, file, plugin, seed, note.note(), answer_file); },
                                          {output.descriptor(), &note.note().refused});
  child.allow_cpu(processor_time_s(case_limit_s()));
  Watchdog watchdog;
  bool too_large = false;
  const bool ended = watchdog.wait(child.ended().number(), [&] {
    too_large = !sanitizer_is_loaded() && child.memory_in_use().resident_mb > static_cast<double>(memory_mb);
    return too_large || is_late(child, watchdog.elapsed_ns(start_ns));
  });
  child.kill();
  const ProcessEnding& ending = child.wait();
  kill_orphans({});

  CaseOutcome outcome;
  outcome.hung = !ended && !too_large;
  outcome.printed = escaped(output.read().substr(0, 400).c_str());
  const Answer answer = read_answer(answer_file.read());
  if (ended && ending.succeeded() && answer.result) {
    outcome.result = *answer.result;
    outcome.detail = escaped(answer.text.c_str());
  } else {
    outcome.result = CheckResult::crash;
    outcome.detail = escaped(explain(ending, outcome.hung, too_large, note.read(), answer).c_str());
  }
  return outcome;
}

}  // namespace dmrp::host
