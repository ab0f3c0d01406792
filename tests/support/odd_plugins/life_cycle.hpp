// SPDX-License-Identifier: MIT
// life_cycle.hpp: start() and trial_end() of every odd plugin.
#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <thread>

#include "tests/support/odd_plugins/instance.hpp"

namespace dmrp::test {

// A thread that outlives the call that started it, until another instance lets it speak.
struct LeftThread {
  std::thread thread;
  std::atomic<bool> may_speak = false;
  std::atomic<bool> was_told_to_stop = false;

  void begin(const dmrp_host* host) {
    may_speak = false;
    thread = std::thread([this, host] {
      while (!may_speak) std::this_thread::yield();
      was_told_to_stop = host->should_stop(host) == 1;
      host->set_error(host, "text of the thread");
    });
  }

  void speak() {
    may_speak = true;
    thread.join();
  }
};

inline LeftThread left_thread;

// A line break, the escape sequence that clears a terminal, a control character of Latin 1, bytes that are not UTF-8.
inline constexpr const char* nasty_text =
    "one\ntwo \x1b[2J \xc2\x9b"
    "1m \xff\xfe caf\xc3\xa9";

inline std::int32_t let_the_thread_speak(const dmrp_instance& self) {
  self.host->set_error(self.host, "text of the call");
  left_thread.speak();
  self.log(left_thread.was_told_to_stop ? "the thread was told to stop" : "the thread was not told to stop");
  self.log(self.host->should_stop(self.host) ? "the call was told to stop" : "the call may go on");
  return DMRP_ERROR;
}

// Asks twice: a host says only once what it refuses.
inline void ask(const dmrp_instance& self, const std::string& id) {
  for (int i = 0; i < 2; ++i) self.log(self.extension(id.c_str()) ? "given" : "not given");
}

inline std::int32_t start(dmrp_instance* self, const dmrp_start* now) {
  self->robot = now->robot;
  self->world = now->world;
  if (self->is("leave a thread")) left_thread.begin(self->host);
  if (self->is("let the thread speak")) return let_the_thread_speak(*self);
  if (self->is("say much")) return self->error(std::string(1u << 20, 'x'));
  if (self->is("log")) self->log(nasty_text);
  if (self->is("warn")) return self->error(nasty_text), DMRP_WARNING;
  if (self->is("fail")) return self->error(nasty_text);
  if (const std::string id = self->after("ask"); !id.empty()) ask(*self, id);
  if (self->is("describe the host")) self->log(std::to_string(self->host->abi_minor) + " " + self->host->library_path);
  return self->status_of("start");
}

inline std::int32_t trial_end(dmrp_instance* self, const dmrp_trial_end* end) {
  self->log("trial_end: ending " + std::to_string(end->ending) + " at " + std::to_string(end->t_ns) + " ns, " +
            std::to_string(end->robot_count) + " robots");
  return self->status_of("trial_end");
}

// All that were not destroyed: the host does not destroy an instance whose create() broke the contract.
inline std::map<dmrp_instance*, std::unique_ptr<dmrp_instance>> living;

inline void destroy(dmrp_instance* self) {
  living.erase(self);
}

}  // namespace dmrp::test
