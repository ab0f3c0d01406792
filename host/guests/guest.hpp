// SPDX-License-Identifier: MIT
// guest.hpp: a library as the judge sees it, wherever it runs. The judge writes what it asks into the guest's arena, and
// sends one request at a time:
//
//   Arena& arena = guest.begin();
//   auto* const input = arena.make<PeopleInput>();
//   auto* const answer = guest.output().make<CallAnswer>();
//   guest.call({GuestTask::move_people, instance, step, budget_ns, input, answer});
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/guests/exchange/arena.hpp"
#include "host/guests/exchange/guest_request.hpp"
#include "host/guests/exchange/sent_world.hpp"

namespace dmrp::host {

// Answers a question of the guest with a reading in the arena; nullptr: there is none. It runs while the guest waits.
using AnswerQuestion = std::function<const void*(const GuestQuestion& question, Arena& arena)>;

class Guest {
 public:
  Guest() = default;
  virtual ~Guest() = default;
  Guest(const Guest&) = delete;
  Guest& operator=(const Guest&) = delete;

  // Begins a request: takes back what earlier ones have sent, but for worlds and traces.
  Arena& begin();
  Arena& output() { return output_; }

  // The copy of a trial's world with its grids. That of a `shared` world stays as long as the guest, that of another one as
  // long as the trial. Call them before begin().
  SentWorld& shared_world(const dmrp_world& shared, std::span<const dmrp_grid> grids);
  SentWorld& own_world(const dmrp_world& world, const SentWorld& shared, std::span<const dmrp_grid> grids);

  // What a guest is told of a world that stays: with the walking grids that were sent with it.
  SentScene scene(const SentWorld& shared, const std::vector<WalkingGrids::Known>& grids);

  // The copy of the trial's finished trace, made by the first call in a trial. Call it before begin().
  const std::uint8_t* trace(std::span<const std::uint8_t> records);

  // Sends a request, waits for the answer and returns its text, which is valid until the next call. Throws PluginFault; a
  // GuestEnd where the guest is gone.
  std::string_view call(const GuestRequest& request, const AnswerQuestion& answer = {}, const std::string& text = {});

  // What the guest annotated in the last call, also in one that threw.
  virtual std::span<const std::uint8_t> annotations() const = 0;

  // Whether it is gone, and can be asked nothing any more.
  virtual bool has_ended() const { return false; }

  // How many trials it has begun.
  std::uint64_t trials_begun() const { return trials_begun_; }

 protected:
  void set_memory(const Arena& arena, const Arena& output);
  virtual std::string_view send(const GuestRequest& request, const AnswerQuestion& answer, std::string_view text) = 0;

  // The answer to a question, which stays until the request has been answered; nullptr if there is none, or no room for it.
  const void* answered(const GuestQuestion& question, const AnswerQuestion& answer);

 private:
  void forget_trial();

  Arena arena_;
  Arena output_;
  std::size_t shared_mark_ = 0;  // after the worlds that stay
  std::size_t kept_mark_ = 0;    // after all that stays for the trial
  std::uint64_t trials_begun_ = 0;
  std::map<const dmrp_world*, std::unique_ptr<SentWorld>> shared_;
  std::unique_ptr<SentWorld> own_;       // of this trial
  const std::uint8_t* trace_ = nullptr;  // likewise
};

}  // namespace dmrp::host
