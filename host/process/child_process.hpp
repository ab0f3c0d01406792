// SPDX-License-Identifier: MIT
// child_process.hpp: starts, stops and explains the processes that run plugins.
//
// A child reads from /dev/null, and is killed when its parent ends. A plugin that crashes, hangs or takes all memory
// ends its child only. When memory is short, the kernel kills children before their parent.
#pragma once

#include <sys/types.h>
#include <unistd.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "host/process/descriptor.hpp"
#include "host/process/fault_kind.hpp"

namespace dmrp::host {

// Exit status of a child that ran out of memory outside a plugin call.
inline constexpr int out_of_memory_exit = 86;

// How a child ended.
struct ProcessEnding {
  int signal = 0;                    // that killed it; 0: it exited
  int exit_status = 0;               // if it exited
  bool killed_from_outside = false;  // by SIGKILL, and not by kill(): the kernel, when memory is short, or a person
  double peak_rss_mb = 0.0;
  double cpu_limit_s = 0.0;  // the last of allow_cpu(); 0: none

  bool succeeded() const { return signal == 0 && exit_status == 0; }

  // Of the plugin that ended the process: hang, crash, out_of_memory, abi_breach or exit.
  const char* fault_kind() const;

  // "crashed (signal 11, Segmentation fault)", "needs more than 400 MB of memory" or "ended the process with status 0".
  std::string explain(std::int64_t memory_mb) const;
};

// Of a process and of those that it started, in MB. Pages that two of them share count twice.
struct MemoryInUse {
  double resident_mb = 0.0;
  double shared_mb = 0.0;  // of that, what no limit on data counts: what others may share, without files
};

// Whether something has taken longer than the limit, of which it waited for a processor so long. That does not count, up to
// 20 times the limit: other programs may load the machine.
bool is_late(std::int64_t elapsed_ns, std::int64_t waited_ns, std::int64_t limit_ns);

// How long the main thread of a process has waited for a processor while others used all; 0 where the kernel does not count
// it.
std::int64_t waited_for_processor_ns(pid_t process);

// In a child, before it does anything else: it reads from /dev/null, and is killed first when memory is short.
void be_child();

class ChildProcess {
 public:
  struct Program {
    std::vector<std::string> arguments;  // of dmrp-host
    std::vector<int> inherited;          // descriptors that the program keeps; it inherits no other
    int output = STDERR_FILENO;          // for its standard output and standard error
    bool ignores_terminal = false;       // Ctrl-C and the like, which reach all processes of a terminal
  };

  // Starts dmrp-host again. Throws MachineError.
  static ChildProcess execute(const Program& program);

  // A child that this process has already. Throws MachineError.
  static std::unique_ptr<ChildProcess> adopt(pid_t number);

  ~ChildProcess();  // kills it
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  // The memory that it and its descendants have in use now; nothing once it has been waited for.
  MemoryInUse memory_in_use() const;

  std::int64_t waited_for_processor_ns() const { return pid_ < 0 ? 0 : host::waited_for_processor_ns(pid_); }

  // Whether it has taken longer than the limit for what began `elapsed_ns` ago, when it had waited for `waited_before_ns`.
  // On a loaded machine it waits for a processor: that does not count, up to 20 times the limit.
  bool is_late(std::int64_t elapsed_ns, std::int64_t waited_before_ns, std::int64_t limit_ns) const;

  // From now on, it and each process that it starts may take so many seconds of processor time; then the kernel kills it with
  // SIGXCPU.
  void allow_cpu(double s);

  // Readable once the process has ended.
  const Descriptor& ended() const { return ended_; }

  void kill();

  // Its number; -1 once it has been waited for.
  pid_t number() const { return pid_; }

  // Waits for its end. Call it as often as you like.
  const ProcessEnding& wait();

 private:
  explicit ChildProcess(pid_t number);

  pid_t pid_ = -1;  // -1: it has been waited for
  Descriptor ended_;
  bool killed_ = false;
  ProcessEnding ending_;
};

}  // namespace dmrp::host
