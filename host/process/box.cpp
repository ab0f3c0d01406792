// SPDX-License-Identifier: MIT
#include "host/process/box.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/sockios.h>
#include <sched.h>
#include <seccomp.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <initializer_list>
#include <memory>

#include "host/errors/machine_error.hpp"
#include "host/process/descriptor.hpp"
#include "host/process/environment.hpp"
#include "host/process/landlock.hpp"
#include "host/process/sanitized.hpp"

namespace dmrp::host::box {

namespace {

constexpr const char* off_variable = "DMRP_NO_BOX";  // children inherit it
constexpr rlim_t most_descriptors = 4096;
constexpr rlim_t most_file_bytes = rlim_t{1} << 36;  // traces of a night are smaller

std::atomic<std::int32_t>* refused_call = nullptr;

// Compares an argument that is an int to the kernel, which drops the upper half.
scmp_arg_cmp is(unsigned argument, std::uint32_t value) {
  return {argument, SCMP_CMP_MASKED_EQ, 0xffffffff, value};
}

scmp_arg_cmp is_not(unsigned argument, std::uint64_t value) {
  return {argument, SCMP_CMP_NE, value, 0};
}

scmp_arg_cmp has(unsigned argument, std::uint64_t bit) {
  return {argument, SCMP_CMP_MASKED_EQ, bit, bit};
}

scmp_arg_cmp lacks(unsigned argument, std::uint64_t bit) {
  return {argument, SCMP_CMP_MASKED_EQ, bit, 0};
}

// What the kernel refuses; the rest it allows. A call that a processor lacks needs no rule, and gets none.
class Filter {
 public:
  Filter() : rules_(seccomp_init(SCMP_ACT_ALLOW), &seccomp_release) {
    if (!rules_) throw MachineError("seccomp", ENOMEM);
    set(SCMP_FLTATR_ACT_BADARCH, SCMP_ACT_TRAP);
    set(SCMP_FLTATR_CTL_TSYNC, 1);  // for all threads
    set(SCMP_FLTATR_CTL_SSB, 1);    // without it, older kernels make the whole process slower
  }

  void add(std::uint32_t answer, std::initializer_list<int> calls,
           std::initializer_list<scmp_arg_cmp> conditions = {}) {
    for (const int call : calls)
      check(seccomp_rule_add_array(rules_.get(), answer, call, static_cast<unsigned>(conditions.size()),
                                   conditions.begin()));
  }

  void load() { check(seccomp_load(rules_.get())); }

 private:
  void set(scmp_filter_attr attribute, std::uint32_t value) { check(seccomp_attr_set(rules_.get(), attribute, value)); }
  static void check(int result) {
    if (result != 0) throw MachineError("seccomp", -result);
  }

  std::unique_ptr<void, void (*)(scmp_filter_ctx)> rules_;
};

bool is_on() {
  return !sanitizer_is_loaded() && !std::getenv(off_variable);
}

bool has_filters() {
  return prctl(PR_GET_SECCOMP) >= 0;
}

void refuse_reaching_others(Filter& filter) {
  filter.add(SCMP_ACT_TRAP,
             {SCMP_SYS(ptrace), SCMP_SYS(process_vm_readv), SCMP_SYS(process_vm_writev), SCMP_SYS(pidfd_getfd),
              SCMP_SYS(setrlimit), SCMP_SYS(unshare), SCMP_SYS(setns), SCMP_SYS(setsid), SCMP_SYS(setpgid)});
  for (const int what : {PR_SET_PDEATHSIG, PR_SET_DUMPABLE})
    filter.add(SCMP_ACT_TRAP, {SCMP_SYS(prctl)}, {is(0, static_cast<std::uint32_t>(what))});
  // runtimes raise their limits where they may
  filter.add(SCMP_ACT_ERRNO(EPERM), {SCMP_SYS(prlimit64)}, {is_not(2, 0)});
  // keys for a terminal; a signal to the owner of a file
  for (const std::uint32_t request : {TIOCSTI, TIOCLINUX, FIOSETOWN, SIOCSPGRP})
    filter.add(SCMP_ACT_ERRNO(EPERM), {SCMP_SYS(ioctl)}, {is(1, request)});
  for (const std::uint32_t command : {F_SETOWN, F_SETOWN_EX, F_SETSIG})
    filter.add(SCMP_ACT_ERRNO(EPERM), {SCMP_SYS(fcntl)}, {is(1, command)});
  // with one, a process would have capabilities
  filter.add(SCMP_ACT_ERRNO(EPERM), {SCMP_SYS(clone)}, {has(0, CLONE_NEWUSER)});
  // the C library then uses clone(), whose arguments can be seen
  filter.add(SCMP_ACT_ERRNO(ENOSYS), {SCMP_SYS(clone3)});
  // memory that no limit counts, or that other processes of the user share
  filter.add(
      SCMP_ACT_ERRNO(EPERM),
      {SCMP_SYS(shmget), SCMP_SYS(shmat), SCMP_SYS(shmctl), SCMP_SYS(msgget), SCMP_SYS(msgsnd), SCMP_SYS(msgrcv),
       SCMP_SYS(msgctl), SCMP_SYS(semget), SCMP_SYS(semop), SCMP_SYS(semtimedop), SCMP_SYS(semctl), SCMP_SYS(add_key),
       SCMP_SYS(request_key), SCMP_SYS(keyctl), SCMP_SYS(userfaultfd), SCMP_SYS(memfd_create)});
  // no filter sees what a ring asks for; libraries then do without
  filter.add(SCMP_ACT_ERRNO(ENOSYS), {SCMP_SYS(io_uring_setup), SCMP_SYS(io_uring_enter), SCMP_SYS(io_uring_register)});
}

void refuse_processes(Filter& filter) {
  filter.add(SCMP_ACT_TRAP, {SCMP_SYS(fork), SCMP_SYS(vfork), SCMP_SYS(execve), SCMP_SYS(execveat),
                             SCMP_SYS(rt_sigqueueinfo), SCMP_SYS(rt_tgsigqueueinfo), SCMP_SYS(pidfd_send_signal)});
  filter.add(SCMP_ACT_TRAP, {SCMP_SYS(kill), SCMP_SYS(tkill), SCMP_SYS(tgkill)},
             {is_not(0, static_cast<std::uint64_t>(getpid()))});
  filter.add(SCMP_ACT_TRAP, {SCMP_SYS(clone)}, {lacks(0, CLONE_THREAD)});
}

void install_filter(bool processes_allowed) {
  Filter filter;
  refuse_reaching_others(filter);
  if (!processes_allowed) refuse_processes(filter);
  filter.load();
}

// Not by setsid(): a kernel that schedules sessions as groups would then forget the priority of the run.
void leave_terminal() {
  const Descriptor terminal(open("/dev/tty", O_RDWR | O_NOCTTY | O_CLOEXEC));
  if (terminal.is_open()) ioctl(terminal.number(), TIOCNOTTY);
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

std::string gaps() {
  if (!is_on()) return "";
  if (!has_filters()) return "plugins can start and reach other processes: the kernel has no seccomp filters";
  if (geteuid() == 0 && !landlock::sets_apart(landlock::version()))
    return "plugins can change the memory of your other processes: you are root, and the kernel's Landlock does not "
           "refuse it";
  if (const std::string why = view::gap(); !why.empty())
    return "plugins can read and change your files, and reach the network (" + why +
           "): allow user namespaces (docs/attacks.md says how), or run none that you do not trust";
  return "";
}

std::string kind() {
  if (!is_on()) return "none";
  return has_view() ? "namespaces" : "calls";
}

bool has_view() {
  return is_on() && view::gap().empty();
}

void hide() {
  // a second time, the filter would refuse it
  if (is_on() && prctl(PR_GET_DUMPABLE) != 0) prctl(PR_SET_DUMPABLE, 0);
}

void enter(bool processes_allowed, std::atomic<std::int32_t>* refused, const std::filesystem::path& scratch) {
  if (!is_on()) return;
  lower_limit(RLIMIT_NOFILE, most_descriptors);
  lower_limit(RLIMIT_FSIZE, most_file_bytes);
  refused_call = refused;
  struct sigaction action {};
  action.sa_sigaction = &note_refusal;
  action.sa_flags = SA_SIGINFO | SA_NODEFER;
  sigaction(SIGSYS, &action, nullptr);
  reduce_environment(scratch);
  leave_terminal();
  hide();
  landlock::set_apart();
  if (has_filters()) install_filter(processes_allowed);
}

std::string name_of(std::int32_t system_call) {
  if (system_call == 0) return "a system call with signals blocked (as by system() or popen())";
  if (system_call == SCMP_SYS(clone)) return "fork (clone)";
  const std::unique_ptr<char, void (*)(void*)> name(seccomp_syscall_resolve_num_arch(SCMP_ARCH_NATIVE, system_call),
                                                    &std::free);
  return name ? name.get() : fmt::format("system call {}", system_call);
}

}  // namespace dmrp::host::box
