// SPDX-License-Identifier: MIT
// mistakes.hpp: readers go on behind a mistake, so that all mistakes of the input are told in one go.
//
//   Mistakes mistakes;
//   mistakes.attempt([&] { size = point(table.need("size_m")); });
//   mistakes.attempt([&] { name = table.need("name").line(); });
//   mistakes.end();  // throws both
#pragma once

#include <cstddef>
#include <vector>

#include "host/errors/input_error.hpp"

namespace dmrp::host {

inline constexpr std::size_t most_mistakes = 100;  // that are told

// Several mistakes, those of a file in the order of its lines; what() is the first.
class InputErrors : public InputError {
 public:
  explicit InputErrors(std::vector<InputError> mistakes);
  const std::vector<InputError>& mistakes() const { return mistakes_; }

 private:
  std::vector<InputError> mistakes_;
};

class Mistakes {
 public:
  // Runs a part of the reading and notes its mistakes. Whether it had none. With `most_mistakes` noted, it runs nothing.
  template <class Part>
  bool attempt(const Part& part) {
    if (noted_.size() >= most_mistakes) return false;
    try {
      part();
      return true;
    } catch (const InputError& mistake) {
      note(mistake);
      return false;
    }
  }

  // Throws all mistakes noted, each once. Returns if there is nothing.
  void end() const;

 private:
  void note(const InputError& mistake);  // one, or all of an InputErrors

  std::vector<InputError> noted_;
};

}  // namespace dmrp::host
