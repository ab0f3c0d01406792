// SPDX-License-Identifier: MIT
// json_text.hpp: builds JSON text piece by piece in a reused buffer. Written by hand: a trace has thousands of
// messages, and nlohmann-json would build a tree for each and has no format with four decimals.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace dmrp::core {

class JsonText {
 public:
  JsonText& raw(std::string_view json) {
    text_.append(json);
    return *this;
  }
  JsonText& string(std::string_view text);  // quoted and escaped
  JsonText& integer(std::int64_t value);
  JsonText& number(double value);  // rounded to four decimals; 0 for NaN, infinities and values above 9e11
  JsonText& comma_unless_first();  // a separator, if the buffer holds only list elements

  void clear() { text_.clear(); }
  const std::string& text() const { return text_; }
  std::span<const std::uint8_t> bytes() const {
    return {reinterpret_cast<const std::uint8_t*>(text_.data()), text_.size()};
  }

 private:
  std::string text_;
};

}  // namespace dmrp::core
