// SPDX-License-Identifier: MIT
// examination.hpp: what a case works with, in the child process that runs it: the library, the plugin, and a place for
// findings.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "host/check/rehearsal/rehearsal.hpp"
#include "host/plugins/instance.hpp"
#include "host/plugins/library.hpp"
#include "host/process/call_note.hpp"

namespace dmrp::host {

enum class CheckResult { pass, skip, warn, fail, crash };  // the later, the worse

// A case that does not apply; thrown.
struct Skipped {
  std::string reason;
};

class Examination {
 public:
  // `plugin`: nullptr in cases of the library. `progress` gets the text of at().
  Examination(std::filesystem::path file, const PluginInfo* plugin, std::uint64_t seed, CallNote& note,
              std::function<void(const std::string&)> progress);
  ~Examination();
  Examination(const Examination&) = delete;
  Examination& operator=(const Examination&) = delete;

  const std::filesystem::path& file() const { return file_; }
  const PluginInfo& plugin() const { return *plugin_; }
  std::uint64_t seed() const { return seed_; }
  CallGuard& guard() { return guard_; }

  // Loads the library; from then on it is there, but init() has not been called.
  const Library& library();

  // An instance of the plugin, created after init(); with the declared defaults, or these parameters. `guard`: of the
  // thread that calls it. `grown_bytes`: by which what the host hands to the instance is longer than this host's.
  std::unique_ptr<Instance> create();
  std::unique_ptr<Instance> create_for(std::uint32_t robot);  // that a controller drives
  std::unique_ptr<Instance> create(const std::vector<ParameterValue>& parameters);
  std::unique_ptr<Instance> create(const std::vector<ParameterValue>& parameters, CallGuard& guard,
                                   std::uint32_t grown_bytes = 0, std::uint32_t robot = 0);
  std::vector<ParameterValue> defaults() const;

  // Calls init(), and deinit().
  void init();
  void deinit();

  // Says what is tried from now on: findings, crashes and hangs name it.
  void at(const std::string& what);

  void fail(const std::string& text) { find(CheckResult::fail, text); }
  void warn(const std::string& text) { find(CheckResult::warn, text); }
  void note(const std::string& text) { find(CheckResult::pass, text); }  // what was measured

  // What a call takes of the processor: other cases make fewer, if it is much.
  void calls_take(std::int64_t ns) { call_ns_ = ns; }
  std::int64_t call_ns() const { return call_ns_; }

  CheckResult result() const { return result_; }
  const std::string& text() const { return text_; }  // of all findings, in one line

  // What the plugin has logged: the warnings and errors among it.
  std::vector<std::string> complaints() const;

 private:
  void find(CheckResult result, const std::string& text);
  void log(std::int32_t level, const std::string& text);

  std::filesystem::path file_;
  const PluginInfo* plugin_;
  std::uint64_t seed_;
  CallGuard guard_;
  std::function<void(const std::string&)> progress_;
  std::optional<Library> library_;
  std::unique_ptr<PluginHost> host_;  // of the library, from init() to deinit()
  std::string at_;
  CheckResult result_ = CheckResult::pass;
  std::string text_;
  std::int64_t call_ns_ = 0;
  mutable std::mutex log_mutex_;
  std::vector<std::string> complaints_;
};

// Fails at the first number that differs, to the bit.
void expect_same(Examination& it, const Outputs& outputs, const Outputs& expected);

// What a new instance gives in a rehearsal.
Outputs alone(Examination& it, std::uint64_t seed);
Outputs rehearse_on(Examination& it, const StageSettings& settings);

}  // namespace dmrp::host
