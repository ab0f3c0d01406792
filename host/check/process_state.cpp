// SPDX-License-Identifier: MIT
#include "host/check/process_state.hpp"

#include <fmt/format.h>
#include <langinfo.h>
#include <link.h>
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

StaticVariables::StaticVariables(const std::filesystem::path& library) {
  struct Search {
    const std::filesystem::path& library;
    StaticVariables& self;
  } search{library, *this};
  dl_iterate_phdr(
      [](dl_phdr_info* object, std::size_t, void* data) {
        auto& [wanted, self] = *static_cast<Search*>(data);
        if (wanted != object->dlpi_name) return 0;
        self.base_ = object->dlpi_addr;
        // what the loader has made read-only begins the writable segment
        std::uintptr_t relocated_end = 0;
        for (int i = 0; i < object->dlpi_phnum; ++i)
          if (const auto& part = object->dlpi_phdr[i]; part.p_type == PT_GNU_RELRO)
            relocated_end = self.base_ + part.p_vaddr + part.p_memsz;
        for (int i = 0; i < object->dlpi_phnum; ++i) {
          const auto& part = object->dlpi_phdr[i];
          if (part.p_type != PT_LOAD || (part.p_flags & PF_W) == 0) continue;
          const std::uintptr_t begin = std::max(self.base_ + part.p_vaddr, relocated_end);
          const std::uintptr_t end = self.base_ + part.p_vaddr + part.p_memsz;
          if (begin >= end) continue;
          const auto* const first = reinterpret_cast<const std::uint8_t*>(begin);
          self.ranges_.push_back({first, {first, first + (end - begin)}});
        }
        return 1;
      },
      &search);
}

std::vector<std::uintptr_t> StaticVariables::changed() const {
  std::vector<std::uintptr_t> places;
  for (const Range& range : ranges_)
    for (std::size_t i = 0; i < range.values.size(); ++i)
      if (range.begin[i] != range.values[i])
        places.push_back(reinterpret_cast<std::uintptr_t>(range.begin) + i - base_);
  return places;
}

}  // namespace dmrp::host
