// SPDX-License-Identifier: MIT
#include "host/process/box.hpp"

#include <fmt/format.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sched.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <vector>

#include "host/process/landlock.hpp"
#include "host/process/sanitized.hpp"

namespace dmrp::host::box {

namespace {

#if defined(__x86_64__)
constexpr std::uint32_t architecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr std::uint32_t architecture = AUDIT_ARCH_AARCH64;
#else
constexpr std::uint32_t architecture = 0;  // no filter
#endif

constexpr const char* off_variable = "DMRP_NO_BOX";       // children inherit it
constexpr const char* sandbox_variable = "DMRP_SANDBOX";  // likewise
constexpr rlim_t most_descriptors = 4096;
constexpr rlim_t most_file_bytes = rlim_t{1} << 36;  // traces of a night are smaller

struct Call {
  std::uint32_t number;
  const char* name;
};

// Refused, whatever their arguments.
constexpr std::array always_refused = {
    Call{SYS_ptrace, "ptrace"},
    Call{SYS_process_vm_readv, "process_vm_readv"},
    Call{SYS_process_vm_writev, "process_vm_writev"},
    Call{SYS_pidfd_getfd, "pidfd_getfd"},
    Call{SYS_setrlimit, "setrlimit"},
    Call{SYS_unshare, "unshare"},
    Call{SYS_setns, "setns"},
    Call{SYS_setsid, "setsid"},
    Call{SYS_setpgid, "setpgid"},
};

// Refused unless plugins may start processes.
constexpr std::array starts_programs = {
#if defined(__x86_64__)
    Call{SYS_fork, "fork"},
    Call{SYS_vfork, "vfork"},
#endif
    Call{SYS_execve, "execve"},
    Call{SYS_execveat, "execveat"},
    Call{SYS_rt_sigqueueinfo, "rt_sigqueueinfo"},
    Call{SYS_rt_tgsigqueueinfo, "rt_tgsigqueueinfo"},
    Call{SYS_pidfd_send_signal, "pidfd_send_signal"},
};
// Likewise, unless they are for this process.
constexpr std::array sends_signals = {Call{SYS_kill, "kill"}, Call{SYS_tkill, "tkill"}, Call{SYS_tgkill, "tgkill"}};

// A sandbox answers these with an error. io_uring opens sockets, too.
constexpr std::array opens_sockets = {Call{SYS_socket, "socket"}, Call{SYS_io_uring_setup, "io_uring_setup"}};
// Likewise; Landlock does not cover modes, owners, times and attributes of files.
constexpr std::array changes_attributes = {
#if defined(__x86_64__)
    Call{SYS_chmod, "chmod"},
    Call{SYS_chown, "chown"},
    Call{SYS_lchown, "lchown"},
    Call{SYS_utime, "utime"},
    Call{SYS_utimes, "utimes"},
    Call{SYS_futimesat, "futimesat"},
#endif
    Call{SYS_fchmod, "fchmod"},
    Call{SYS_fchmodat, "fchmodat"},
    Call{452, "fchmodat2"},  // older headers do not name it
    Call{SYS_fchown, "fchown"},
    Call{SYS_fchownat, "fchownat"},
    Call{SYS_utimensat, "utimensat"},
    Call{SYS_setxattr, "setxattr"},
    Call{SYS_lsetxattr, "lsetxattr"},
    Call{SYS_fsetxattr, "fsetxattr"},
    Call{SYS_removexattr, "removexattr"},
    Call{SYS_lremovexattr, "lremovexattr"},
    Call{SYS_fremovexattr, "fremovexattr"},
};

constexpr Call clone_call = {SYS_clone, "fork (clone)"};
constexpr Call limit_call = {SYS_prlimit64, "prlimit64"};
constexpr Call process_call = {SYS_prctl, "prctl"};

std::atomic<std::int32_t>* refused_call = nullptr;

// A program for the kernel: instructions that begin with the number of a system call, and end with an answer.
class Filter {
 public:
  Filter() {
    load(offsetof(seccomp_data, arch));
    add(BPF_JMP | BPF_JEQ | BPF_K, architecture, 1, 0);
    answer(SECCOMP_RET_TRAP);
    load_number();
#if defined(__x86_64__)
    constexpr std::uint32_t x32 = 0x40000000;
    add(BPF_JMP | BPF_JGE | BPF_K, x32, 0, 1);
    answer(SECCOMP_RET_TRAP);
#endif
  }

  void refuse(const Call& call) {
    if_number(call, {{BPF_RET | BPF_K, 0, 0, SECCOMP_RET_TRAP}});
  }

  // The kernel answers with this error.
  void deny(const Call& call, std::uint32_t error) {
    if_number(call, {{BPF_RET | BPF_K, 0, 0, SECCOMP_RET_ERRNO | (error & SECCOMP_RET_DATA)}});
  }

  // Refused unless the lower half of an argument is this value.
  void allow_only(const Call& call, unsigned argument, std::uint32_t value) {
    if_number(call, {{BPF_LD | BPF_W | BPF_ABS, 0, 0, argument_at(argument)},
                     {BPF_JMP | BPF_JEQ | BPF_K, 1, 0, value},
                     {BPF_RET | BPF_K, 0, 0, SECCOMP_RET_TRAP},
                     {BPF_RET | BPF_K, 0, 0, SECCOMP_RET_ALLOW}});
  }

  // Refused if it is this value.
  void refuse_value(const Call& call, unsigned argument, std::uint32_t value) {
    if_number(call, {{BPF_LD | BPF_W | BPF_ABS, 0, 0, argument_at(argument)},
                     {BPF_JMP | BPF_JEQ | BPF_K, 0, 1, value},
                     {BPF_RET | BPF_K, 0, 0, SECCOMP_RET_TRAP},
                     {BPF_RET | BPF_K, 0, 0, SECCOMP_RET_ALLOW}});
  }

  // Refused unless the argument has this bit.
  void need_bit(const Call& call, unsigned argument, std::uint32_t bit) {
    if_number(call, {{BPF_LD | BPF_W | BPF_ABS, 0, 0, argument_at(argument)},
                     {BPF_JMP | BPF_JSET | BPF_K, 1, 0, bit},
                     {BPF_RET | BPF_K, 0, 0, SECCOMP_RET_TRAP},
                     {BPF_RET | BPF_K, 0, 0, SECCOMP_RET_ALLOW}});
  }

  // Refused with EPERM unless a pointer is null: runtimes raise their limits where they may.
  void deny_pointer(const Call& call, unsigned argument) {
    constexpr std::uint32_t denied = SECCOMP_RET_ERRNO | (EPERM & SECCOMP_RET_DATA);
    if_number(call, {{BPF_LD | BPF_W | BPF_ABS, 0, 0, argument_at(argument)},
                     {BPF_JMP | BPF_JEQ | BPF_K, 0, 2, 0},
                     {BPF_LD | BPF_W | BPF_ABS, 0, 0, argument_at(argument) + 4},
                     {BPF_JMP | BPF_JEQ | BPF_K, 1, 0, 0},
                     {BPF_RET | BPF_K, 0, 0, denied},
                     {BPF_RET | BPF_K, 0, 0, SECCOMP_RET_ALLOW}});
  }

  // For all threads of the process.
  bool install() {
    answer(SECCOMP_RET_ALLOW);
    const sock_fprog program = {static_cast<unsigned short>(code_.size()), code_.data()};
    // without SPEC_ALLOW, older kernels make the whole process slower
    return syscall(SYS_seccomp, SECCOMP_SET_MODE_FILTER, SECCOMP_FILTER_FLAG_SPEC_ALLOW | SECCOMP_FILTER_FLAG_TSYNC,
                   &program) == 0;
  }

 private:
  static std::uint32_t argument_at(unsigned index) {
    return static_cast<std::uint32_t>(offsetof(seccomp_data, args) + index * sizeof(std::uint64_t));
  }
  void add(unsigned code, std::uint32_t value, std::uint8_t if_true = 0, std::uint8_t if_false = 0) {
    code_.push_back({static_cast<std::uint16_t>(code), if_true, if_false, value});
  }
  void load(std::size_t offset) {
    add(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(offset));
  }
  void load_number() {
    load(offsetof(seccomp_data, nr));
  }
  void answer(std::uint32_t value) {
    add(BPF_RET | BPF_K, value);
  }
  void if_number(const Call& call, std::initializer_list<sock_filter> then) {
    add(BPF_JMP | BPF_JEQ | BPF_K, call.number, 0, static_cast<std::uint8_t>(then.size()));
    code_.insert(code_.end(), then);
  }

  std::vector<sock_filter> code_;
};

bool is_sandbox() {
  return std::getenv(sandbox_variable) != nullptr;
}

bool install_filter(bool processes_allowed) {
  const auto self = static_cast<std::uint32_t>(getpid());
  Filter filter;
  for (const Call& call : always_refused) filter.refuse(call);
  filter.deny_pointer(limit_call, 2);
  filter.refuse_value(process_call, 0, PR_SET_PDEATHSIG);
  if (!processes_allowed) {
    for (const Call& call : starts_programs) filter.refuse(call);
    for (const Call& call : sends_signals) filter.allow_only(call, 0, self);
    filter.need_bit(clone_call, 0, CLONE_THREAD);
    // the C library then uses clone(), whose arguments can be seen
    filter.deny({SYS_clone3, "clone3"}, ENOSYS);
  }
  if (is_sandbox()) {
    for (const Call& call : opens_sockets) filter.deny(call, EACCES);
    for (const Call& call : changes_attributes) filter.deny(call, EPERM);
  }
  return filter.install();
}

// Async-signal-safe. The kernel has not executed the call.
void note_refusal(int number, siginfo_t* info, void*) {
  if (refused_call) *refused_call = info->si_syscall;
  signal(number, SIG_DFL);
  raise(number);
}

void lower_limit(__rlimit_resource resource, rlim_t most) {
  rlimit limit{};
  getrlimit(resource, &limit);  // a tighter one stays
  limit.rlim_max = std::min(limit.rlim_max, most);
  limit.rlim_cur = std::min(limit.rlim_cur, limit.rlim_max);
  setrlimit(resource, &limit);
}

}  // namespace

void disable() {
  setenv(off_variable, "1", 1);
}

void demand_sandbox() {
  setenv(sandbox_variable, "1", 1);
}

std::string gaps() {
  if (sanitizer_is_loaded() || std::getenv(off_variable)) return "";
  if (architecture == 0 || prctl(PR_GET_SECCOMP) < 0)
    return "plugins can start and reach other processes: the kernel has no seccomp filters for this processor";
  return "";
}

std::string sandbox_gaps() {
  if (!is_sandbox()) return "";
  if (sanitizer_is_loaded()) return "plugins are in no sandbox: sanitizers exclude it";
  return landlock::gap(landlock::version());
}

std::string kind() {
  if (sanitizer_is_loaded() || std::getenv(off_variable)) return "none";
  return is_sandbox() ? "sandbox" : "box";
}

void enter(bool processes_allowed, std::atomic<std::int32_t>* refused, const std::filesystem::path& scratch) {
  if (sanitizer_is_loaded() || std::getenv(off_variable)) return;
  lower_limit(RLIMIT_NOFILE, most_descriptors);
  lower_limit(RLIMIT_FSIZE, most_file_bytes);
  refused_call = refused;
  struct sigaction action {};
  action.sa_sigaction = &note_refusal;
  action.sa_flags = SA_SIGINFO | SA_NODEFER;
  sigaction(SIGSYS, &action, nullptr);
  prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  if (is_sandbox()) landlock::restrict_writing(scratch);
  if constexpr (architecture != 0) install_filter(processes_allowed);
}

std::string name_of(std::int32_t system_call) {
  if (system_call == 0) return "a system call with signals blocked (as by system() or popen())";
  const auto find = [&](const auto& calls) -> const char* {
    for (const Call& call : calls)
      if (call.number == static_cast<std::uint32_t>(system_call)) return call.name;
    return nullptr;
  };
  for (const char* name : {find(always_refused), find(starts_programs), find(sends_signals),
                           find(std::array{clone_call, limit_call, process_call})})
    if (name) return name;
  return fmt::format("system call {}", system_call);
}

}  // namespace dmrp::host::box
