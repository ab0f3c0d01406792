// SPDX-License-Identifier: MIT
#include "host/check/process_state.hpp"

#include <fmt/format.h>
#include <langinfo.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <clocale>
#include <filesystem>

namespace dmrp::host {

namespace {

namespace fs = std::filesystem;

constexpr rlim_t most_descriptors = 4096;
constexpr pid_t most_threads = 4096;  // their numbers follow that of the process

// The box has no /proc.
std::vector<std::string> open_descriptors() {
  std::vector<std::string> out;
  rlimit most{};
  getrlimit(RLIMIT_NOFILE, &most);
  for (int number = 0; static_cast<rlim_t>(number) < std::min(most.rlim_cur, most_descriptors); ++number) {
    struct stat file {};
    if (fstat(number, &file) == 0)
      out.push_back(fmt::format("{}: file {} of device {}", number, file.st_ino, file.st_dev));
  }
  std::sort(out.begin(), out.end());
  return out;
}

// The first that only one of them has, as "lost X" or "new X"; both are sorted.
std::string difference(const std::vector<std::string>& before, const std::vector<std::string>& now) {
  for (const std::string& text : before)
    if (!std::binary_search(now.begin(), now.end(), text)) return "lost " + text;
  for (const std::string& text : now)
    if (!std::binary_search(before.begin(), before.end(), text)) return "new " + text;
  return "";
}

}  // namespace

ProcessState ProcessState::now() {
  ProcessState state;
  for (const nl_item category : {NL_LOCALE_NAME(LC_CTYPE), NL_LOCALE_NAME(LC_NUMERIC), NL_LOCALE_NAME(LC_COLLATE)})
    state.locale += std::string(state.locale.empty() ? "" : " ") + nl_langinfo(category);
  std::error_code error;
  state.folder = fs::current_path(error).string();
  for (char** entry = environ; entry && *entry; ++entry) state.environment.emplace_back(*entry);
  std::sort(state.environment.begin(), state.environment.end());
  for (int number = 1; number < SIGRTMIN; ++number) {
    struct sigaction action {};
    sigaction(number, nullptr, &action);
    state.handlers.push_back(reinterpret_cast<const void*>(action.sa_handler));
  }
  state.descriptors = open_descriptors();
  state.file_mode_mask = umask(0);
  umask(state.file_mode_mask);
  return state;
}

std::string ProcessState::change_since(const ProcessState& before) const {
  if (locale != before.locale) return fmt::format("the locale: '{}', was '{}'", locale, before.locale);
  if (folder != before.folder) return fmt::format("the working directory: {}, was {}", folder, before.folder);
  if (const std::string text = difference(before.environment, environment); !text.empty())
    return "the environment: " + text;
  for (std::size_t i = 0; i < handlers.size(); ++i)
    if (handlers[i] != before.handlers[i]) {
      const int number = static_cast<int>(i) + 1;
      return fmt::format("the handler of signal {} ({})", number, sigabbrev_np(number));
    }
  if (file_mode_mask != before.file_mode_mask)
    return fmt::format("the umask: {:o}, was {:o}", file_mode_mask, before.file_mode_mask);
  for (const std::string& text : before.descriptors)
    if (!std::binary_search(descriptors.begin(), descriptors.end(), text))
      return "a descriptor that it did not open: " + text;
  return "";
}

std::size_t thread_count() {
  const pid_t process = getpid();
  std::size_t count = 0;
  for (pid_t thread = process; thread < process + most_threads; ++thread)
    if (syscall(SYS_tgkill, process, thread, 0) == 0) ++count;
  return count;
}

}  // namespace dmrp::host
