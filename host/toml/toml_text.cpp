// SPDX-License-Identifier: MIT
#include "host/toml/toml_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace dmrp::host {

namespace {

template <class Items>
std::string array(const Items& items) {
  std::string out;
  for (const auto& item : items) out += (out.empty() ? "" : ", ") + toml_text(item);
  return "[" + out + "]";
}

}  // namespace

std::string toml_key(const std::string& name) {
  const auto bare = [](unsigned char c) { return c < 0x80 && (std::isalnum(c) || c == '_' || c == '-'); };
  return !name.empty() && std::all_of(name.begin(), name.end(), bare) ? name : toml_text(name);
}

std::string toml_text(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      out += fmt::format("\\u{:04x}", static_cast<unsigned char>(c));
    } else {
      out += c;
    }
  }
  return out + '"';
}

std::string toml_text(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_not_of("-0123456789") == std::string::npos) text += ".0";
  return text;
}

std::string toml_text(const std::vector<std::string>& texts) {
  return array(texts);
}

std::string toml_text(const std::vector<double>& values) {
  return array(values);
}

}  // namespace dmrp::host
