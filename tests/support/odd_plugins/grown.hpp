// SPDX-License-Identifier: MIT
// grown.hpp: structs and array elements as a plugin makes them that was compiled with other headers than the host's:
// longer by fields of a newer minor version, or shorter than v1.0's, which no plugin may make.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <vector>

namespace dmrp::test {

inline constexpr std::uint8_t unknown_byte = 0x5A;  // in fields that the host does not know

// A growable struct whose size differs by `extra` bytes.
template <class T>
class Grown {
 public:
  Grown(const T& known, int extra) : bytes_(sizeof(T) + 64, unknown_byte) {
    std::memcpy(bytes_.data(), &known, sizeof(T));
    const auto size = static_cast<std::uint32_t>(static_cast<int>(sizeof(T)) + extra);
    std::memcpy(bytes_.data(), &size, sizeof(size));  // struct_size is the first field
  }
  const T* get() const { return reinterpret_cast<const T*>(bytes_.data()); }

 private:
  std::vector<std::uint8_t> bytes_;
};

// An array whose stride differs by `extra` bytes.
template <class T>
class GrownArray {
 public:
  explicit GrownArray(int extra) : stride_(static_cast<std::size_t>(static_cast<int>(sizeof(T)) + extra)) {}

  void push_back(const T& known) {
    bytes_.resize(bytes_.size() + stride_, unknown_byte);
    std::memcpy(bytes_.data() + count_++ * stride_, &known, std::min(stride_, sizeof(T)));
  }
  const T* data() const { return reinterpret_cast<const T*>(bytes_.data()); }
  std::uint32_t count() const { return count_; }
  std::uint32_t stride() const { return static_cast<std::uint32_t>(stride_); }

 private:
  std::size_t stride_;
  std::uint32_t count_ = 0;
  std::vector<std::uint8_t> bytes_;
};

}  // namespace dmrp::test
