// SPDX-License-Identifier: MIT
// json_text.hpp: JSON put together piece by piece, in a buffer that is used again: for messages by the thousand.
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
  JsonText& number(double value);  // to four decimals; 0 for what JSON has no number for
  JsonText& comma_unless_first();  // between elements, where the buffer holds nothing but these

  void clear() { text_.clear(); }
  const std::string& text() const { return text_; }
  std::span<const std::uint8_t> bytes() const {
    return {reinterpret_cast<const std::uint8_t*>(text_.data()), text_.size()};
  }

 private:
  std::string text_;
};

}  // namespace dmrp::core
