// SPDX-License-Identifier: MIT
// setting.hpp: keys of TOML tables that are both read and written.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "host/toml/toml_document.hpp"
#include "host/toml/toml_text.hpp"

namespace dmrp::host {

// A key of a table: reads its value from a file, and writes it as TOML. Refers to the variable that holds the value.
struct Setting {
  std::string key;
  std::function<void(const TomlValue&)> read;
  std::function<std::string()> write;
  std::string range = {};  // the values that it takes, in words; empty where its page says it
};
using Settings = std::vector<Setting>;

std::vector<TomlTable::KeyReader> readers_of(const Settings& settings);
TomlKeys keys_of(const std::string& title, const Settings& settings);

// Lines of key = value, the keys padded to `width`.
std::string lines_of(const Settings& settings, std::size_t width);
std::string inline_table(const Settings& settings);

// Ranges in words.
inline constexpr const char* boolean_text = "true, false";
std::string range_text(std::int64_t minimum, std::int64_t maximum);
std::string range_text(double minimum, double maximum);
std::string positive_text(double maximum);
std::string choices_text(const std::vector<std::string>& choices);

Setting number(const std::string& key, double& to, double minimum, double maximum);
Setting positive(const std::string& key, double& to, double maximum);
Setting boolean(const std::string& key, bool& to);

template <class Integer>
Setting integer(const std::string& key, Integer& to, std::int64_t minimum, std::int64_t maximum) {
  return {
      key,
      [&to, minimum, maximum](const TomlValue& value) { to = static_cast<Integer>(value.integer(minimum, maximum)); },
      [&to] { return std::to_string(to); }, range_text(minimum, maximum)};
}

inline constexpr double max_length_m = 1e4;

// Seconds in the file, nanoseconds in memory.
inline constexpr double max_time_s = 1e6;
inline constexpr double min_time_s = 1e-3;
Setting seconds(const std::string& key, std::int64_t& to_ns);
Setting seconds_or_never(const std::string& key, std::int64_t& to_ns);  // 0: never
Setting latency(const std::string& key, std::int64_t& to_ns);

// A table in the table. `check` runs after all its keys have been read.
Setting subtable(const std::string& key, const Settings& settings,
                 const std::function<void(const TomlTable&)>& check = {});

// One of a list; `first` is the value of the enumerator of its first choice, the others follow.
template <class Enum>
Setting choice(const std::string& key, Enum& to, const std::vector<std::string>& choices, int first = 0) {
  return {key,
          [&to, choices, first](const TomlValue& value) {
            const std::string chosen = value.choice(choices);
            to = static_cast<Enum>(std::find(choices.begin(), choices.end(), chosen) - choices.begin() + first);
          },
          [&to, choices, first] { return toml_text(choices[static_cast<std::size_t>(static_cast<int>(to) - first)]); },
          choices_text(choices)};
}

}  // namespace dmrp::host
