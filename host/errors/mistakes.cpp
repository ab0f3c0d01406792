// SPDX-License-Identifier: MIT
#include "host/errors/mistakes.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

namespace dmrp::host {

namespace {

// Files stay in the order in which their first mistakes were found.
std::vector<InputError> in_order_of_lines(std::vector<InputError> mistakes) {
  std::vector<std::string> files;
  for (const InputError& mistake : mistakes)
    if (std::find(files.begin(), files.end(), mistake.place().file) == files.end())
      files.push_back(mistake.place().file);
  const auto rank = [&](const InputError& mistake) {
    const SourcePlace& place = mistake.place();
    return std::tuple(std::find(files.begin(), files.end(), place.file) - files.begin(), place.line, place.column);
  };
  std::stable_sort(mistakes.begin(), mistakes.end(),
                   [&](const InputError& a, const InputError& b) { return rank(a) < rank(b); });
  return mistakes;
}

}  // namespace

InputErrors::InputErrors(std::vector<InputError> mistakes)
    : InputError(in_order_of_lines(mistakes).front()), mistakes_(in_order_of_lines(std::move(mistakes))) {}

void Mistakes::note(const InputError& mistake) {
  if (const auto* const several = dynamic_cast<const InputErrors*>(&mistake)) {
    for (const InputError& one : several->mistakes()) note(one);
    return;
  }
  const auto is_same = [&](const InputError& other) { return std::string_view(other.what()) == mistake.what(); };
  if (noted_.size() < most_mistakes && std::none_of(noted_.begin(), noted_.end(), is_same)) noted_.push_back(mistake);
}

void Mistakes::end() const {
  if (noted_.size() == 1) throw noted_.front();
  if (!noted_.empty()) throw InputErrors(noted_);
}

}  // namespace dmrp::host
