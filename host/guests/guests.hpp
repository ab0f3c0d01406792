// SPDX-License-Identifier: MIT
// guests.hpp: the guests of a judge, one for each library that its trials use, and their plugin instances, which last for
// many trials.
#pragma once

#include <compare>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "host/guests/guest.hpp"
#include "host/plugins/calls/call_guard.hpp"
#include "host/plugins/calls/timing_reason.hpp"
#include "host/plugins/plugin_host.hpp"
#include "host/plugins/plugin_use.hpp"

namespace dmrp::host {

// An instance of a guest.
struct GuestInstance {
  Guest* guest = nullptr;
  std::uint32_t number = 0;
  std::string id;  // of its plugin
  std::int32_t robot = -1;

  CallSite site(const char* function, std::int64_t step) const { return {id, function, step, robot}; }
};

class Guests {
 public:
  // Starts the guest of a library, for this kind of plugin or more.
  using Start = std::function<std::unique_ptr<Guest>(const LibraryUse& library, std::uint32_t kind)>;

  // `libraries` outlives it.
  Guests(const std::vector<LibraryUse>& libraries, Start start);

  // Makes guests that run in this process, for debuggers and tests. The guard, whose note this is, outlives them.
  static Guests local(const std::vector<LibraryUse>& libraries, CallNote& note, CallGuard& guard, const LogSink& log);

  // A trial begins: for all guests, and those that are started in it.
  void begin_trial(const BeginInput& trial);

  // The instance for this use of a plugin, created by the first call. `use` is identified by its address and outlives this
  // object. `robot`: of a local controller, -1 otherwise. Throws PluginFault.
  GuestInstance& get(const PluginUse& use, std::int32_t robot);

  // Why the results of this trial depend on timing: of the guests that there still are.
  std::vector<TimingReason> timing();

  // Destroys all instances: after an error, new ones are safer. Throws PluginFault.
  void clear();

  // Ends the guest of a library, if there is one; the next get() starts another. Or all of them.
  void end(std::uint32_t library);
  void end_all();

  // Calls destroy() and deinit() of all plugins, which get a few seconds for it, and ends their guests. Throws PluginFault.
  void shut_down();

  // All that there are.
  void for_each(const std::function<void(const Guest& guest)>& visit) const;

  // The guest of a library, if there is one.
  void visit(std::uint32_t library, const std::function<void(Guest& guest)>& visit) const;

  // Whether a guest has begun other trials than this one.
  bool have_served_trials() const;

 private:
  struct Key {
    const PluginUse* use;  // only for identity: no result depends on the order of the keys
    std::int32_t robot;
    auto operator<=>(const Key&) const = default;
  };

  void ask_all(const GuestRequest& request);
  Guest& guest(const PluginUse& use);

  const std::vector<LibraryUse>& libraries_;
  Start start_;
  BeginInput trial_{};
  std::uint32_t created_ = 0;
  std::map<std::uint32_t, std::unique_ptr<Guest>> guests_;  // by library
  std::map<Key, GuestInstance> instances_;
};

}  // namespace dmrp::host
