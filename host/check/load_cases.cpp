// SPDX-License-Identifier: MIT
#include <cxxabi.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <regex>
#include <tuple>

#include "host/check/check_case.hpp"
#include "host/check/examination.hpp"
#include "host/check/process_state.hpp"
#include "host/plugins/elf_file.hpp"
#include "host/program/monotonic_time.hpp"

namespace dmrp::host::load_cases {

namespace {

constexpr std::int64_t long_load_ns = 2'000'000'000;

// Instances of the C++ library's templates, which its headers export from everywhere: equal in all libraries.
bool is_of_standard_library(const std::string& name) {
  static const std::regex pattern("_Z(T[VTIS]|GV)?Z?N?V?K?(S[tabsiod]|9__gnu_cxx).*");
  return std::regex_match(name, pattern);
}

std::string readable(const std::string& name) {
  int status = 0;
  const std::unique_ptr<char, void (*)(void*)> text(abi::__cxa_demangle(name.c_str(), nullptr, nullptr, &status),
                                                    &std::free);
  return std::string(status == 0 ? text.get() : name.c_str()).substr(0, 80);
}

}  // namespace

void open(Examination& it) {
  for (const std::string& warning : it.library().warnings())
    if (warning.find("left out") != std::string::npos) it.warn(warning);
  it.init();
}

void exports(Examination& it) {
  std::vector<ExportedSymbol> others = exported_symbols(it.file());
  std::erase_if(others, [](const ExportedSymbol& symbol) {
    return symbol.name == DMRP_ENTRY_SYMBOL || (symbol.weak && is_of_standard_library(symbol.name));
  });
  if (others.empty()) return;
  std::sort(others.begin(), others.end(), [](const ExportedSymbol& a, const ExportedSymbol& b) {
    return std::tie(a.weak, a.name) < std::tie(b.weak, b.name);
  });
  std::vector<std::string> names;
  for (std::size_t i = 0; i < std::min<std::size_t>(others.size(), 3); ++i) names.push_back(readable(others[i].name));
  it.warn(fmt::format("exports {} symbols besides " DMRP_ENTRY_SYMBOL ": {}{}", others.size(), fmt::join(names, ", "),
                      others.size() > names.size() ? ", ..." : ""));
}

void floating_point(Examination& it) {
  for (const std::string& warning : it.library().warnings())
    if (warning.find("floating-point") != std::string::npos) it.fail(warning);
}

void process_state(Examination& it) {
  const ProcessState before = ProcessState::now();
  it.at("dlopen");
  it.library();
  const auto compare = [&] {
    if (const std::string change = ProcessState::now().change_since(before); !change.empty())
      it.fail("changes " + change);
  };
  compare();
  it.at("init");
  it.init();
  compare();
}

void threads(Examination& it) {
  it.at("dlopen");
  it.library();
  if (thread_count() > 1) it.fail(fmt::format("starts {} threads", thread_count() - 1));
}

void prints(Examination& it) {
  it.init();
  it.deinit();
  std::fflush(nullptr);
  struct stat output {};
  if (fstat(STDOUT_FILENO, &output) == 0 && output.st_size > 0)
    it.warn(fmt::format("writes {} bytes to standard output or standard error", output.st_size));
}

void time(Examination& it) {
  const std::int64_t start_ns = monotonic_ns();
  it.init();
  if (const std::int64_t taken_ns = monotonic_ns() - start_ns; taken_ns > long_load_ns)
    it.warn(fmt::format("takes {:.1f} s to load", static_cast<double>(taken_ns) * 1e-9));
}

void init_twice(Examination& it) {
  it.init();
  it.deinit();
  it.at("second init() after deinit()");
  it.init();
}

}  // namespace dmrp::host::load_cases

namespace dmrp::host {

std::span<const CheckCase> load_check_cases() {
  static constexpr CheckCase cases[] = {
      {"load/open", for_library, load_cases::open,
       "entry.h: a library exports dmrp_entry_v1 of this draft, whole; init() returns DMRP_OK or DMRP_WARNING",
       "build it with dmrp_add_plugin() against this host's SDK, and link all that it needs"},
      {"load/exports", for_library, load_cases::exports,
       "entry.h: dmrp_entry_v1 is the only symbol that a library exports; others may be one object with those of "
       "another library",
       "build with -fvisibility=hidden, put classes into an unnamed namespace, or use dmrp_add_plugin()"},
      {"load/floating_point", for_library, load_cases::floating_point,
       "abi.h: a plugin does not change the floating-point control bits", "build and link without -ffast-math"},
      {"load/process_state", for_library, load_cases::process_state,
       "abi.h: a plugin does not change the locale, working directory, signal handlers, environment or "
       "descriptors that it did not open",
       "leave to the host what belongs to the whole process, or set it back before the function returns"},
      {"load/threads", for_library, load_cases::threads, "abi.h: no thread starts in a static initialiser",
       "start threads in create() or start()"},
      {"load/prints", for_library, load_cases::prints,
       "host.h: log() writes to the log; standard output belongs to the host's results", "write with host->log()"},
      {"load/time", for_library, load_cases::time, "entry.h: init() is for what all instances share",
       "load large files when the first instance is created"},
      {"load/init_twice", for_library, load_cases::init_twice,
       "entry.h: a host may call init() and deinit() alone first", "free in deinit() what init() made, and no more"},
  };
  return cases;
}

}  // namespace dmrp::host
