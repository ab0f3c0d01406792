// SPDX-License-Identifier: MIT
#include "host/guests/fork_server.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sched.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/errors/machine_error.hpp"
#include "host/guests/python_guest.hpp"
#include "host/process/box.hpp"
#include "host/process/orphans.hpp"
#include "host/process/view.hpp"
#include "host/program/executable.hpp"

namespace dmrp::host {

namespace {

constexpr std::size_t most_bytes = 131072;  // of a setup: its paths
constexpr std::size_t most_descriptors = 3;
constexpr int no_python_exit = 127;

// An order is sent as texts, each with a NUL: the program, the number of visible paths, these, and the arguments.
std::string text_of(const GuestOrder& order) {
  std::string text =
      std::to_string(static_cast<int>(order.program)) + '\0' + std::to_string(order.visible.size()) + '\0';
  for (const std::filesystem::path& path : order.visible) text += path.string() + '\0';
  for (const std::string& argument : order.arguments) text += argument + '\0';
  return text;
}

GuestOrder read_order(const char* text, std::size_t bytes) {
  std::vector<std::string> texts;
  for (const char* at = text; at < text + bytes; at += texts.back().size() + 1) texts.emplace_back(at);
  const auto visible = texts.begin() + 2;
  const auto arguments = visible + std::stol(texts.at(1));
  return {static_cast<GuestOrder::Program>(std::stoi(texts.at(0))), {arguments, texts.end()}, {visible, arguments}, {}};
}

void send_order(int socket, const GuestOrder& order) {
  std::string text = text_of(order);
  iovec bytes = {text.data(), text.size()};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(most_descriptors * sizeof(int))> control{};
  msghdr message{};
  message.msg_iov = &bytes;
  message.msg_iovlen = 1;
  message.msg_control = control.data();
  message.msg_controllen = CMSG_SPACE(order.descriptors.size() * sizeof(int));
  cmsghdr* const header = CMSG_FIRSTHDR(&message);
  header->cmsg_level = SOL_SOCKET;
  header->cmsg_type = SCM_RIGHTS;
  header->cmsg_len = CMSG_LEN(order.descriptors.size() * sizeof(int));
  std::memcpy(CMSG_DATA(header), order.descriptors.data(), order.descriptors.size() * sizeof(int));
  if (sendmsg(socket, &message, MSG_NOSIGNAL) < 0) throw MachineError("the fork_server of guests", errno);
}

std::optional<GuestOrder> receive_order(int socket) {
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
  GuestOrder order = read_order(text.data(), static_cast<std::size_t>(count));
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

// What the fork_server answers: the number of the guest, or why there is none.
struct Started {
  pid_t number = -1;
  std::array<char, 256> error{};
};

[[noreturn]] void be_guest(GuestOrder order, GuestProgram check_case) {
  close_others(order.descriptors);
  if (order.program == GuestOrder::Program::python) {
    try {
      become_python(order);
    } catch (const std::exception& error) {
      std::fprintf(stderr, "%s\n", error.what());
    }
    _exit(no_python_exit);
  }
  const GuestProgram program = order.program == GuestOrder::Program::library ? &run_guest : check_case;
  _exit(program(order.arguments, order.descriptors));
}

// The first process of the guest's namespace, which the guest is not: signals that end other processes do not end the first.
// It ends with the guest or with the judge, and takes all others along. It is told the guest's number in the namespace.
[[noreturn]] void be_keeper(int socket, int told) {
  dup2(socket, STDIN_FILENO);
  dup2(told, STDOUT_FILENO);
  close_range(STDOUT_FILENO + 1, ~0u, 0);
  pid_t guest = -1;
  if (read(STDOUT_FILENO, &guest, sizeof(guest)) != sizeof(guest)) _exit(1);
  const auto ended = static_cast<int>(syscall(SYS_pidfd_open, guest, 0));
  if (ended < 0) _exit(1);
  std::array<pollfd, 2> watched = {{{ended, POLLIN, 0}, {STDIN_FILENO, 0, 0}}};
  while (poll(watched.data(), watched.size(), -1) < 0 && errno == EINTR) {
  }
  syscall(SYS_pidfd_send_signal, ended, SIGKILL, nullptr, 0);
  _exit(0);
}

void start_with_keeper(int socket, const GuestOrder& order, GuestProgram check_case, bool has_view, Started& started) {
  const Pipe pipe = make_pipe();
  const auto keeper =
      static_cast<pid_t>(syscall(SYS_clone, CLONE_PARENT | SIGCHLD, nullptr, nullptr, nullptr, nullptr));
  if (keeper == 0) be_keeper(socket, pipe.read_end.number());
  const pid_t guest = keeper < 0 ? -1 : fork();
  if (guest == 0) {
    munmap(&started, sizeof(started));  // the judge believes it
    be_guest(order, check_case);
  }
  if (guest < 0) throw MachineError("fork", errno);
  constexpr pid_t number_in_namespace = 2;
  const pid_t number = has_view ? number_in_namespace : guest;
  if (write(pipe.write_end.number(), &number, sizeof(number)) != sizeof(number)) throw MachineError("pipe", errno);
  started.number = guest;
}

// A child's child becomes the judge's when the child ends.
void start_guest(int socket, const GuestOrder& order, GuestProgram check_case, Started& started) {
  started = Started();
  const pid_t between = fork();
  if (between == 0) {
    try {
      be_child();
      setpgid(0, 0);  // what is done to all of a group does not reach others
      const bool has_view = box::has_view();
      if (has_view) view::leave({order.visible.begin(), order.visible.end()});
      start_with_keeper(socket, order, check_case, has_view, started);
    } catch (const std::exception& error) {
      const std::string_view text = error.what();
      std::copy_n(text.begin(), std::min(text.size(), started.error.size() - 1), started.error.begin());
    }
    _exit(0);
  }
  if (between > 0) waitpid(between, nullptr, 0);
  while (waitpid(-1, nullptr, WNOHANG) > 0) {  // keepers of guests that have ended
  }
  for (const int descriptor : order.descriptors) close(descriptor);
}

}  // namespace

ForkServer::ForkServer(bool is_program) {
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0) throw MachineError("socketpair", errno);
  socket_ = Descriptor(ends[0]);
  Descriptor other(ends[1]);
  const std::string program = executable_path().string();
  const std::string socket = std::to_string(other.number());
  const pid_t judge = getpid();
  box::has_view();  // the guests' processes need not try
  std::fflush(nullptr);
  pid_ = fork();
  if (pid_ < 0) throw MachineError("fork", errno);
  if (pid_ > 0) {
    box::hide();
    return;
  }
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != judge) _exit(0);
  if (!is_program) _exit(run(other.number(), nullptr));
  for (const int stop : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) signal(stop, SIG_IGN);  // its parent ends it
  fcntl(other.number(), F_SETFD, 0);
  execl(program.c_str(), program.c_str(), "fork-server", socket.c_str(), nullptr);
  _exit(1);
}

int ForkServer::run(int socket, GuestProgram check_case) {
  const auto own = static_cast<unsigned>(socket);
  if (own > STDERR_FILENO + 1) close_range(STDERR_FILENO + 1, own - 1, 0);
  close_range(own + 1, ~0u, 0);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  void* const shared = mmap(nullptr, sizeof(Started), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (shared == MAP_FAILED) return 1;
  Started& started = *new (shared) Started();
  executable_path();  // no guest can ask for it
  while (const auto order = receive_order(socket)) {
    start_guest(socket, *order, check_case, started);
    if (send(socket, &started, sizeof(started), MSG_NOSIGNAL) < 0) return 1;
  }
  return 0;  // keepers end by themselves
}

static std::unique_ptr<const ForkServer>& kept_fork_server() {
  static std::unique_ptr<const ForkServer> fork_server;
  return fork_server;
}

void end_own_fork_server() {
  kept_fork_server().reset();
  kill_orphans({});  // its keepers
}

const ForkServer& own_fork_server() {
  adopt_orphans();
  std::unique_ptr<const ForkServer>& fork_server = kept_fork_server();
  siginfo_t ended{};
  // who kills all orphans kills it, too
  if (fork_server && (waitid(P_PID, static_cast<id_t>(fork_server->pid_), &ended, WEXITED | WNOHANG | WNOWAIT) != 0 ||
                      ended.si_pid != 0))
    fork_server.reset();
  if (!fork_server) fork_server.reset(new ForkServer(true));
  return *fork_server;
}

ForkServer::~ForkServer() {
  socket_.close();
  waitpid(pid_, nullptr, 0);
}

std::unique_ptr<ChildProcess> ForkServer::start(const GuestOrder& order) const {
  send_order(socket_.number(), order);
  Started started;
  ssize_t count = 0;
  do {
    count = recv(socket_.number(), &started, sizeof(started), 0);
  } while (count < 0 && errno == EINTR);  // another guest has ended
  if (count != sizeof(started)) throw MachineError("the fork_server of guests", count < 0 ? errno : ECHILD);
  if (started.number < 0) throw MachineError(std::string("a guest cannot be started: ") + started.error.data());
  return ChildProcess::adopt(started.number);
}

}  // namespace dmrp::host
