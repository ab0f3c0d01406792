// SPDX-License-Identifier: MIT
// fp_control.hpp: the floating-point control bits (rounding, flush to zero, exception masks). A library built with
// -ffast-math changes them when it is loaded, and with them every later result of the process.
#pragma once

#include <cstdint>

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

namespace dmrp::host {

#if defined(__x86_64__)
// The x87 control word (long double, fegetround()) in the upper half, MXCSR without the exception flags in the lower.
constexpr std::uint32_t fp_control_mask = 0xffc0;
inline std::uint32_t fp_control() {
  std::uint16_t x87;
  __asm__ volatile("fnstcw %0" : "=m"(x87));
  return static_cast<std::uint32_t>(x87) << 16 | (_mm_getcsr() & fp_control_mask);
}
inline void set_fp_control(std::uint32_t bits) {
  const auto x87 = static_cast<std::uint16_t>(bits >> 16);
  __asm__ volatile("fldcw %0" : : "m"(x87));
  _mm_setcsr((_mm_getcsr() & ~fp_control_mask) | (bits & fp_control_mask));
}
#elif defined(__aarch64__)
inline std::uint32_t fp_control() {
  std::uint64_t bits;
  __asm__ volatile("mrs %0, fpcr" : "=r"(bits));
  return static_cast<std::uint32_t>(bits);
}
inline void set_fp_control(std::uint32_t bits) {
  __asm__ volatile("msr fpcr, %0" : : "r"(static_cast<std::uint64_t>(bits)));
}
#else
#error "floating-point control bits of this processor are not known here"
#endif

}  // namespace dmrp::host
