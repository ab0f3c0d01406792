// SPDX-License-Identifier: MIT
// random.hpp: reproducible random numbers.
//
// A Stream is identified by its name: a seed, a purpose and any number of indices. Equal names give equal numbers,
// different names independent ones, so that one part may draw more or fewer numbers without affecting any other part:
//
//   Stream speeds(world_seed, "pedestrian.speed", repetition, person);
//   const double speed = speeds.truncated_normal(1.2, 0.2, 0.5, 2.0);
//
// The generator is Philox4x32-10 (Salmon, Moraes, Dror, Shaw: Parallel random numbers: as easy as 1, 2, 3. SC 2011):
// a bijection of a 128-bit counter under a 64-bit key. The name gives the key and the counter's upper half, 128 bits
// in all; the lower half counts blocks. Two names share numbers only if all those bits collide.
//
// normal() and truncated_normal() use log, exp and cos, so their results are equal to the bit with the same libm; the
// results of all others are equal on every machine.
#pragma once

#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string_view>
#include <type_traits>
#include <utility>

namespace dmrp::toolkit {

// One block of Philox4x32-10.
inline std::array<std::uint32_t, 4> philox4x32_10(std::array<std::uint32_t, 4> counter,
                                                  std::array<std::uint32_t, 2> key) {
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t product_0 = std::uint64_t{0xD2511F53u} * counter[0];
    const std::uint64_t product_1 = std::uint64_t{0xCD9E8D57u} * counter[2];
    counter = {static_cast<std::uint32_t>(product_1 >> 32) ^ counter[1] ^ key[0], static_cast<std::uint32_t>(product_1),
               static_cast<std::uint32_t>(product_0 >> 32) ^ counter[3] ^ key[1],
               static_cast<std::uint32_t>(product_0)};
    key[0] += 0x9E3779B9u;  // golden ratio
    key[1] += 0xBB67AE85u;  // sqrt(3) - 1
  }
  return counter;
}

// Chains values into 64 bits: after each, the state goes through SplitMix64's finaliser (Steele, Lea, Flood 2014), a
// bijection, so that a chain depends on every value and on their order.
class KeyChain {
 public:
  explicit constexpr KeyChain(std::uint64_t start) : state_(start) {}

  constexpr void add(std::uint64_t value) {
    std::uint64_t z = (state_ + 0x9E3779B97F4A7C15u) ^ value;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    state_ = z ^ (z >> 31);
  }

  // Eight bytes per value, little-endian, then the length, so that different texts give different chains.
  constexpr void add(std::string_view text) {
    for (std::size_t begin = 0; begin < text.size(); begin += 8) {
      std::uint64_t word = 0;
      for (std::size_t i = begin; i < text.size() && i < begin + 8; ++i)
        word |= std::uint64_t{static_cast<unsigned char>(text[i])} << (8 * (i - begin));
      add(word);
    }
    add(std::uint64_t{text.size()});
  }

  constexpr std::uint64_t value() const { return state_; }

 private:
  std::uint64_t state_;
};

// A small value type; a copy continues with the same numbers.
class Stream {
 public:
  // Indices are integers (negative ones too) or text.
  template <class... Index>
  explicit Stream(std::uint64_t seed, std::string_view purpose, const Index&... index)
      : key_(chain(0, seed, purpose, index...)), upper_(chain(0x243F6A8885A308D3u, seed, purpose, index...)) {}

  std::uint64_t next_u64() {
    if (used_ == block_.size()) refill();
    return block_[used_++];
  }

  // In [0, 1), a multiple of 2^-53.
  double uniform() { return static_cast<double>(next_u64() >> 11) * 0x1.0p-53; }

  // In [low, high), for finite low < high; low if they are equal. Never `high`, despite rounding.
  double uniform(double low, double high) {
    assert(std::isfinite(low) && std::isfinite(high) && low <= high);
    const double value = low + (high - low) * uniform();
    return value < high ? value : std::nextafter(high, low);
  }

  // In [0, count), each with the same probability; count > 0.
  std::uint64_t below(std::uint64_t count) {
    assert(count > 0);
    const std::uint64_t surplus = (std::uint64_t{0} - count) % count;  // 2^64 mod count
    std::uint64_t value = next_u64();
    while (value < surplus) value = next_u64();
    return value % count;
  }

  // True with this probability.
  bool chance(double probability) { return uniform() < probability; }

  // Standard normal (Box-Muller, the cosine half). Always takes two draws, so that streams stay aligned.
  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));  // the argument of log is in (0, 1]
    return radius * std::cos(6.28318530717958647692 * uniform());
  }

  double normal(double mean, double deviation) { return mean + deviation * normal(); }

  // Exact by rejection, in the tails too (Robert: Simulation of truncated normal variables, 1995). In [low, high], for
  // low <= high (either may be infinite) and deviation >= 0; at deviation 0 the mean, clamped.
  double truncated_normal(double mean, double deviation, double low, double high) {
    assert(low <= high && deviation >= 0.0);
    if (deviation == 0.0) return clamp(mean, low, high);
    const double from = (low - mean) / deviation;
    const double to = (high - mean) / deviation;
    const double z = from > 0.0 ? truncated_tail(from, to)
                     : to < 0.0 ? -truncated_tail(-to, -from)
                                : around_zero(from, to);
    return clamp(mean + deviation * z, low, high);
  }

  // Fisher-Yates: every order has the same probability.
  template <class RandomAccessIterator>
  void shuffle(RandomAccessIterator first, RandomAccessIterator last) {
    using Difference = typename std::iterator_traits<RandomAccessIterator>::difference_type;
    using std::swap;
    for (auto remaining = static_cast<std::uint64_t>(last - first); remaining > 1; --remaining)
      swap(first[static_cast<Difference>(remaining - 1)], first[static_cast<Difference>(below(remaining))]);
  }

  template <class Range>
  void shuffle(Range& range) {
    shuffle(std::begin(range), std::end(range));
  }

 private:
  template <class Value>
  static void add(KeyChain& chain, const Value& value) {
    if constexpr (std::is_integral_v<Value> || std::is_enum_v<Value>) {
      chain.add(static_cast<std::uint64_t>(value));
    } else {
      chain.add(std::string_view(value));
    }
  }

  template <class... Index>
  static std::uint64_t chain(std::uint64_t start, std::uint64_t seed, std::string_view purpose, const Index&... index) {
    KeyChain chain(start);
    chain.add(seed);
    chain.add(purpose);
    (add(chain, index), ...);
    return chain.value();
  }

  static double clamp(double value, double low, double high) { return value < low ? low : value > high ? high : value; }

  void refill() {
    const auto words = philox4x32_10({low_half(count_), high_half(count_), low_half(upper_), high_half(upper_)},
                                     {low_half(key_), high_half(key_)});
    block_ = {words[0] | std::uint64_t{words[1]} << 32, words[2] | std::uint64_t{words[3]} << 32};
    ++count_;
    used_ = 0;
  }

  static std::uint32_t low_half(std::uint64_t value) { return static_cast<std::uint32_t>(value); }
  static std::uint32_t high_half(std::uint64_t value) { return static_cast<std::uint32_t>(value >> 32); }

  // Standard normal in [from, to], from <= 0 <= to: by rejection from the normal if that accepts often, otherwise from
  // the uniform distribution.
  double around_zero(double from, double to) {
    if (to - from > 2.50662827463100050242) {  // sqrt(2 pi)
      for (;;) {
        const double z = normal();
        if (z >= from && z <= to) return z;
      }
    }
    for (;;) {
      const double z = from + (to - from) * uniform();
      if (uniform() < std::exp(-0.5 * z * z)) return z;
    }
  }

  // Standard normal in [from, to], from > 0: by rejection from a translated exponential, or from the uniform
  // distribution if the interval is narrow.
  double truncated_tail(double from, double to) {
    if (from > 1e8) return from;  // the tail is narrower than the spacing of doubles
    const double root = std::sqrt(from * from + 4.0);
    const double rate = 0.5 * (from + root);
    if (to - from > std::exp(0.5 + 0.25 * (from * from - from * root)) / rate) {
      for (;;) {
        const double z = from - std::log(1.0 - uniform()) / rate;
        const bool accepted = uniform() < std::exp(-0.5 * (z - rate) * (z - rate));
        if (accepted && z <= to) return z;
      }
    }
    for (;;) {
      const double z = from + (to - from) * uniform();
      if (uniform() < std::exp(0.5 * (from - z) * (from + z))) return z;
    }
  }

  std::uint64_t key_;
  std::uint64_t upper_;
  std::uint64_t count_ = 0;
  std::array<std::uint64_t, 2> block_ = {};
  std::size_t used_ = 2;
};

}  // namespace dmrp::toolkit
