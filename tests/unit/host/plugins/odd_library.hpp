// SPDX-License-Identifier: MIT
// odd_library.hpp: the library of odd plugins, whose entry and descriptors a test changes before the host reads them.
#pragma once

#include <dlfcn.h>
#include <dmrp/entry.h>

#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "host/plugins/instance.hpp"
#include "tests/unit/host/trial/stage.hpp"

namespace dmrp::test {

// Gives entry and descriptors back as they were.
class OddLibrary {
 public:
  OddLibrary() {
    void* const library = dlopen(DMRP_ODD_PLUGINS, RTLD_NOW | RTLD_LOCAL);
    if (!library) throw std::runtime_error(dlerror());
    entry_ = static_cast<dmrp_entry*>(dlsym(library, DMRP_ENTRY_SYMBOL));
    entry_before_ = *entry_;
    for (std::uint32_t i = 0; i < entry_->plugin_count(entry_); ++i)
      before_.push_back(*const_cast<dmrp_descriptor*>(entry_->descriptor(entry_, i)));
  }
  ~OddLibrary() {
    *entry_ = entry_before_;
    for (std::uint32_t i = 0; i < before_.size(); ++i) descriptor(i) = before_[i];
  }
  OddLibrary(const OddLibrary&) = delete;
  OddLibrary& operator=(const OddLibrary&) = delete;

  dmrp_entry& entry() const { return *entry_; }
  dmrp_descriptor& descriptor(std::uint32_t index) const {
    return const_cast<dmrp_descriptor&>(*entry_before_.descriptor(entry_, index));
  }

  // The traits of the descriptor `index`: dmrp_planner_traits, dmrp_metric_traits.
  template <class Traits>
  Traits& traits(std::uint32_t index) const {
    return *static_cast<Traits*>(const_cast<void*>(descriptor(index).traits));
  }

  // Why the host does not load the library; "" if it does.
  static std::string refusal() {
    try {
      const host::Library library(DMRP_ODD_PLUGINS);
      return "";
    } catch (const std::runtime_error& error) {
      return error.what();
    }
  }

 private:
  dmrp_entry* entry_;
  dmrp_entry entry_before_;
  std::vector<dmrp_descriptor> before_;
};

// The order of the descriptors.
inline constexpr std::uint32_t odd_planner = 0, odd_controller = 1, odd_metric = 4, odd_stranger = 5;

// A hall with two robots, and people where there is a model of them.
inline core::Scenario odd_hall(bool with_people) {
  core::Scenario scenario = hall(2);
  if (!with_people) return scenario;
  scenario.regions = {{"west", {0.5, 4.8}, {2.0, 5.6}}, {"east", {8.0, 4.8}, {9.5, 5.6}}};
  scenario.flows = {{"across", {0, 1}, 3}};
  return scenario;
}

// A trial with odd plugins, of which the one with `id` does `does`. Needs no OddLibrary.
struct OddStage : Stage {
  explicit OddStage(const std::string& id = "", const std::string& does = "", const std::string& controller = "")
      : Stage(DMRP_ODD_PLUGINS,
              {"test.odd.planner", controller.empty() ? "test.odd.controller" : controller,
               id == "test.odd.people" ? id : "", "test.odd.metric"},
              odd_hall(id == "test.odd.people")) {
    for (auto* uses : {&experiment.global_planners, &experiment.local_controllers, &experiment.pedestrian_models,
                       &experiment.metrics})
      for (host::PluginUse& use : *uses)
        if (use.info.id == id) use.parameters[0].text = does;
  }
};

// One instance outside a trial.
struct OddInstances {
  host::Instance& make(const std::string& does, const std::string& id = "test.odd.controller") {
    host::PluginUse use = use_of(library.plugins(), id);
    use.parameters[0].text = does;
    instances.push_back(std::make_unique<host::Instance>(
        library, use, 0, guard, [this](std::int32_t level, const auto& plugin, const auto& text) {
          log.push_back({level, plugin, text});
        }));
    return *instances.back();
  }

  void start(host::Instance& instance) {
    const dmrp_world world{};
    instance.start(world, 1, 3'600'000'000'000);
  }

  // The fault of create() or start().
  host::PluginFault fault(const std::string& does) {
    try {
      start(make(does));
    } catch (const host::PluginFault& fault) {
      return fault;
    }
    throw std::runtime_error("no fault");
  }

  std::vector<LogLine> log;
  host::CallNote note{};
  host::CallGuard guard{note};
  const host::Library library{DMRP_ODD_PLUGINS};
  std::vector<std::unique_ptr<host::Instance>> instances;
};

}  // namespace dmrp::test
