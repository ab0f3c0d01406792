// SPDX-License-Identifier: MIT
#include "host/guests/guest.hpp"

#include <new>

namespace dmrp::host {

void Guest::set_memory(const Arena& arena, const Arena& output) {
  arena_ = arena;
  output_ = output;
}

Arena& Guest::begin() {
  arena_.rewind(kept_mark_);
  output_.rewind(0);
  return arena_;
}

void Guest::forget_trial() {
  own_.reset();
  trace_ = nullptr;
  kept_mark_ = shared_mark_;
}

SentWorld& Guest::shared_world(const dmrp_world& shared, std::span<const dmrp_grid> grids) {
  std::unique_ptr<SentWorld>& known = shared_[&shared];
  if (known) return *known;
  forget_trial();
  begin();
  known = std::make_unique<SentWorld>(arena_, shared);
  for (const dmrp_grid& grid : grids) known->add_grid(arena_, grid);
  shared_mark_ = kept_mark_ = arena_.mark();
  return *known;
}

SentWorld& Guest::own_world(const dmrp_world& world, const SentWorld& shared, std::span<const dmrp_grid> grids) {
  if (own_) return *own_;
  begin();
  own_ = std::make_unique<SentWorld>(arena_, world, shared);
  for (const dmrp_grid& grid : grids) own_->add_grid(arena_, grid);
  kept_mark_ = arena_.mark();
  return *own_;
}

SentScene Guest::scene(const SentWorld& shared, const std::vector<WalkingGrids::Known>& grids) {
  std::vector<WalkingGrids::Known> sent;
  for (const WalkingGrids::Known& grid : grids)
    if (const dmrp_grid* const copy = shared.find_grid(grid.view))
      sent.push_back({grid.resolution_m, grid.radius_m, *copy});
  return {&shared.world(), static_cast<std::uint32_t>(sent.size()), arena_.copy(sent.data(), sent.size())};
}

const std::uint8_t* Guest::trace(std::span<const std::uint8_t> records) {
  if (trace_) return trace_;
  trace_ = begin().copy(records.data(), records.size());
  kept_mark_ = arena_.mark();
  return trace_;
}

std::string_view Guest::call(const GuestRequest& request, const AnswerQuestion& answer, const std::string& text) {
  if (request.task == GuestTask::begin_trial) {
    ++trials_begun_;
    forget_trial();
  }
  const char* const sent = text.empty() ? nullptr : arena_.copy_text(text);
  return send(request, answer, {sent, text.size()});
}

const void* Guest::answered(const GuestQuestion& question, const AnswerQuestion& answer) {
  if (!answer) return nullptr;
  try {
    return answer(question, arena_);
  } catch (const std::bad_alloc&) {  // a guest can ask without end
    return nullptr;
  }
}

}  // namespace dmrp::host
