// SPDX-License-Identifier: MIT
// A library is loaded in a child process first: a truncated .so raises SIGBUS inside dlopen, static initialisers may do
// anything, and neither may take the experiment with it.
#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "host/plugins/library.hpp"
#include "host/program/executable.hpp"
#include "host/program/version.hpp"

namespace dmrp::host {

namespace {

constexpr unsigned probe_limit_s = 20;

// Runs `dmrp-host probe FILE` and returns what it wrote to the pipe.
struct ChildResult {
  std::string output;
  int wait_status = 0;
};

ChildResult run_child(const std::filesystem::path& file) {
  std::array<int, 2> pipe_ends{};
  if (pipe2(pipe_ends.data(), O_CLOEXEC) != 0)
    throw std::runtime_error(fmt::format("cannot be probed (pipe: {})", std::strerror(errno)));
  const std::string executable = executable_path().string();
  const std::string descriptor = std::to_string(pipe_ends[1]);
  const std::string path = file.string();
  const char* const arguments[] = {executable.c_str(), "probe", path.c_str(), descriptor.c_str(), nullptr};
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error(fmt::format("cannot be probed (fork: {})", std::strerror(errno)));
  if (child == 0) {
    fcntl(pipe_ends[1], F_SETFD, 0);
    dup2(STDERR_FILENO, STDOUT_FILENO);  // what it prints shall not end up in our answer
    alarm(probe_limit_s);                // an initialiser that hangs ends by SIGALRM
    execv(arguments[0], const_cast<char* const*>(arguments));
    _exit(127);
  }
  close(pipe_ends[1]);

  ChildResult result;
  std::array<char, 4096> buffer;
  for (;;) {
    const ssize_t count = read(pipe_ends[0], buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    result.output.append(buffer.data(), static_cast<std::size_t>(count));
  }
  close(pipe_ends[0]);
  while (waitpid(child, &result.wait_status, 0) < 0 && errno == EINTR) {
  }
  return result;
}

// Why the library cannot work here, "" if it can: better told before a run begins than by its first worker.
std::string try_init(const dmrp_entry& entry) {
  std::string error;
  dmrp_host host{};
  host.struct_size = sizeof(host);
  host.context = &error;
  host.name = "dmrp-host";
  host.version = version;
  host.log = [](const dmrp_host*, std::int32_t, const char*) {};
  host.set_error = [](const dmrp_host* self, const char* text) {
    *static_cast<std::string*>(self->context) = text ? text : "";
  };
  host.should_stop = [](const dmrp_host*) -> std::int32_t { return 0; };
  host.get_extension = [](const dmrp_host*, const char*) -> const void* { return nullptr; };
  const std::int32_t status = entry.init(&host);
  if (status == DMRP_OK || status == DMRP_WARNING) return entry.deinit(), "";
  return error.empty() ? fmt::format("its init() returned status {}", status) : "its init() failed: " + error;
}

}  // namespace

Probe probe_library(const std::filesystem::path& file) {
  const ChildResult child = run_child(file);
  if (WIFSIGNALED(child.wait_status)) {
    const int signal = WTERMSIG(child.wait_status);
    if (signal == SIGALRM) throw std::runtime_error(fmt::format("hangs while it is loaded ({} s)", probe_limit_s));
    throw std::runtime_error(
        fmt::format("crashes while it is loaded (signal {}, {}; a truncated file?)", signal, strsignal(signal)));
  }
  const auto json = nlohmann::json::parse(child.output, nullptr, false);
  if (json.is_discarded()) throw std::runtime_error("ends the process while it is loaded");
  if (json.contains("error")) throw std::runtime_error(json.at("error").get<std::string>());
  return {json.at("plugins").get<std::vector<PluginInfo>>(), json.at("warning").get<std::string>(),
          json.at("init_error").get<std::string>()};
}

int run_probe(const std::filesystem::path& file, int descriptor) {
  nlohmann::json answer;
  try {
    const Library library(file);
    answer = {
        {"plugins", library.plugins()}, {"warning", library.warning()}, {"init_error", try_init(library.entry())}};
  } catch (const std::exception& error) {
    answer = {{"error", error.what()}};
  }
  const std::string text = answer.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  for (std::size_t sent = 0; sent < text.size();) {
    const ssize_t count = write(descriptor, text.data() + sent, text.size() - sent);
    if (count < 0 && errno != EINTR) return 1;
    if (count > 0) sent += static_cast<std::size_t>(count);
  }
  // Not exit(): destructors of a stranger's static objects are none of the probe's business.
  _exit(0);
}

}  // namespace dmrp::host
