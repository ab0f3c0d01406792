// SPDX-License-Identifier: MIT
// fp_control.hpp: the floating-point control bits (rounding, flush to zero, exception masks). A library built with
// -ffast-math sets some of them when it is loaded, and every later result in the process changes.
#pragma once

#include <cstdint>

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

namespace dmrp::host {

#if defined(__x86_64__)
constexpr std::uint32_t fp_control_mask = 0xffc0;  // all of MXCSR but the exception flags
inline std::uint32_t fp_control() {
  return _mm_getcsr() & fp_control_mask;
}
inline void set_fp_control(std::uint32_t bits) {
  _mm_setcsr((_mm_getcsr() & ~fp_control_mask) | bits);
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
