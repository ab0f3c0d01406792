// SPDX-License-Identifier: MIT
// guest_process.hpp: a guest in a process of its own, as its judge sees it.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "host/guests/exchange/guest_memory.hpp"
#include "host/guests/fork_server.hpp"
#include "host/guests/guest.hpp"
#include "host/guests/guest_end.hpp"
#include "host/plugins/plugin_use.hpp"
#include "host/process/child_process.hpp"
#include "host/process/watchdog.hpp"

namespace dmrp::host {

// What the guests of a judge may use.
struct GuestLimits {
  std::filesystem::path scratch;  // for temporary files, where guests have no view of their own
  std::int64_t memory_mb = 0;     // 0: no limit
  double trial_wall_time_s = 0.0;
  std::int32_t plain_log_level =
      -1;                // log lines from this level on, after the plugin's id; -1: all, with trial and time
  unsigned sharers = 1;  // of the processors: judges that run at the same time
};

class GuestProcess : public Guest {
 public:
  using Started = std::function<void(pid_t)>;        // of a process, before it loads the library
  using CheckLimits = std::function<std::string()>;  // now and then: why the trial may not go on, "" if it may

  // Starts the process, and asks it to load the library, or to probe it. `fork_server` and `limits` outlive it. `spool`: of a
  // trace that is too large for memory, -1 for none. Throws MachineError; std::runtime_error if the library cannot be loaded;
  // PluginFault, a GuestEnd for a library that ends the process.
  GuestProcess(const ForkServer& fork_server, const LibraryUse& library, const GuestLimits& limits, GuestTask first,
               int spool, const Started& started, const CheckLimits& check_limits);
  ~GuestProcess() override;

  std::span<const std::uint8_t> annotations() const override;
  bool has_ended() const override { return ended_; }

  // The text of the answer to the first request.
  const std::string& loaded() const { return loaded_; }

  // Ends it. The most memory that it had, in MB.
  double end_process();

  const ChildProcess& process() const { return *process_; }  // until it has ended

 private:
  std::string_view send(const GuestRequest& request, const AnswerQuestion& answer, std::string_view text) override;
  std::string_view read_answer(const GuestRequest& request, std::uint32_t kind);
  void start(const LibraryUse& library, int spool);
  void allow_processor_time();
  void wait(const GuestRequest& request);
  bool is_time_to_check() const;
  void check_limits(const GuestRequest& request);
  void check_call(const GuestRequest& request);
  void check_memory(const GuestRequest& request);
  std::string_view plugin_of(const GuestRequest& request, std::string_view said) const;
  void stop();
  [[noreturn]] void fail(const GuestRequest& request);
  [[noreturn]] void end(const GuestRequest& request, GuestEnd::Ending ending);
  [[noreturn]] void has_died(const GuestRequest& request);

  const ForkServer& fork_server_;
  const GuestLimits& limits_;
  const bool counts_resident_;  // against memory_mb: all pages in use, not those alone that no limit on data counts
  const Started started_;
  const CheckLimits check_limits_;
  std::string written_;
  std::map<std::uint32_t, std::string> instances_;  // the ids of their plugins
  std::unique_ptr<GuestMemory> memory_;
  std::unique_ptr<ChildProcess> process_;
  std::uint32_t turn_ = 0;
  bool ended_ = false;
  std::string answer_;
  std::string loaded_;
  Watchdog watchdog_;
  std::int64_t checked_ns_ = 0;

  // Something that may take so long.
  struct Watch {
    std::int64_t start_ns = 0;
    std::int64_t waited_before_ns = 0;  // by the guest for a processor, before the start
  };
  Watch call_;                     // that was running when the judge checked last
  std::uint64_t call_number_ = 0;  // its number; 0: none was
};

}  // namespace dmrp::host
