// SPDX-License-Identifier: MIT
#include "host/guests/guest_process.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <signal.h>

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>

#include "host/errors/escaped_text.hpp"
#include "host/errors/machine_error.hpp"
#include "host/guests/inside/guest_program.hpp"
#include "host/plugins/calls/call_guard.hpp"
#include "host/process/box.hpp"
#include "host/process/orphans.hpp"
#include "host/process/resource_limits.hpp"
#include "host/results/whole_number.hpp"

namespace dmrp::host {

namespace {

constexpr std::int64_t check_interval_ns = 100'000'000;
constexpr std::int64_t second_ns = 1'000'000'000;
constexpr std::int64_t load_budget_ns = 20 * second_ns;
constexpr int address_attempts = 8;  // with other addresses

// The death of a guest interrupts the wait for its answer.
void interrupt_on_child_exit() {
  struct sigaction action {};
  action.sa_handler = [](int) {};
  action.sa_flags = SA_NOCLDSTOP;
  sigaction(SIGCHLD, &action, nullptr);
}

const char* known_kind(std::string_view text) {
  for (const char* kind :
       {fault_kind::out_of_memory, fault_kind::bad_output, fault_kind::abi_breach, fault_kind::error_status})
    if (text == kind) return kind;
  return fault_kind::abi_breach;
}

// A metric is asked for all steps at once.
std::int64_t step_of(const GuestRequest& request, std::int64_t said) {
  return request.task == GuestTask::measure ? std::max<std::int64_t>(said, 0) : request.step;
}

const char* name_of(GuestTask task) {
  static constexpr const char* names[] = {"init", "init",      "",        "create", "start",   "step",  "step",
                                          "plan", "trial_end", "observe", "",       "destroy", "deinit"};
  return names[static_cast<std::size_t>(task)];
}

}  // namespace

GuestProcess::GuestProcess(const ForkServer& fork_server, const LibraryUse& library, const GuestLimits& limits,
                           GuestTask first, int spool, const Started& started, const CheckLimits& check_limits)
    : fork_server_(fork_server),
      limits_(limits),
      counts_resident_(library.has_flag(DMRP_FLAG_RESIDENT_MEMORY | DMRP_FLAG_PROCESSES)),
      started_(started),
      check_limits_(check_limits),
      written_(library.written) {
  interrupt_on_child_exit();
  std::vector<std::unique_ptr<GuestMemory>> taken;  // it keeps its addresses until others are found
  for (int attempt = 0; attempt < address_attempts; ++attempt) {
    start(library, spool);
    try {
      loaded_ = call({first, 0, 0, load_budget_ns});
      return;
    } catch (const GuestEnd&) {
      if (process_->wait().exit_status != address_taken_exit || attempt + 1 == address_attempts) throw;
    }
    taken.push_back(std::move(memory_));
  }
}

void GuestProcess::start(const LibraryUse& library, int spool) {
  memory_ = std::make_unique<GuestMemory>();
  turn_ = 0;
  ended_ = false;
  set_memory(memory_->judge_arena(), memory_->output_arena());
  process_ = fork_server_.start(order_of(
      {library.written, library.file, box::has_view() ? view::scratch : limits_.scratch,
       library.has_flag(DMRP_FLAG_RESIDENT_MEMORY) ? 0 : limits_.memory_mb, library.has_flag(DMRP_FLAG_PROCESSES),
       limits_.plain_log_level, visible_paths_of(library), spool, memory_->place()}));
  started_(process_->number());
  allow_processor_time();
}

GuestProcess::~GuestProcess() = default;

// Allows what one trial may take.
void GuestProcess::allow_processor_time() {
  process_->allow_cpu(processor_time_s(limits_.trial_wall_time_s, limits_.sharers));
}

std::span<const std::uint8_t> GuestProcess::annotations() const {
  if (ended_) return {};
  const std::uint64_t bytes = memory_->guest().annotation_bytes;
  return {memory_->annotations(), std::min<std::uint64_t>(bytes, memory_->text_room())};
}

std::string_view GuestProcess::send(const GuestRequest& request, const AnswerQuestion& answer, std::string_view text) {
  if (request.task == GuestTask::begin_trial) allow_processor_time();
  if (request.task == GuestTask::create)
    instances_[request.instance] = nlohmann::json::parse(text).at("plugin").get<std::string>();
  memory_->judge().request = request;
  JudgePage& page = memory_->judge();
  page.text = text.data();
  page.text_bytes = text.size();
  call_number_ = 0;
  for (;;) {
    GuestMemory::give(page.turn, ++turn_);
    wait(request);
    const std::uint32_t kind = memory_->guest().kind;
    if (kind != GuestPage::question) return read_answer(request, kind);
    const GuestQuestion question = memory_->guest().asked;
    page.answer = answered(question, answer);
    if (is_time_to_check()) check_limits(request);
  }
}

// Not the guest's memory itself, which it can change while it is read.
std::string_view GuestProcess::read_answer(const GuestRequest& request, std::uint32_t kind) {
  const std::uint64_t bytes = std::min<std::uint64_t>(memory_->guest().text_bytes, memory_->text_room());
  answer_.assign(memory_->text(), bytes);
  if (kind == GuestPage::fault) fail(request);
  if (kind == GuestPage::failure) {
    const std::string text = escaped(answer_.c_str());
    throw std::runtime_error(written_.empty() ? text : written_ + ": " + text);
  }
  if (request.task == GuestTask::destroy) instances_.clear();
  if (is_time_to_check()) check_limits(request);
  return answer_;
}

void GuestProcess::wait(const GuestRequest& request) {
  const std::atomic<std::uint32_t>& turn = memory_->guest().turn;
  while (!GuestMemory::wait(turn, turn_ - 1, std::chrono::milliseconds(check_interval_ns / 1'000'000))) {
    pollfd watched = {process_->ended().number(), POLLIN, 0};
    if (poll(&watched, 1, 0) > 0) has_died(request);
    check_limits(request);
  }
  if (turn != turn_) end(request, {fault_kind::abi_breach, wrote_into_shared_memory});
}

bool GuestProcess::is_time_to_check() const {
  return monotonic_ns() - checked_ns_ > check_interval_ns;
}

void GuestProcess::check_limits(const GuestRequest& request) {
  watchdog_.look();
  checked_ns_ = monotonic_ns();
  if (const std::string why = check_limits_(); !why.empty()) end(request, {fault_kind::hang, why, 0, false, false});
  check_memory(request);
  check_call(request);
}

// A call hangs while the number of the calls stays the same, whatever the guest says of its beginning.
void GuestProcess::check_call(const GuestRequest& request) {
  const std::uint64_t number = memory_->note().call_number;
  const bool runs = number % 2 == 1;
  if (number != call_number_ || !runs) {
    call_number_ = number;
    call_ = {checked_ns_, process_->waited_for_processor_ns()};
    return;
  }
  const std::int64_t limit_ns = CallGuard::longest_ns(request.budget_ns);
  const std::int64_t elapsed_ns = watchdog_.elapsed_ns(call_.start_ns);
  if (!process_->is_late(elapsed_ns, call_.waited_before_ns, limit_ns)) return;
  end(request,
      {fault_kind::hang, fmt::format("did not return within {:.1f} s", static_cast<double>(elapsed_ns) / second_ns), 0,
       false, false});
}

// What the kernel's limit on data does not count: shared memory, or all where it does not fit the plugins or holds for each
// of several processes.
void GuestProcess::check_memory(const GuestRequest& request) {
  if (limits_.memory_mb == 0) return;
  const MemoryInUse used = process_->memory_in_use();
  const double host_mb = static_cast<double>(memory_->bytes_in_use()) / (1 << 20);
  const double counted_mb = (counts_resident_ ? used.resident_mb : used.shared_mb) - host_mb;
  if (counted_mb <= static_cast<double>(limits_.memory_mb)) return;
  end(request, {fault_kind::out_of_memory,
                fmt::format("{:.0f} MB {}in use, more than memory_mb = {}; when this is noticed depends on timing",
                            counted_mb, counts_resident_ ? "" : "of shared memory ", limits_.memory_mb)});
}

void GuestProcess::fail(const GuestRequest& request) {
  std::string kind, plugin, function, detail;
  std::int64_t step = 0;
  std::int32_t robot = -1;
  bool fatal = false;
  try {
    const nlohmann::json json = nlohmann::json::parse(answer_);
    json.at("kind").get_to(kind);
    json.at("plugin").get_to(plugin);
    json.at("function").get_to(function);
    json.at("detail").get_to(detail);
    step = whole_number<std::int64_t>(json.at("step"));
    robot = whole_number<std::int32_t>(json.at("robot"));
    json.at("fatal").get_to(fatal);
  } catch (const std::exception&) {  // no JSON, or not that of a fault
    end(request, {fault_kind::abi_breach, wrote_into_shared_memory});
  }
  if (kind == fault_kind::out_of_memory && limits_.memory_mb > 0)
    detail += fmt::format(" (memory_mb = {})", limits_.memory_mb);
  if (fatal) stop();
  throw PluginFault(known_kind(kind), {plugin_of(request, plugin), function.c_str(), step_of(request, step), robot},
                    detail, fatal);
}

// Its own plugin, if it says so: it has no other library's.
std::string_view GuestProcess::plugin_of(const GuestRequest& request, std::string_view said) const {
  if (said == written_ || said == "library") return said;
  for (const auto& [number, id] : instances_)
    if (id == said) return id;
  const auto instance = instances_.find(request.instance);
  return instance == instances_.end() ? std::string_view(written_) : instance->second;
}

double GuestProcess::end_process() {
  stop();
  return process_->wait().peak_rss_mb;
}

void GuestProcess::stop() {
  process_->kill();
  process_->wait();
  ended_ = true;
}

void GuestProcess::end(const GuestRequest& request, GuestEnd::Ending ending) {
  const NotedCall call = read_call(memory_->note());
  stop();
  std::string function = escaped(call.function.c_str());
  if (function.empty()) function = name_of(request.task);
  if (!call.inside && !call.function.empty())
    ending.detail = fmt::format("after {}() had returned: {}", function, ending.detail);
  throw GuestEnd(
      {plugin_of(request, call.plugin), function.c_str(), step_of(request, call.step), std::max(call.robot, -1)},
      ending);
}

void GuestProcess::has_died(const GuestRequest& request) {
  const ProcessEnding& ending = process_->wait();
  const NotedCall call = read_call(memory_->note());
  GuestEnd::Ending out = {ending.fault_kind(),        "",   ending.signal,
                          ending.killed_from_outside, true, ending.explain(limits_.memory_mb)};
  if (memory_->guest().wrote_into_input != 0)
    out = {fault_kind::abi_breach, "wrote into what it may only read", ending.signal};
  else if (ending.killed_from_outside)
    out.detail = "killed by SIGKILL from outside";
  else if (ending.signal == SIGSYS)
    out.detail = fmt::format("the box refuses {}", box::name_of(call.refused));
  else if (ending.signal == SIGXCPU)
    out.detail = fmt::format("more than {:.3g} s of processor time", ending.cpu_limit_s);
  else if (ending.signal != 0)
    out.detail = strsignal(ending.signal);
  else if (ending.exit_status == out_of_memory_exit)
    out.detail = fmt::format("{} (memory_mb = {})", lack_of_memory(limits_.memory_mb), limits_.memory_mb);
  else
    out.detail = fmt::format("the process ended with status {}", ending.exit_status);
  end(request, std::move(out));
}

}  // namespace dmrp::host
