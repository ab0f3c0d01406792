// SPDX-License-Identifier: MIT
// Cases about memory and extensions.
#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>

#include "host/check/check_case.hpp"
#include "host/check/examination.hpp"
#include "host/check/rehearsal/rehearsal.hpp"
#include "host/process/sanitized.hpp"

namespace dmrp::host {

namespace memory_cases {

namespace {

constexpr std::size_t smallest_block = 16;  // that the allocator hands out

// Memory in use is compared over so many lives of an instance.
std::size_t lifecycles() {
  return most_ticks(20);
}

std::size_t bytes_in_use() {
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

// By how much the memory in use grows in so many lifecycles.
std::size_t growth(Examination& it, const StageSettings& settings, std::size_t count) {
  const std::size_t before = bytes_in_use();
  for (std::size_t i = 0; i < count; ++i) {
    const auto instance = it.create();
    rehearse(*instance, it.plugin(), settings, it.seed());
  }
  const std::size_t after = bytes_in_use();
  return after > before ? after - before : 0;
}

std::size_t least_growth(Examination& it, const StageSettings& settings) {
  std::size_t least = growth(it, settings, lifecycles());
  for (int i = 1; i < 5; ++i) least = std::min(least, growth(it, settings, lifecycles()));
  return least;
}

}  // namespace

void leaks(Examination& it) {
  if (sanitizer_is_loaded()) throw Skipped{"a sanitizer has its own allocator"};
  StageSettings settings;
  settings.ticks = 3;
  settings.people = 2;
  settings.robots = 2;
  growth(it, settings, lifecycles());  // what is kept for good is there after some
  // the allocator keeps some freed blocks, but not more and more of them: what seems lost is looked at again, later
  std::size_t least = least_growth(it, settings);
  if (least >= lifecycles() * smallest_block) {
    growth(it, settings, 20 * lifecycles());
    least = least_growth(it, settings);
  }
  if (least >= lifecycles() * smallest_block)
    it.fail(fmt::format("loses about {} bytes in each life of an instance, with a trial of it", least / lifecycles()));
}

}  // namespace memory_cases

namespace extension_cases {

void undeclared(Examination& it) {
  const auto instance = it.create();
  rehearse(*instance, it.plugin(), {}, it.seed());
  for (const std::string& complaint : it.complaints())
    if (complaint.find("which its descriptor does not declare") != std::string::npos) it.warn(complaint);
}

void not_offered(Examination& it) {
  if (it.plugin().uses.empty()) throw Skipped{"it uses no optional extension"};
  StageSettings settings;
  settings.offers_extensions = false;
  const auto instance = it.create();
  it.at(fmt::format("without {}", fmt::join(it.plugin().uses, ", ")));
  rehearse(*instance, it.plugin(), settings, it.seed());
}

void own_getter(Examination& it) {
  const auto instance = it.create();
  const dmrp_plugin& plugin = instance->plugin();
  if (!plugin.get_extension) throw Skipped{"it has no get_extension()"};
  for (const char* id : {"org.example.unknown/1", "", "dmrp.annotate/999"})
    if (plugin.get_extension(instance->self(), id)) it.fail(fmt::format("get_extension(\"{}\") is not NULL", id));
}

}  // namespace extension_cases

std::span<const CheckCase> other_check_cases() {
  static constexpr CheckCase cases[] = {
      {"memory/leaks", for_all, memory_cases::leaks, "plugin.h: destroy() frees the instance",
       "free in destroy() what the instance allocated (docs/debugging.md finds the place)"},
      {"extensions/undeclared", for_all, extension_cases::undeclared,
       "host.h: get_extension() gives NULL for what the descriptor does not declare",
       "list the extension in uses or needed"},
      {"extensions/not_offered", for_all, extension_cases::not_offered,
       "descriptor.h: uses lists extensions that it uses when available",
       "test the pointer for NULL, or list the extension in needed"},
      {"extensions/own_getter", for_all, extension_cases::own_getter,
       "plugin.h: get_extension() is an extension of the plugin by its id, or NULL", "return NULL for any other id"},
  };
  return cases;
}

}  // namespace dmrp::host
