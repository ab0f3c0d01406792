// SPDX-License-Identifier: MIT
// mistake_text.hpp: mistakes of the input as text for people: a line each, and below it the line of the file, with a
// caret under the place.
#pragma once

#include <string>

#include "host/errors/input_error.hpp"

namespace dmrp::host {

// All mistakes of `error`; ends with a line break.
std::string mistake_text(const InputError& error, bool colors);

}  // namespace dmrp::host
