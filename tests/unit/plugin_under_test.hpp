// SPDX-License-Identifier: MIT
// A plugin driven through its C entry, as a host would: the library loaded from the build tree, an instance made
// from the descriptor's defaults and some overrides, and a fake host that keeps what the plugin says.
//
//   dmrp::test::PluginUnderTest cbs("libdmrp_planners.so", "dmrp.planner.cbs", {{"node_limit", 100}});
//   cbs.host().should_stop = [] { return true; };
//   cbs.start(world, 1);
//   cbs.as<dmrp_global_planner>().plan(cbs.self(), &problem, &sink);
//
// A program that includes this needs the compile definition DMRP_PLUGIN_DIR, the folder of the built plugins, and a
// dependency on the plugin library: see planners/CMakeLists.txt.
#pragma once

#include <dlfcn.h>
#include <dmrp/dmrp.h>

#include <algorithm>
#include <functional>
#include <initializer_list>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace dmrp::test {

// The dmrp_host of one instance. Hooks may be set at any time; without one, should_stop says no and there are no
// extensions. As a host does, it gives only those that the descriptor declares. Never moves: the plugin keeps its
// address.
class FakeHost {
 public:
  struct LogLine {
    int32_t level;
    std::string text;
  };
  std::vector<LogLine> log;
  std::vector<std::string> errors;  // texts of set_error, in order
  std::function<bool()> should_stop;
  int64_t budget_left_ns = 0;
  std::function<const void*(const std::string& id)> get_extension;
  std::map<std::string, const void*> extensions;  // looked up where there is no hook

  // `descriptor`: of the instance's plugin; nullptr for the host of a library, which gives no extensions.
  explicit FakeHost(const dmrp_descriptor* descriptor = nullptr) : descriptor_(descriptor) {
    c_.struct_size = sizeof(c_);
    c_.abi_minor = DMRP_ABI_MINOR;
    c_.context = this;
    c_.name = "fake-host";
    c_.version = "0.0.0";
    c_.library_path = DMRP_PLUGIN_DIR "/";
    c_.log = [](const dmrp_host* host, int32_t level, const char* text) { of(host).log.push_back({level, text}); };
    c_.set_error = [](const dmrp_host* host, const char* text) { of(host).errors.push_back(text); };
    c_.should_stop = [](const dmrp_host* host) -> int32_t {
      return of(host).should_stop && of(host).should_stop() ? 1 : 0;
    };
    c_.budget_left_ns = [](const dmrp_host* host) -> int64_t { return of(host).budget_left_ns; };
    c_.get_extension = [](const dmrp_host* host, const char* id) -> const void* {
      FakeHost& fake = of(host);
      if (!fake.declares(id)) return nullptr;
      if (fake.get_extension) return fake.get_extension(id);
      const auto found = fake.extensions.find(id);
      return found == fake.extensions.end() ? nullptr : found->second;
    };
  }
  FakeHost(const FakeHost&) = delete;
  FakeHost& operator=(const FakeHost&) = delete;

  const dmrp_host* c() const { return &c_; }

 private:
  static FakeHost& of(const dmrp_host* host) { return *static_cast<FakeHost*>(host->context); }

  bool declares(const std::string& id) const {
    if (!descriptor_) return false;
    const dmrp_descriptor& d = *descriptor_;
    return std::find(d.needed, d.needed + d.needed_count, id) != d.needed + d.needed_count ||
           std::find(d.uses, d.uses + d.uses_count, id) != d.uses + d.uses_count;
  }

  const dmrp_descriptor* descriptor_;
  dmrp_host c_{};
};

// What a descriptor says of its plugin's kind: traits_of<dmrp_metric_traits>(descriptor).values.
template <class Traits>
const Traits& traits_of(const dmrp_descriptor& descriptor) {
  return *static_cast<const Traits*>(descriptor.traits);
}

// A loaded plugin library; stays loaded until the program ends.
class PluginLibrary {
 public:
  // `file` is a path, or a name in DMRP_PLUGIN_DIR. Throws std::runtime_error.
  static const PluginLibrary& load(const std::string& file) {
    static std::map<std::string, std::unique_ptr<PluginLibrary>> loaded;
    const std::string path = file.find('/') == std::string::npos ? std::string(DMRP_PLUGIN_DIR "/") + file : file;
    std::unique_ptr<PluginLibrary>& library = loaded[path];
    if (!library) library.reset(new PluginLibrary(path));
    return *library;
  }
  PluginLibrary(const PluginLibrary&) = delete;
  PluginLibrary& operator=(const PluginLibrary&) = delete;
  ~PluginLibrary() { entry_->deinit(entry_); }

  const dmrp_entry& entry() const { return *entry_; }

  // nullptr where the library has no such plugin.
  const dmrp_descriptor* find(const std::string& id) const {
    for (uint32_t i = 0; i < entry_->plugin_count(entry_); ++i)
      if (const dmrp_descriptor* descriptor = entry_->descriptor(entry_, i); id == descriptor->id) return descriptor;
    return nullptr;
  }

 private:
  explicit PluginLibrary(const std::string& path) {
    void* handle = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!handle) throw std::runtime_error(dlerror());
    entry_ = static_cast<const dmrp_entry*>(dlsym(handle, DMRP_ENTRY_SYMBOL));
    if (!entry_) throw std::runtime_error(path + " has no " DMRP_ENTRY_SYMBOL);
    if (entry_->abi_draft != DMRP_ABI_DRAFT) throw std::runtime_error(path + " was built with another draft");
    if (entry_->init(entry_, host_.c()) != DMRP_OK) throw std::runtime_error(path + " failed in init()");
  }

  FakeHost host_;
  const dmrp_entry* entry_ = nullptr;
};

// Values that differ from the defaults. An integer serves for a number too.
using ParamOverride = std::variant<bool, int64_t, double, std::string, std::vector<double>, std::vector<std::string>>;
using ParamOverrides = std::map<std::string, ParamOverride>;

// The complete table for create(), as the host passes it. Throws std::invalid_argument for a key that the plugin
// does not declare or a value of another type; ranges are not checked.
class ParamTable {
 public:
  ParamTable(const dmrp_descriptor& descriptor, ParamOverrides overrides) : overrides_(std::move(overrides)) {
    for (uint32_t i = 0; i < descriptor.param_count; ++i) {
      const dmrp_param_spec& spec = *DMRP_AT(dmrp_param_spec, descriptor.params, descriptor.param_stride, i);
      values_.push_back(
          {spec.key, spec.type, spec.count, spec.integer, spec.number, spec.text, spec.numbers, spec.texts});
    }
    for (const auto& [key, value] : overrides_) set(key, value);
    c_.struct_size = sizeof(c_);
    c_.count = static_cast<uint32_t>(values_.size());
    c_.stride = sizeof(dmrp_param_value);
    c_.values = values_.data();
  }
  ParamTable(const ParamTable&) = delete;
  ParamTable& operator=(const ParamTable&) = delete;

  const dmrp_params* c() const { return &c_; }

 private:
  void set(const std::string& key, const ParamOverride& from) {
    for (dmrp_param_value& to : values_) {
      if (key != to.key) continue;
      if (const auto* flag = std::get_if<bool>(&from); flag && to.type == DMRP_PARAM_BOOL) {
        to.integer = *flag;
      } else if (const auto* integer = std::get_if<int64_t>(&from); integer && to.type == DMRP_PARAM_INT) {
        to.integer = *integer;
      } else if (integer && to.type == DMRP_PARAM_DOUBLE) {
        to.number = static_cast<double>(*integer);
      } else if (const auto* number = std::get_if<double>(&from); number && to.type == DMRP_PARAM_DOUBLE) {
        to.number = *number;
      } else if (const auto* text = std::get_if<std::string>(&from);
                 text && (to.type == DMRP_PARAM_STRING || to.type == DMRP_PARAM_CHOICE || to.type == DMRP_PARAM_PATH)) {
        to.text = text->c_str();
      } else if (const auto* numbers = std::get_if<std::vector<double>>(&from);
                 numbers && to.type == DMRP_PARAM_DOUBLE_ARRAY) {
        to.numbers = numbers->data();
        to.count = static_cast<uint32_t>(numbers->size());
      } else if (const auto* texts = std::get_if<std::vector<std::string>>(&from);
                 texts && to.type == DMRP_PARAM_STRING_ARRAY) {
        std::vector<const char*>& pointers = text_pointers_[key];
        for (const std::string& each : *texts) pointers.push_back(each.c_str());
        to.texts = pointers.data();
        to.count = static_cast<uint32_t>(pointers.size());
      } else {
        throw std::invalid_argument("parameter '" + key + "' has another type");
      }
      return;
    }
    throw std::invalid_argument("no parameter '" + key + "'");
  }

  ParamOverrides overrides_;
  std::map<std::string, std::vector<const char*>> text_pointers_;
  std::vector<dmrp_param_value> values_;
  dmrp_params c_{};
};

// One instance with a host of its own. Destroyed with the object.
class PluginUnderTest {
 public:
  // `library` as in PluginLibrary::load. Throws std::runtime_error where create() fails.
  PluginUnderTest(const std::string& library, const std::string& id, ParamOverrides overrides = {})
      : library_(PluginLibrary::load(library)), descriptor_(library_.find(id)), host_(descriptor_) {
    if (!descriptor_) throw std::runtime_error(library + " has no plugin " + id);
    const ParamTable params(*descriptor_, std::move(overrides));
    c_.struct_size = sizeof(c_);
    if (library_.entry().create(&library_.entry(), host_.c(), descriptor_->id, params.c(), &c_) != DMRP_OK)
      throw std::runtime_error(id + ": " + (host_.errors.empty() ? "create() failed" : host_.errors.back()));
  }
  PluginUnderTest(const PluginUnderTest&) = delete;
  PluginUnderTest& operator=(const PluginUnderTest&) = delete;
  ~PluginUnderTest() { c_.destroy(c_.self); }

  FakeHost& host() { return host_; }
  const dmrp_descriptor& descriptor() const { return *descriptor_; }
  dmrp_instance* self() { return c_.self; }

  // The status of the plugin's start(). `world` must outlive the trial. A local controller drives the first robot.
  int32_t start(const dmrp_world& world, uint64_t seed = 1) {
    const int32_t robot = descriptor_->kind == DMRP_KIND_LOCAL_CONTROLLER ? 0 : DMRP_NO_ROBOT;
    const dmrp_start start = {sizeof(start), robot, seed, &world};
    return c_.start(c_.self, &start);
  }

  // The interface of the plugin's kind: as<dmrp_metric>().finish(plugin.self(), ...).
  template <class Interface>
  const Interface& as() const {
    return *static_cast<const Interface*>(c_.table);
  }

  // An extension that the plugin offers, or nullptr.
  const void* extension(const char* id) { return c_.get_extension ? c_.get_extension(c_.self, id) : nullptr; }

 private:
  const PluginLibrary& library_;
  const dmrp_descriptor* descriptor_;
  FakeHost host_;
  dmrp_plugin c_{};
};

}  // namespace dmrp::test
