// SPDX-License-Identifier: MIT
#include "host/plugins/plugin_host.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "host/errors/escaped_text.hpp"
#include "host/program/version.hpp"
#include "host/toml/nearest_name.hpp"

namespace dmrp::host {

PluginHost::PluginHost(std::string id, const std::string& library_path, std::vector<std::string> declared,
                       CallGuard& guard, LogSink log, std::uint32_t grown_bytes)
    : id_(std::move(id)),
      library_path_(library_path),
      declared_(std::move(declared)),
      guard_(guard),
      log_(std::move(log)),
      host_({}, grown_bytes),
      timing_({}, grown_bytes) {
  c_.abi_minor = DMRP_ABI_MINOR;
  c_.context = this;
  c_.name = "dmrp-host";
  c_.version = version;
  c_.library_path = library_path_.c_str();
  c_.log = [](const dmrp_host* host, std::int32_t level, const char* text) noexcept {
    try {
      of(host).log(level, escaped(text));
    } catch (...) {  // out of memory: the line is lost
    }
  };
  c_.set_error = [](const dmrp_host* host, const char* text) noexcept { of(host).guard_.set_error(host, text); };
  c_.should_stop = [](const dmrp_host* host) noexcept -> std::int32_t {
    return of(host).guard_.should_stop(host) ? 1 : 0;
  };
  c_.budget_left_ns = [](const dmrp_host* host) noexcept { return of(host).guard_.budget_left_ns(host); };
  c_.get_extension = [](const dmrp_host* host, const char* extension) noexcept -> const void* {
    try {
      return extension ? of(host).extension(extension) : nullptr;
    } catch (...) {
      return nullptr;
    }
  };
  timing_.c.context = this;
  timing_.c.not_repeatable = [](const dmrp_timing* timing, const char* reason) noexcept {
    PluginHost& self = of(timing);
    self.guard_.depends_on_timing(&self.c_, self.id_, reason);
  };
}

const void* PluginHost::extension(const char* id) {
  if (std::find(declared_.begin(), declared_.end(), id) != declared_.end()) {
    if (id == std::string_view(DMRP_EXT_TIMING)) return &timing_.c;
    return extensions_ ? extensions_(id) : nullptr;
  }
  if (refused_.insert(id).second)
    log(DMRP_LOG_WARNING,
        fmt::format("asks for the extension '{}', which its descriptor does not declare: it gets none{}", escaped(id),
                    did_you_mean(id, declared_)));
  return nullptr;
}

}  // namespace dmrp::host
