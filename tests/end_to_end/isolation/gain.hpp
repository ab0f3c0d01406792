// SPDX-License-Identifier: MIT
// gain.hpp: what two authors have copied into their plugins, each with another value: a header, and a shared library.
#pragma once

namespace gain {

// Without -fvisibility=hidden one object for the process, whatever library it is in.
inline double& of_header() {
  static double value = GAIN;
  return value;
}

}  // namespace gain

extern "C" double gain_of_library();
