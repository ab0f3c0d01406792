// SPDX-License-Identifier: MIT
// local_guest.hpp: a guest in this process, for debuggers and tests. A plugin that writes into what it may only read crashes
// there; nothing else protects one from the other.
#pragma once

#include "host/guests/guest.hpp"
#include "host/guests/inside/guest_runtime.hpp"

namespace dmrp::host {

class LocalGuest : public Guest {
 public:
  // The guard, whose note this is, is shared by all guests of the process. Throws MachineError.
  LocalGuest(const LibraryUse& library, CallNote& note, CallGuard& guard, LogSink log);
  ~LocalGuest() override;

  std::span<const std::uint8_t> annotations() const override { return runtime_.annotations().bytes; }

 private:
  std::string_view send(const GuestRequest& request, const AnswerQuestion& answer, std::string_view text) override;

  void let_write(bool allowed);  // into what is sent

  const AnswerQuestion* answer_ = nullptr;  // of the request that runs
  std::string answer_text_;
  mutable GuestRuntime runtime_;
  void* memory_ = nullptr;
};

}  // namespace dmrp::host
