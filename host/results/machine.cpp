// SPDX-License-Identifier: MIT
#include "host/results/machine.hpp"

#include <gnu/libc-version.h>
#include <sys/utsname.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <sstream>

namespace dmrp::host {
namespace {

struct Level {
  const char* name;
  std::vector<std::string> features;  // in addition to the previous level, named as in /proc/cpuinfo
};

// The levels of the x86-64 psABI. (/proc/cpuinfo names lzcnt "abm", and lists "avx" only with osxsave.)
const std::array<Level, 3>& levels() {
  static const std::array<Level, 3> all{
      {{"x86-64-v2", {"cx16", "lahf_lm", "popcnt", "pni", "sse4_1", "sse4_2", "ssse3"}},
       {"x86-64-v3", {"avx", "avx2", "bmi1", "bmi2", "f16c", "fma", "abm", "movbe"}},
       {"x86-64-v4", {"avx512f", "avx512bw", "avx512cd", "avx512dq", "avx512vl"}}}};
  return all;
}

std::string compiler_name() {
#if defined(__clang__)
  return "clang " + std::to_string(__clang_major__) + "." + std::to_string(__clang_minor__) + "." +
         std::to_string(__clang_patchlevel__);
#else
  return "gcc " + std::to_string(__GNUC__) + "." + std::to_string(__GNUC_MINOR__) + "." +
         std::to_string(__GNUC_PATCHLEVEL__);
#endif
}

}  // namespace

std::vector<std::string> cpu_features_of(std::string_view cpuinfo) {
  std::istringstream lines{std::string(cpuinfo)};
  for (std::string line; std::getline(lines, line);) {
    const std::size_t colon = line.find(':');
    if (colon == std::string::npos) continue;
    const std::string key = line.substr(0, line.find_last_not_of(" \t", colon - 1) + 1);
    if (key != "flags" && key != "Features") continue;  // x86 and ARM
    std::istringstream words(line.substr(colon + 1));
    std::vector<std::string> features{std::istream_iterator<std::string>(words), {}};
    std::sort(features.begin(), features.end());
    return features;
  }
  return {};
}

std::string x86_64_level_of(const std::vector<std::string>& features) {
  const auto has = [&](const std::string& name) {
    return std::find(features.begin(), features.end(), name) != features.end();
  };
  std::string level = "x86-64-v1";
  for (const Level& next : levels()) {
    if (!std::all_of(next.features.begin(), next.features.end(), has)) break;
    level = next.name;
  }
  return level;
}

Machine this_machine() {
  std::ifstream cpuinfo("/proc/cpuinfo");
  const std::string text{std::istreambuf_iterator<char>(cpuinfo), std::istreambuf_iterator<char>()};
  Machine machine;
  machine.libc = std::string("glibc ") + gnu_get_libc_version();
  machine.cpu_features = cpu_features_of(text);
  utsname names{};
  const std::string architecture = uname(&names) == 0 ? names.machine : "";
  machine.cpu_level = architecture == "x86_64" ? x86_64_level_of(machine.cpu_features) : architecture;
  machine.compiler = compiler_name();
  return machine;
}

}  // namespace dmrp::host
