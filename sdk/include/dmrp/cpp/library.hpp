// SPDX-License-Identifier: MIT
// cpp/library.hpp: defines the entry of a plugin library: DMRP_PLUGINS(A, B), once per library.
//
// What all instances of a class share, such as the weights of a learned policy, is loaded once: a plugin class may have
// the static functions `load(const dmrp::Host&)`, which may throw, and `unload()`.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>

#include "../entry.h"
#include "descriptor.hpp"
#include "plugin_base.hpp"

namespace dmrp {

namespace detail {

template <class P, class = void>
constexpr bool has_load = false;
template <class P>
constexpr bool has_load<P, std::void_t<decltype(P::load(std::declval<const Host&>()))>> = true;

template <class P, class = void>
constexpr bool has_unload = false;
template <class P>
constexpr bool has_unload<P, std::void_t<decltype(P::unload())>> = true;

// Whether `pointer`, to a member of this name, is that of a static function.
template <class Pointer>
constexpr bool is_static_function = std::is_function_v<std::remove_pointer_t<Pointer>>;
template <class P, class = void>
constexpr bool has_other_load = false;
template <class P>
constexpr bool has_other_load<P, std::void_t<decltype(&P::load)>> =
    is_static_function<decltype(&P::load)> && !has_load<P>;

}  // namespace detail

// `Unit` is a type of the translation unit that has DMRP_PLUGINS. It gives the functions and static objects of this
// class internal linkage: those of an inline function in two libraries would be one object for the whole process
// (STB_GNU_UNIQUE), and the second library would get the first one's descriptors.
template <class Unit, class... Plugins>
class Library {
 public:
  static constexpr dmrp_entry entry() {
    return {sizeof(dmrp_entry),
            DMRP_TARGET_MINOR,
            DMRP_TARGET_MINOR,
            DMRP_ABI_DRAFT,
            &init,
            &deinit,
            &count,
            &descriptor,
            &create};
  }

 private:
  static std::int32_t init(const dmrp_entry* /*self*/, const dmrp_host* host) {
    return PluginAccess::guarded(host, [&] { return (load<Plugins>(Host(host)), ...), Status::ok; });
  }
  static void deinit(const dmrp_entry* /*self*/) { (unload<Plugins>(), ...); }
  static std::uint32_t count(const dmrp_entry* /*self*/) { return sizeof...(Plugins); }

  template <class P>
  static void load([[maybe_unused]] const Host& host) {
    static_assert(!detail::has_other_load<P>, "load() of a plugin class takes a const dmrp::Host&");
    if constexpr (detail::has_load<P>) P::load(host);
  }
  template <class P>
  static void unload() {
    if constexpr (detail::has_unload<P>) {
      try {
        P::unload();
      } catch (...) {  // deinit() has no status
      }
    }
  }

  static const dmrp_descriptor* descriptor(const dmrp_entry* /*self*/, std::uint32_t index) {
    constexpr std::array<const dmrp_descriptor& (*)(), sizeof...(Plugins)> published = {&describe<Plugins>...};
    try {
      return index < published.size() ? &published[index]() : nullptr;
    } catch (...) {
      return nullptr;
    }
  }

  // The parameter table comes from a prototype of the class.
  template <class P>
  static const dmrp_descriptor& describe() {
    static const PublishedDescriptor published(P::describe().flags(P::interface_flags), P::interface_kind, [] {
      P prototype;
      return std::move(PluginAccess::parameters(prototype));
    }());
    return published.get();
  }

  template <class P>
  static const void* interface_table() {
    static constexpr auto table = P::interface_table();
    return &table;
  }

  static std::int32_t create(const dmrp_entry* /*self*/, const dmrp_host* host, const char* id,
                             const dmrp_params* params, dmrp_plugin* out) {
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
    out->table = interface_table<P>();
    out->start = &start;
    out->get_extension = &get_extension;
    out->destroy = &destroy;
    out->trial_end = &trial_end;
    out->self = detail::to_instance(plugin.release());
    return true;
  }

  static std::int32_t start(dmrp_instance* self, const dmrp_start* c) {
    auto& plugin = detail::from_instance<Plugin>(self);
    return PluginAccess::guarded(plugin, [&] { return PluginAccess::start(plugin, *c); });
  }
  static const void* get_extension(dmrp_instance* self, const char* id) {
    try {
      return detail::from_instance<Plugin>(self).offered_extension(id);
    } catch (...) {
      return nullptr;
    }
  }
  static void destroy(dmrp_instance* self) { delete &detail::from_instance<Plugin>(self); }
  static std::int32_t trial_end(dmrp_instance* self, const dmrp_trial_end* end) {
    auto& plugin = detail::from_instance<Plugin>(self);
    return PluginAccess::guarded(plugin, [&] { return plugin.trial_end(TrialEnd(*end)), Status::ok; });
  }
};

}  // namespace dmrp

#define DMRP_PLUGINS(...)      \
  namespace {                  \
  struct dmrp_plugins_unit {}; \
  }                            \
  DMRP_ENTRY = dmrp::Library<dmrp_plugins_unit, __VA_ARGS__>::entry();
