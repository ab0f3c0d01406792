// SPDX-License-Identifier: MIT
#include "host/evaluate/measure_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <system_error>

#include "core/trace/trace_reader.hpp"
#include "host/plugins/call_note.hpp"
#include "host/trial/measure.hpp"
#include "host/workers/line_channel.hpp"
#include "host/workers/resource_limits.hpp"

namespace dmrp::host {

namespace {

constexpr int poll_interval_ms = 100;
constexpr std::int64_t second_ns = 1'000'000'000;

// The next thing to do: a metric of a trial.
struct Position {
  std::size_t trial = 0;
  std::uint32_t metric = 0;
};

[[noreturn]] void fail(const char* what) {
  throw std::system_error(errno, std::generic_category(), what);
}

// "org.example.metric: observe(): what happened"
std::string detail_of(const std::string& plugin, const std::string& function, const std::string& text) {
  return fmt::format("{}: {}(): {}", plugin, function, text);
}

void log_line(std::int32_t level, const std::string& plugin, const std::string& text) {
  if (level >= DMRP_LOG_WARNING) std::fprintf(stderr, "%s: %s\n", plugin.c_str(), text.c_str());
}

// In the child: says where it is, then what came of it. Messages of one run through:
//   {"at": [trial, metric or null]}   metric null: its trace is being read
//   {"result": MetricResult} | {"failure": text}, of what the last "at" named
//   {"error": text}                    nothing can be measured
class Measurer {
 public:
  Measurer(const Evaluation& evaluation, const std::vector<StoredTrial>& trials, CallNote& note, LineChannel& channel)
      : evaluation_(evaluation),
        trials_(trials),
        channel_(channel),
        guard_(note),
        pool_(evaluation.libraries, guard_, &log_line) {}

  void measure_from(Position position) {
    for (; position.trial < trials_.size(); position = {position.trial + 1, 0})
      measure_trial(position.trial, position.metric);
  }

 private:
  void measure_trial(std::size_t index, std::uint32_t first_metric) {
    const StoredTrial& trial = trials_[index];
    channel_.send({{"at", {index, nullptr}}});
    try {
      core::TraceReader reader(core::TraceRecords(trial.trace), core::TraceExtent::samples);
      if (!reader.end()) throw std::runtime_error("was cut short: it has no end");
      for (std::uint32_t i = first_metric; i < evaluation_.metrics.size(); ++i) {
        channel_.send({{"at", {index, i}}});
        measure_metric(reader, i, trial.seed);
      }
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      tell(fmt::format("{}: {}", trial.trace.string(), error.what()));
    }
  }

  void measure_metric(core::TraceReader& reader, std::uint32_t index, std::uint64_t seed) {
    const PluginUse& use = evaluation_.metrics[index];
    try {
      channel_.send({{"result", measure(reader, pool_.get(use, -1), use.info, index, seed,
                                        static_cast<std::int64_t>(evaluation_.limits.step_time_s * 1e9))}});
    } catch (const PluginFault& fault) {
      tell(detail_of(fault.plugin(), fault.function(), fault.what()));
      if (fault.fatal()) _exit(0);  // no function of the library may be called again: another process goes on
    }
  }

  void tell(const std::string& failure) { channel_.send({{"failure", failure}}); }

  const Evaluation& evaluation_;
  const std::vector<StoredTrial>& trials_;
  LineChannel& channel_;
  CallGuard guard_;
  InstancePool pool_;
};

// Never returns into the parent's code, not by an exception either.
[[noreturn]] void become_measurer(const Evaluation& evaluation, const std::vector<StoredTrial>& trials,
                                  Position position, CallNote& note, int write_end, pid_t parent) noexcept {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(127);
  dup2(open("/dev/null", O_RDONLY | O_CLOEXEC), STDIN_FILENO);
  dup2(STDERR_FILENO, STDOUT_FILENO);  // what a plugin prints shall not end up among the values
  set_resource_limits(evaluation.limits.memory_mb);
  LineChannel channel(-1, write_end);
  try {
    Measurer(evaluation, trials, note, channel).measure_from(position);
    channel.send({{"finished", true}});
  } catch (const std::bad_alloc&) {
    _exit(out_of_memory_exit);
  } catch (const PluginFault& fault) {
    channel.send({{"error", detail_of(fault.plugin(), fault.function(), fault.what())}});
  } catch (const std::exception& error) {
    channel.send({{"error", error.what()}});
  }
  std::fflush(stderr);
  // not exit(): static objects of a stranger's library are nobody's business any more
  _exit(0);
}

// In the parent: one child, from a position on.
class Child {
 public:
  Child(const Evaluation& evaluation, const std::vector<StoredTrial>& trials, Position position) : note_(*new_note()) {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) fail("pipe");
    std::fflush(nullptr);  // what is buffered would be written twice
    const pid_t parent = getpid();
    pid_ = fork();
    if (pid_ < 0) fail("fork");
    if (pid_ == 0) {
      close(ends[0]);
      become_measurer(evaluation, trials, position, note_, ends[1], parent);
    }
    close(ends[1]);
    channel_ = std::make_unique<LineChannel>(ends[0], -1);
  }
  ~Child() {
    kill();
    wait();
    munmap(&note_, sizeof(CallNote));
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  // The next message; nothing when it has ended, or was ended for a call that took too long.
  std::optional<nlohmann::json> receive() {
    for (;;) {
      if (auto message = channel_->take()) {
        broken_ = !message->is_object();
        return broken_ ? std::nullopt : message;
      }
      pollfd watched = {channel_->read_end(), POLLIN, 0};
      const std::int64_t before_ns = monotonic_ns();
      const int ready = poll(&watched, 1, poll_interval_ms);
      // a terminal's Ctrl-Z stops both: the time until they go on is nobody's hang
      if (monotonic_ns() - before_ns > second_ns) awake_since_ns_ = monotonic_ns();
      if (ready > 0) {
        if (!channel_->fill()) return std::nullopt;
      } else if (is_hanging()) {
        return std::nullopt;
      }
    }
  }

  // Why it ended before its time, with the name of the plugin function if it was in one.
  std::string explain(std::int64_t memory_mb) {
    const bool hung = is_hanging();
    const NotedCall call = noted_call(note_);
    if (hung || broken_) kill();
    const int status = wait();
    std::string text;
    if (hung)
      text = "did not return, and was killed";
    else if (broken_)
      text = "sent what is no message, and was killed";
    else if (WIFSIGNALED(status))
      text = fmt::format("crashed (signal {}, {})", WTERMSIG(status), strsignal(WTERMSIG(status)));
    else if (WEXITSTATUS(status) == out_of_memory_exit)
      text = fmt::format("needs more than {} MB of memory", memory_mb);
    else
      text = fmt::format("ended the process with status {}", WEXITSTATUS(status));
    return call.inside ? detail_of(call.plugin, call.function, text) : "the measuring process: " + text;
  }

 private:
  static CallNote* new_note() {
    void* memory = mmap(nullptr, sizeof(CallNote), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) fail("mmap");
    return static_cast<CallNote*>(memory);
  }

  // The note is only believed where it is possible.
  bool is_hanging() const {
    const NotedCall call = noted_call(note_);
    return call.inside && call.limit_ns > 0 &&
           monotonic_ns() - std::max(call.start_ns, awake_since_ns_) > call.limit_ns;
  }

  // Until it has been waited for, the number is its own.
  void kill() const {
    if (pid_ > 0) ::kill(pid_, SIGKILL);
  }

  int wait() {
    if (pid_ <= 0) return status_;
    while (waitpid(pid_, &status_, 0) < 0 && errno == EINTR) {
    }
    pid_ = -1;
    return status_;
  }

  CallNote& note_;
  pid_t pid_ = -1;
  int status_ = 0;
  bool broken_ = false;  // it sent what is no message
  std::int64_t awake_since_ns_ = 0;
  std::unique_ptr<LineChannel> channel_;
};

// Measures from `position` on until all is done or the child ends; then `position` is where to go on.
void measure_some(const Evaluation& evaluation, const std::vector<StoredTrial>& trials, const MeasureSinks& sinks,
                  Position& position) {
  Child child(evaluation, trials, position);
  bool told = true;  // what came of the metric at which it is
  bool began = false;
  bool reading = false;
  while (const auto message = child.receive()) {
    if (message->contains("error")) throw std::runtime_error(message->at("error").get<std::string>());
    if (message->contains("finished")) {
      position = {trials.size(), 0};
      return;
    }
    if (message->contains("at")) {
      const auto& at = message->at("at");
      reading = at.at(1).is_null();
      position = {at.at(0).get<std::size_t>(), reading ? 0 : at.at(1).get<std::uint32_t>()};
      began = true;
      told = false;
      continue;
    }
    if (message->contains("result"))
      sinks.result(trials.at(position.trial), message->at("result").get<MetricResult>());
    else
      sinks.failure(trials.at(position.trial), message->at("failure").get<std::string>());
    told = true;
  }
  const std::string reason = child.explain(evaluation.limits.memory_mb);
  if (!began) throw std::runtime_error(reason);
  if (!told) sinks.failure(trials.at(position.trial), reason);
  position = reading ? Position{position.trial + 1, 0} : Position{position.trial, position.metric + 1};
}

}  // namespace

void measure_stored(const Evaluation& evaluation, const std::vector<StoredTrial>& trials, const MeasureSinks& sinks) {
  Position position;
  while (position.trial < trials.size()) measure_some(evaluation, trials, sinks, position);
}

}  // namespace dmrp::host
