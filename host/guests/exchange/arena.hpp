// SPDX-License-Identifier: MIT
// arena.hpp: memory that is given out from front to back and taken back all at once. What the judge sends to a guest lies
// in one: the guest maps it at the same address, so that pointers hold on both sides.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <new>
#include <span>
#include <string_view>
#include <type_traits>

namespace dmrp::host {

class Arena {
 public:
  Arena() = default;
  Arena(void* memory, std::size_t bytes) : memory_(static_cast<std::byte*>(memory)), bytes_(bytes) {}

  // What was given out after the mark is free again.
  std::size_t mark() const { return used_; }
  void rewind(std::size_t mark) { used_ = mark; }

  std::size_t room() const { return bytes_ - used_ - alignof(std::max_align_t); }  // at least

  // Uninitialised elements. Throws std::bad_alloc if there is no room.
  template <class T>
  T* make(std::size_t count = 1) {
    static_assert(std::is_trivially_copyable_v<T>);
    constexpr std::size_t alignment = std::max(alignof(T), sizeof(void*));
    const std::size_t begin = (used_ + alignment - 1) / alignment * alignment;
    if (begin > bytes_ || count > (bytes_ - begin) / sizeof(T)) throw std::bad_alloc();
    used_ = begin + count * sizeof(T);
    return reinterpret_cast<T*>(memory_ + begin);
  }

  template <class T>
  T* copy(const T* elements, std::size_t count) {
    T* const copied = make<T>(count);
    if (count > 0) std::memcpy(copied, elements, count * sizeof(T));
    return copied;
  }
  template <class T>
  T* copy(const T& one) {
    return copy(&one, 1);
  }
  const char* copy_text(std::string_view text) {
    char* const copied = make<char>(text.size() + 1);
    std::memcpy(copied, text.data(), text.size());
    copied[text.size()] = '\0';
    return copied;
  }

 private:
  std::byte* memory_ = nullptr;
  std::size_t bytes_ = 0;
  std::size_t used_ = 0;
};

}  // namespace dmrp::host
