// SPDX-License-Identifier: MIT
// pluginlib without libraries: PLUGINLIB_EXPORT_CLASS enters a class in a list of this library, and a ClassLoader looks
// it up by its name in C++.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

namespace pluginlib {

struct PluginlibException : std::runtime_error {
  using std::runtime_error::runtime_error;
};

template <class Base>
using UniquePtr = std::unique_ptr<Base>;

template <class Base>
std::map<std::string, std::function<std::unique_ptr<Base>()>>& classes() {
  static std::map<std::string, std::function<std::unique_ptr<Base>()>> list;
  return list;
}

template <class Class, class Base>
struct Registration {
  explicit Registration(const char* name) {
    classes<Base>()[name] = [] { return std::make_unique<Class>(); };
  }
};

template <class Base>
class ClassLoader {
 public:
  ClassLoader(const std::string& /*package*/, std::string base) : base_(std::move(base)) {}

  bool isClassAvailable(const std::string& name) const { return classes<Base>().count(name) != 0; }
  UniquePtr<Base> createUniqueInstance(const std::string& name) const {
    const auto found = classes<Base>().find(name);
    if (found != classes<Base>().end()) return found->second();
    std::string known;
    for (const auto& entry : classes<Base>()) known += (known.empty() ? "" : ", ") + entry.first;
    throw PluginlibException("no class '" + name + "' of the base " + base_ + " in this library; it has " + known);
  }
  std::shared_ptr<Base> createSharedInstance(const std::string& name) const { return createUniqueInstance(name); }
  Base* createUnmanagedInstance(const std::string& name) const { return createUniqueInstance(name).release(); }

 private:
  std::string base_;
};

}  // namespace pluginlib

#define NAV2_SHIM_JOIN_(a, b) a##b
#define NAV2_SHIM_JOIN(a, b) NAV2_SHIM_JOIN_(a, b)
#define PLUGINLIB_EXPORT_CLASS(Class, Base)                                                                \
  namespace {                                                                                              \
  const pluginlib::Registration<Class, Base> NAV2_SHIM_JOIN(pluginlib_registration_, __COUNTER__)(#Class); \
  }
