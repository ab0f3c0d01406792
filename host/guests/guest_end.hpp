// SPDX-License-Identifier: MIT
// guest_end.hpp: a guest has ended, or was ended by its judge: the fault of the plugin that ran.
#pragma once

#include <cstdint>
#include <string>

#include "host/plugins/calls/plugin_fault.hpp"

namespace dmrp::host {

class GuestEnd : public PluginFault {
 public:
  // How a process ended.
  struct Ending {
    const char* kind;  // fault_kind
    std::string detail;
    int signal = 0;       // 0: none
    bool killed = false;  // by SIGKILL, and not by its judge: by the kernel, when memory is short, or by a person
    bool depends_on_past = true;  // false: another try would take as long
    std::string words{};          // the detail for a person, where it differs
  };

  GuestEnd(const CallSite& site, const Ending& ending)
      : PluginFault(ending.kind, site, ending.detail, true),
        signal_(ending.signal),
        killed_(ending.killed),
        depends_on_past_(ending.depends_on_past),
        words_(ending.words.empty() ? ending.detail : ending.words) {}

  int signal() const { return signal_; }
  bool killed() const { return killed_; }
  bool depends_on_past() const { return depends_on_past_; }
  const std::string& words() const { return words_; }

 private:
  int signal_;
  bool killed_;
  bool depends_on_past_;
  std::string words_;
};

// Explains a fault to a person: "org.example.planner: plan(): crashed (signal 11, Segmentation fault)".
inline std::string words_of(const PluginFault& fault) {
  const auto* const end = dynamic_cast<const GuestEnd*>(&fault);
  return end ? call_text(end->plugin(), end->function(), end->words()) : fault.text();
}

}  // namespace dmrp::host
