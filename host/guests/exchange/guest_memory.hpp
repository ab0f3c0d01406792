// SPDX-License-Identifier: MIT
// guest_memory.hpp: the memory that a judge shares with a guest process: a part that the judge alone can write, and one that
// both can. Each side has them at the same addresses. Whose turn it is stands in a number on each part, on which the other
// side waits in the kernel.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>

#include "host/guests/exchange/arena.hpp"
#include "host/guests/exchange/guest_request.hpp"
#include "host/process/call_note.hpp"
#include "host/process/descriptor.hpp"

namespace dmrp::host {

// It stands at the beginning of the judge's part.
struct JudgePage {
  std::atomic<std::uint32_t> turn;  // one more with every message of the judge
  GuestRequest request;
  std::uint64_t text_bytes;  // of the request, at `text`
  const char* text;
  const void* answer;  // to the guest's question
};

// It stands at the beginning of the guest's part. The guest can write anything there, at any time.
struct GuestPage {
  enum Kind : std::uint32_t { answer, fault, question, failure };

  std::atomic<std::uint32_t> turn;  // the judge's turn that this message answers
  std::uint32_t kind;
  GuestQuestion asked;
  std::uint64_t text_bytes;                     // of the answer; JSON of a FaultRecord; the failure in one line
  std::uint64_t annotation_bytes;               // of AnnotationBuffer
  std::atomic<std::uint32_t> wrote_into_input;  // 1: it crashed by that
  CallNote note;
};

class GuestMemory {
 public:
  // The judge's side: makes and maps both parts. Throws MachineError.
  GuestMemory();

  // What a guest needs to map them.
  struct Place {
    int judge_descriptor;
    int guest_descriptor;
    std::uintptr_t address;
    std::size_t part_bytes;
  };
  Place place() const;

  // The guest's side: closes the descriptors. Throws MachineError; std::runtime_error if the addresses are taken.
  explicit GuestMemory(const Place& place);

  ~GuestMemory();
  GuestMemory(const GuestMemory&) = delete;
  GuestMemory& operator=(const GuestMemory&) = delete;

  JudgePage& judge() const { return *static_cast<JudgePage*>(memory_); }
  GuestPage& guest() const;
  CallNote& note() const { return guest().note; }

  // The size of a part, in this process's limits.
  static std::size_t part_bytes();

  Arena judge_arena() const;
  Arena output_arena() const;  // the first half of what the guest can write
  char* text() const;          // after it, as much as text_room()
  std::uint8_t* annotations() const;
  std::size_t text_room() const { return part_bytes_ / 4; }

  // Whether an address lies in the part that the guest can only read.
  bool is_read_only(const void* address) const;

  // The resident bytes of both parts.
  std::size_t bytes_in_use() const;

  // Waits until `turn` is not `seen` any more. False after this time, or when a signal came.
  static bool wait(const std::atomic<std::uint32_t>& turn, std::uint32_t seen, std::chrono::milliseconds longest);
  // Gives `turn` a value, and wakes the side that waits for it.
  static void give(std::atomic<std::uint32_t>& turn, std::uint32_t value);

 private:
  Descriptor judge_part_;
  Descriptor guest_part_;
  void* memory_ = nullptr;
  std::size_t part_bytes_ = 0;
};

}  // namespace dmrp::host
