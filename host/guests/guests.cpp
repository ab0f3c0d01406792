// SPDX-License-Identifier: MIT
#include "host/guests/guests.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "host/guests/local_guest.hpp"
#include "host/results/result_json.hpp"

namespace dmrp::host {

namespace {

constexpr std::int64_t create_budget_ns = 10'000'000'000;

// Whether a plugin may be of this library, whose plugins are not known where a test loads it.
bool is_of(const LibraryUse& library, const std::string& id) {
  return library.plugins.empty() || std::any_of(library.plugins.begin(), library.plugins.end(),
                                                [&](const PluginInfo& info) { return info.id == id; });
}

}  // namespace

Guests::Guests(const std::vector<LibraryUse>& libraries, Start start)
    : libraries_(libraries), start_(std::move(start)) {}

Guests Guests::local(const std::vector<LibraryUse>& libraries, CallNote& note, CallGuard& guard, const LogSink& log) {
  return {libraries, [&note, &guard, log](const LibraryUse& library, std::uint32_t) {
            return std::make_unique<LocalGuest>(library, note, guard, log);
          }};
}

void Guests::begin_trial(const BeginInput& trial) {
  trial_ = trial;
  for (const auto& [library, guest] : guests_)
    if (!guest->has_ended()) guest->call({GuestTask::begin_trial, 0, 0, 0, guest->begin().copy(trial)});
}

Guest& Guests::guest(const PluginUse& use) {
  const auto known = guests_.find(use.library);
  if (known != guests_.end() && !known->second->has_ended()) return *known->second;
  end(use.library);
  std::unique_ptr<Guest> made = start_(libraries_.at(use.library), use.info.kind);
  Guest& guest = *(guests_[use.library] = std::move(made));
  guest.call({GuestTask::begin_trial, 0, 0, 0, guest.begin().copy(trial_)});
  return guest;
}

GuestInstance& Guests::get(const PluginUse& use, std::int32_t robot) {
  Guest& guest = this->guest(use);
  GuestInstance& instance = instances_[{&use, robot}];
  if (instance.guest) return instance;
  instance = {nullptr, ++created_, use.info.id, robot};
  guest.begin();
  guest.call({GuestTask::create, instance.number, 0, create_budget_ns}, {},
             nlohmann::json{{"plugin", use.info.id}, {"parameters", use.parameters}, {"robot", robot}}.dump());
  instance.guest = &guest;
  return instance;
}

std::vector<TimingReason> Guests::timing() {
  std::vector<TimingReason> all;
  for (const auto& [library, guest] : guests_) {
    if (guest->has_ended()) continue;
    guest->begin();
    const nlohmann::json json = nlohmann::json::parse(guest->call({GuestTask::timing}), nullptr, false);
    if (!json.is_array()) continue;
    for (const nlohmann::json& reason : json) {
      const bool is_reason = reason.is_array() && reason.size() == 2 && reason[0].is_string() && reason[1].is_string();
      if (is_reason && is_of(libraries_[library], reason[0].get<std::string>()))
        all.push_back(reason.get<TimingReason>());
    }
  }
  return all;
}

void Guests::clear() {
  instances_.clear();
  ask_all({GuestTask::destroy, 0, 0, create_budget_ns});
}

void Guests::ask_all(const GuestRequest& request) {
  for (const auto& [library, guest] : guests_)
    if (!guest->has_ended()) {
      guest->begin();
      guest->call(request);
    }
}

void Guests::end(std::uint32_t library) {
  const auto guest = guests_.find(library);
  if (guest == guests_.end()) return;
  std::erase_if(instances_, [&](const auto& entry) { return entry.second.guest == guest->second.get(); });
  guests_.erase(guest);
}

void Guests::end_all() {
  instances_.clear();
  guests_.clear();
}

void Guests::shut_down() {
  ask_all({GuestTask::destroy});
  ask_all({GuestTask::unload});
  end_all();
}

void Guests::for_each(const std::function<void(const Guest& guest)>& visit) const {
  for (const auto& [library, guest] : guests_)
    if (!guest->has_ended()) visit(*guest);
}

void Guests::visit(std::uint32_t library, const std::function<void(Guest& guest)>& visit) const {
  if (const auto guest = guests_.find(library); guest != guests_.end()) visit(*guest->second);
}

bool Guests::have_served_trials() const {
  return std::any_of(guests_.begin(), guests_.end(), [](const auto& one) { return one.second->trials_begun() > 1; });
}

}  // namespace dmrp::host
