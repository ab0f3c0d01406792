// SPDX-License-Identifier: MIT
#include "host/guests/nursery.hpp"

#include <fcntl.h>
#include <sched.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

#include "host/errors/machine_error.hpp"
#include "host/process/box.hpp"
#include "host/process/orphans.hpp"
#include "host/program/executable.hpp"

namespace dmrp::host {

namespace {

constexpr std::size_t most_bytes = 65536;  // of a setup: its paths
constexpr std::size_t most_descriptors = 3;

// What the nursery is sent: the setup's texts, each with a NUL, and its descriptors.
struct Order {
  std::vector<std::string> arguments;
  std::vector<int> descriptors;
};

void send_order(int socket, const GuestSetup& setup) {
  std::string text;
  for (const std::string& argument : arguments_of(setup)) text += argument + '\0';
  std::vector<int> descriptors = {setup.memory.judge_descriptor, setup.memory.guest_descriptor};
  if (setup.spool >= 0) descriptors.push_back(setup.spool);
  iovec bytes = {text.data(), text.size()};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(most_descriptors * sizeof(int))> control{};
  msghdr message{};
  message.msg_iov = &bytes;
  message.msg_iovlen = 1;
  message.msg_control = control.data();
  message.msg_controllen = CMSG_SPACE(descriptors.size() * sizeof(int));
  cmsghdr* const header = CMSG_FIRSTHDR(&message);
  header->cmsg_level = SOL_SOCKET;
  header->cmsg_type = SCM_RIGHTS;
  header->cmsg_len = CMSG_LEN(descriptors.size() * sizeof(int));
  std::memcpy(CMSG_DATA(header), descriptors.data(), descriptors.size() * sizeof(int));
  if (sendmsg(socket, &message, MSG_NOSIGNAL) < 0) throw MachineError("the nursery of guests", errno);
}

std::optional<Order> receive_order(int socket) {
  std::vector<char> text(most_bytes);
  iovec bytes = {text.data(), text.size()};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(most_descriptors * sizeof(int))> control{};
  msghdr message{};
  message.msg_iov = &bytes;
  message.msg_iovlen = 1;
  message.msg_control = control.data();
  message.msg_controllen = control.size();
  const ssize_t count = recvmsg(socket, &message, 0);
  const cmsghdr* const header = CMSG_FIRSTHDR(&message);
  if (count <= 0 || !header) return std::nullopt;
  Order order;
  for (const char* at = text.data(); at < text.data() + count; at += order.arguments.back().size() + 1)
    order.arguments.emplace_back(at);
  order.descriptors.resize((header->cmsg_len - CMSG_LEN(0)) / sizeof(int));
  std::memcpy(order.descriptors.data(), CMSG_DATA(header), order.descriptors.size() * sizeof(int));
  return order;
}

// The descriptors have other numbers here.
void close_others(std::vector<int>& descriptors) {
  int next = STDERR_FILENO + 1;
  for (int& descriptor : descriptors) {
    for (int& other : descriptors)
      if (&other > &descriptor && other == next) other = dup(other);
    if (descriptor != next) dup2(descriptor, next);
    descriptor = next++;
  }
  close_range(static_cast<unsigned>(next), ~0u, 0);
}

[[noreturn]] void be_guest(pid_t judge, int socket, Order order) {
  while (getppid() != judge) {  // until the process between them has ended
    if (kill(judge, 0) != 0) _exit(1);
    sched_yield();
  }
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != judge) _exit(1);
  const pid_t own = getpid();
  if (send(socket, &own, sizeof(own), MSG_NOSIGNAL) != sizeof(own)) _exit(1);
  close_others(order.descriptors);
  be_child();
  _exit(run_guest(order.arguments, order.descriptors));
}

// A child's child becomes the judge's when the child ends.
void start_guest(pid_t judge, int socket, const Order& order) {
  const pid_t between = fork();
  if (between == 0) {
    const pid_t guest = fork();
    if (guest == 0) be_guest(judge, socket, order);
    if (guest < 0) send(socket, &guest, sizeof(guest), MSG_NOSIGNAL);
    _exit(0);
  }
  if (between < 0) send(socket, &between, sizeof(between), MSG_NOSIGNAL);
  if (between > 0) waitpid(between, nullptr, 0);
  for (const int descriptor : order.descriptors) close(descriptor);
}

}  // namespace

Nursery::Nursery(bool is_program) {
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0) throw MachineError("socketpair", errno);
  socket_ = Descriptor(ends[0]);
  Descriptor other(ends[1]);
  const std::string program = executable_path().string();
  const std::string socket = std::to_string(other.number());
  const pid_t judge = getpid();
  const std::string number = std::to_string(judge);
  std::fflush(nullptr);
  pid_ = fork();
  if (pid_ < 0) throw MachineError("fork", errno);
  if (pid_ > 0) {
    box::hide();
    return;
  }
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != judge) _exit(0);
  if (!is_program) _exit(run(other.number(), judge));
  for (const int stop : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) signal(stop, SIG_IGN);  // its parent ends it
  fcntl(other.number(), F_SETFD, 0);
  execl(program.c_str(), program.c_str(), "nursery", socket.c_str(), number.c_str(), nullptr);
  _exit(1);
}

int Nursery::run(int socket, pid_t judge) {
  const auto own = static_cast<unsigned>(socket);
  if (own > STDERR_FILENO + 1) close_range(STDERR_FILENO + 1, own - 1, 0);
  close_range(own + 1, ~0u, 0);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  while (const auto order = receive_order(socket)) start_guest(judge, socket, *order);
  return 0;
}

static std::unique_ptr<const Nursery>& kept_nursery() {
  static std::unique_ptr<const Nursery> nursery;
  return nursery;
}

void end_own_nursery() {
  kept_nursery().reset();
}

const Nursery& own_nursery() {
  adopt_orphans();
  std::unique_ptr<const Nursery>& nursery = kept_nursery();
  siginfo_t ended{};
  // who kills all orphans kills it, too
  if (nursery &&
      (waitid(P_PID, static_cast<id_t>(nursery->pid_), &ended, WEXITED | WNOHANG | WNOWAIT) != 0 || ended.si_pid != 0))
    nursery.reset();
  if (!nursery) nursery.reset(new Nursery(true));
  return *nursery;
}

Nursery::~Nursery() {
  socket_.close();
  waitpid(pid_, nullptr, 0);
}

std::unique_ptr<ChildProcess> Nursery::start(const GuestSetup& setup, std::int64_t group_memory_mb) const {
  send_order(socket_.number(), setup);
  pid_t guest = -1;
  if (recv(socket_.number(), &guest, sizeof(guest), 0) != sizeof(guest) || guest < 0)
    throw MachineError("a guest cannot be started", EAGAIN);
  return ChildProcess::adopt(guest, group_memory_mb);
}

}  // namespace dmrp::host
