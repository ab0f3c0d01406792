// SPDX-License-Identifier: MIT
// cpp/library.hpp: defines the entry of a plugin library: DMRP_PLUGINS(A, B), once per library.
#pragma once

#include <array>
#include <cstring>

#include "../entry.h"
#include "descriptor.hpp"
#include "plugin_base.hpp"

namespace dmrp {

template <class... Plugins>
class Library {
 public:
  static constexpr dmrp_entry entry() {
    return {sizeof(dmrp_entry), DMRP_ABI_MINOR, 0, DMRP_ABI_DRAFT, &init, &deinit, &count, &descriptor, &create};
  }

 private:
  static std::int32_t init(const dmrp_host*) { return DMRP_OK; }
  static void deinit() {}
  static std::uint32_t count() { return sizeof...(Plugins); }

  static const dmrp_descriptor* descriptor(std::uint32_t index) {
    static constexpr std::array<const dmrp_descriptor& (*)(), sizeof...(Plugins)> published = {&describe<Plugins>...};
    try {
      return index < published.size() ? &published[index]() : nullptr;
    } catch (...) {
      return nullptr;
    }
  }

  // The parameter table comes from a prototype of the class.
  template <class P>
  static const dmrp_descriptor& describe() {
    static const PublishedDescriptor published(P::describe(), P::kind, [] {
      P prototype;
      return std::move(PluginAccess::parameters(prototype));
    }());
    return published.get();
  }

  static std::int32_t create(const dmrp_host* host, const char* id, const dmrp_params* params, dmrp_plugin* out) {
    return PluginAccess::guarded(host, [&] {
      const bool known = (make_if<Plugins>(host, id, *params, out) || ...);
      if (!known) host->set_error(host, "no plugin of that id in this library");
      return known ? Status::ok : Status::error;
    });
  }

  template <class P>
  static bool make_if(const dmrp_host* host, const char* id, const dmrp_params& params, dmrp_plugin* out) {
    if (std::strcmp(describe<P>().id, id) != 0) return false;
    auto plugin = std::make_unique<P>();
    PluginAccess::configure(*plugin, host, params);
    out->interface_ = P::interface_table();
    out->start = [](dmrp_instance* self, const dmrp_world* world, std::uint64_t seed) {
      auto& started = detail::from_instance<Plugin>(self);
      return PluginAccess::guarded(started, [&] { return PluginAccess::start(started, *world, seed); });
    };
    out->get_extension = [](dmrp_instance* self, const char* extension) -> const void* {
      try {
        return detail::from_instance<Plugin>(self).offered_extension(extension);
      } catch (...) {
        return nullptr;
      }
    };
    out->destroy = [](dmrp_instance* self) { delete &detail::from_instance<Plugin>(self); };
    out->self = detail::to_instance(plugin.release());
    return true;
  }
};

}  // namespace dmrp

#define DMRP_PLUGINS(...) DMRP_ENTRY = dmrp::Library<__VA_ARGS__>::entry();
