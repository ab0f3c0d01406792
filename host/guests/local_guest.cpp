// SPDX-License-Identifier: MIT
#include "host/guests/local_guest.hpp"

#include <sys/mman.h>

#include <cerrno>
#include <utility>

#include "host/errors/machine_error.hpp"

namespace dmrp::host {

namespace {

constexpr std::size_t part_bytes = std::size_t{1} << 30;  // of the address space: unused pages take no memory

}  // namespace

LocalGuest::LocalGuest(const LibraryUse& library, CallNote& note, CallGuard& guard, LogSink log)
    : runtime_(library.written, library.file, note, guard, std::move(log),
               [this](const GuestQuestion& question) {
                 let_write(true);
                 const void* const answer = answered(question, *answer_);
                 let_write(false);
                 return answer;
               }),
      memory_(
          mmap(nullptr, 2 * part_bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0)) {
  if (memory_ == MAP_FAILED) throw MachineError("mmap", errno);
  set_memory(Arena(memory_, part_bytes), Arena(static_cast<std::byte*>(memory_) + part_bytes, part_bytes));
  call({GuestTask::load});
}

LocalGuest::~LocalGuest() {
  runtime_.answer({GuestTask::destroy}, "");
  munmap(memory_, 2 * part_bytes);
}

std::string_view LocalGuest::send(const GuestRequest& request, const AnswerQuestion& answer, std::string_view text) {
  answer_ = &answer;
  let_write(false);
  try {
    answer_text_ = runtime_.answer(request, std::string(text));
  } catch (...) {
    let_write(true);
    throw;
  }
  let_write(true);
  return answer_text_;
}

void LocalGuest::let_write(bool allowed) {
  mprotect(memory_, part_bytes, allowed ? PROT_READ | PROT_WRITE : PROT_READ);
}

}  // namespace dmrp::host
