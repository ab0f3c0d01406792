// SPDX-License-Identifier: MIT
// input_error.hpp: the user's input cannot be used. One line, `file:line:column: what was expected`; exit status 2.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>

#include "host/errors/one_line.hpp"

namespace dmrp::host {

// Where a mistake stands in a file.
struct SourcePlace {
  std::string file;        // as shown; "": the mistake stands in no file
  std::size_t line = 0;    // counted from 1
  std::size_t column = 0;  // in characters, counted from 1
  std::string text;        // of the line
};

class InputError : public std::runtime_error {
 public:
  explicit InputError(std::string line, SourcePlace place = {})
      : std::runtime_error(one_line(std::move(line))), place_(std::move(place)) {}

  const SourcePlace& place() const { return place_; }

 private:
  SourcePlace place_;
};

}  // namespace dmrp::host
