// SPDX-License-Identifier: MIT
#include "host/guests/inside/guest_program.hpp"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "host/guests/inside/guest_runtime.hpp"
#include "host/guests/inside/log_line.hpp"
#include "host/plugins/calls/own_process.hpp"
#include "host/plugins/elf_file.hpp"
#include "host/plugins/python_file.hpp"
#include "host/process/box.hpp"
#include "host/process/child_process.hpp"
#include "host/process/orphans.hpp"
#include "host/process/resource_limits.hpp"
#include "host/process/sanitized.hpp"
#include "host/results/result_json.hpp"

namespace dmrp::host {

namespace {

const GuestMemory* own_memory = nullptr;  // for the signal handler

// Tells the judge why the process crashes. Async-signal-safe.
void note_crash(int number, siginfo_t* info, void*) {
  if (own_memory->is_read_only(info->si_addr)) own_memory->guest().wrote_into_input = 1;
  signal(number, SIG_DFL);
  raise(number);
}

void watch_input(const GuestMemory& memory) {
  if (sanitizer_is_loaded()) return;  // it has a handler of its own
  own_memory = &memory;
  constexpr std::size_t stack_bytes = std::size_t{1} << 16;
  static std::array<std::byte, stack_bytes> stack;  // a stack overflow leaves no room on the other
  const stack_t alternative = {stack.data(), 0, stack.size()};
  sigaltstack(&alternative, nullptr);
  struct sigaction action {};
  action.sa_sigaction = &note_crash;
  action.sa_flags = SA_SIGINFO | SA_ONSTACK;
  sigaction(SIGSEGV, &action, nullptr);
}

// Messages to the judge, and the judge's next one.
class JudgeLine {
 public:
  explicit JudgeLine(const GuestMemory& memory) : memory_(memory) {}

  // Waits for the judge's next message.
  void wait() {
    while (!GuestMemory::wait(memory_.judge().turn, turn_, std::chrono::milliseconds(0))) {
    }
    ++turn_;
  }

  void answer(GuestPage::Kind kind, const std::string& text, const std::vector<std::uint8_t>& annotations) {
    GuestPage& page = memory_.guest();
    if (text.size() > memory_.text_room()) throw std::bad_alloc();
    std::copy(text.begin(), text.end(), memory_.text());
    page.text_bytes = text.size();
    page.annotation_bytes = std::min(annotations.size(), memory_.text_room());
    std::copy_n(annotations.begin(), page.annotation_bytes, memory_.annotations());
    say(kind);
  }

  const void* ask(const GuestQuestion& question) {
    memory_.guest().asked = question;
    say(GuestPage::question);
    wait();
    return memory_.judge().answer;
  }

 private:
  void say(GuestPage::Kind kind) {
    if (own_process::is_copy()) _exit(0);  // that a plugin has made
    memory_.guest().kind = kind;
    GuestMemory::give(memory_.guest().turn, turn_);
  }

  const GuestMemory& memory_;
  std::uint32_t turn_ = 0;
};

nlohmann::json fault_json(const PluginFault& fault) {
  return {{"kind", fault.kind()},   {"plugin", fault.plugin()}, {"function", fault.function()}, {"step", fault.step()},
          {"robot", fault.robot()}, {"detail", fault.what()},   {"fatal", fault.fatal()}};
}

core::TraceRecords open_spool(int descriptor) {
  static std::unique_ptr<core::TraceSpool> spool;
  spool = std::make_unique<core::TraceSpool>(descriptor);
  return core::TraceRecords(*spool);
}

void serve(const GuestSetup& setup, const GuestMemory& memory) {
  JudgeLine judge(memory);
  CallGuard guard(memory.note());
  if (setup.processes) guard.allow_processes();
  std::optional<GuestRuntime> runtime;
  const auto log = [&](std::int32_t level, const std::string& plugin, const std::string& text) {
    if (setup.plain_log_level >= 0) {
      if (level >= setup.plain_log_level) std::fprintf(stderr, "%s: %s\n", plugin.c_str(), text.c_str());
      return;
    }
    std::optional<LoggedTrial> trial;
    if (runtime && runtime->trial()) trial = {runtime->trial()->trial, runtime->trial()->step_ns};
    std::fputs(log_line(level, plugin, text, trial, memory.note()).c_str(), stderr);
  };
  runtime.emplace(
      setup.written, setup.library, memory.note(), guard, log,
      [&](const GuestQuestion& question) { return judge.ask(question); }, [&] { return open_spool(setup.spool); });
  for (;;) {
    judge.wait();
    const JudgePage& page = memory.judge();
    try {
      const std::string text = runtime->answer(page.request, {page.text, page.text_bytes});
      judge.answer(GuestPage::answer, text, runtime->annotations().bytes);
    } catch (const PluginFault& fault) {
      const std::string text = fault_json(fault).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
      judge.answer(GuestPage::fault, text, runtime->annotations().bytes);
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      judge.answer(GuestPage::failure, error.what(), {});
    }
  }
}

}  // namespace

VisiblePaths visible_paths_of(const LibraryUse& library) {
  VisiblePaths visible;
  std::set<std::filesystem::path> folders;
  const VisiblePaths files = files_of_library(library.file);
  for (const std::filesystem::path& file : files)
    if (folders.insert(file.parent_path()).second)  // host.h: weights lie beside it
      visible.push_back(file.parent_path() / view::all_files);
  visible.insert(visible.end(), files.begin(), files.end());
  if (is_python_file(library.file)) {
    visible = {library.file.parent_path() / view::all_files};  // first: the environment may lie in it
    const VisiblePaths python = files_of_python();
    visible.insert(visible.end(), python.begin(), python.end());
  }
  visible.insert(visible.end(), library.visible.begin(), library.visible.end());
  return visible;
}

GuestOrder order_of(const GuestSetup& setup) {
  GuestOrder order = {is_python_file(setup.library) ? GuestOrder::Program::python : GuestOrder::Program::library,
                      {setup.written, setup.library.string(), setup.scratch.string()},
                      setup.visible,
                      {setup.memory.judge_descriptor, setup.memory.guest_descriptor}};
  for (const std::int64_t number :
       {setup.data_mb, std::int64_t{setup.processes}, std::int64_t{setup.plain_log_level},
        static_cast<std::int64_t>(setup.memory.address), static_cast<std::int64_t>(setup.memory.part_bytes)})
    order.arguments.push_back(std::to_string(number));
  if (setup.spool >= 0) order.descriptors.push_back(setup.spool);
  return order;
}

int run_guest(const std::vector<std::string>& arguments, const std::vector<int>& descriptors) {
  const auto number = [&](std::size_t index) { return std::stoll(arguments.at(index)); };
  GuestSetup setup;
  setup.written = arguments.at(0);
  setup.library = arguments.at(1);
  setup.scratch = arguments.at(2);
  setup.data_mb = number(3);
  setup.processes = number(4) != 0;
  setup.plain_log_level = static_cast<std::int32_t>(number(5));
  setup.memory = {descriptors.at(0), descriptors.at(1), static_cast<std::uintptr_t>(number(6)),
                  static_cast<std::size_t>(number(7))};
  if (descriptors.size() > 2) setup.spool = descriptors[2];
  std::unique_ptr<GuestMemory> memory;
  try {
    memory = std::make_unique<GuestMemory>(setup.memory);
  } catch (const std::runtime_error&) {
    return address_taken_exit;
  }
  if (setup.spool >= 0) fcntl(setup.spool, F_SETFD, FD_CLOEXEC);
  if (!setup.scratch.empty()) setenv("TMPDIR", setup.scratch.c_str(), 1);
  try {
    adopt_orphans();
    own_process::watch();
    set_resource_limits(setup.data_mb);
    watch_input(*memory);
    box::enter(setup.processes, &memory->note().refused, setup.scratch);
    serve(setup, *memory);
  } catch (const std::bad_alloc&) {
    _exit(out_of_memory_exit);
  }
  return 0;
}

}  // namespace dmrp::host
