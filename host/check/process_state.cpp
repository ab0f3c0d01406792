// SPDX-License-Identifier: MIT
#include "host/check/process_state.hpp"

#include <fmt/format.h>
#include <langinfo.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <clocale>
#include <filesystem>

namespace dmrp::host {

namespace {

namespace fs = std::filesystem;

std::vector<std::string> open_descriptors() {
  std::vector<std::string> out;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator("/proc/self/fd", error)) {
    const fs::path target = fs::read_symlink(entry.path(), error);
    // the one that lists them
    if (!error && target.string().find("/fd") == std::string::npos)
      out.push_back(entry.path().filename().string() + ": " + target.string());
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
  std::error_code error;
  const fs::directory_iterator tasks("/proc/self/task", error);
  return error ? 1 : static_cast<std::size_t>(std::distance(begin(tasks), end(tasks)));
}

}  // namespace dmrp::host
