// SPDX-License-Identifier: MIT
// The shared library that both plugins bring along, under one name.
#include "tests/end_to_end/isolation/gain.hpp"

extern "C" double gain_of_library() {
  return GAIN;
}
