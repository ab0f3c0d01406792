/* SPDX-License-Identifier: MIT */
// mixed.h: a number that depends on every field that a plugin has read, in order: a field that is read at another place
// changes it. By operations that are exact everywhere.
#ifndef MIXED_H
#define MIXED_H

#include <dmrp/values.h>
#include <math.h>
#include <string.h>

typedef struct {
  double sum;
} mixed;

static inline void mix(mixed* all, double value) {
  if (value != value) value = 0.25;
  if (value > 1e6 || value < -1e6) value = 0.75;
  all->sum = fmod(all->sum * 1.25 + value, 64.0);
}
static inline void mix_text(mixed* all, const char* text) {
  for (; text && *text; ++text) mix(all, (double)*text);
}
static inline void mix_time(mixed* all, int64_t ns) {
  mix(all, (double)ns * 1e-9);
}

// Between -1 and 1.
static inline double mixed_value(const mixed* all) {
  return all->sum / 64.0;
}

#endif
