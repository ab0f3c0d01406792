// SPDX-License-Identifier: MIT
#include "host/toml/setting.hpp"

#include <fmt/format.h>

#include <cmath>

namespace dmrp::host {

namespace {

constexpr double max_latency_s = 10.0;

std::string number_text(double number) {
  return fmt::format("{:.7g}", number);
}

Setting time_setting(const std::string& key, std::int64_t& to_ns, double minimum_s, double maximum_s) {
  return {key,
          [&to_ns, minimum_s, maximum_s](const TomlValue& value) {
            to_ns = std::llround(value.number(minimum_s, maximum_s) * 1e9);
          },
          [&to_ns] { return toml_text(static_cast<double>(to_ns) / 1e9); }, range_text(minimum_s, maximum_s)};
}

}  // namespace

std::vector<TomlTable::KeyReader> readers_of(const Settings& settings) {
  std::vector<TomlTable::KeyReader> readers;
  for (const Setting& setting : settings) readers.emplace_back(setting.key, setting.read);
  return readers;
}

TomlKeys keys_of(const std::string& title, const Settings& settings) {
  TomlKeys keys = {title, {}};
  for (const Setting& setting : settings) keys.keys.push_back({setting.key, setting.range, setting.write()});
  return keys;
}

std::string lines_of(const Settings& settings, std::size_t width) {
  std::string lines;
  for (const Setting& setting : settings) lines += fmt::format("{:<{}} = {}\n", setting.key, width, setting.write());
  return lines;
}

std::string inline_table(const Settings& settings) {
  std::string text;
  for (const Setting& setting : settings)
    text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", setting.key, setting.write());
  return "{ " + text + " }";
}

std::string range_text(std::int64_t minimum, std::int64_t maximum) {
  return fmt::format("{} to {}", minimum, maximum);
}

std::string range_text(double minimum, double maximum) {
  return fmt::format("{} to {}", number_text(minimum), number_text(maximum));
}

std::string positive_text(double maximum) {
  return "above 0, to " + number_text(maximum);
}

std::string choices_text(const std::vector<std::string>& choices) {
  std::string text;
  for (const std::string& choice : choices) text += (text.empty() ? "" : ", ") + toml_text(choice);
  return text;
}

Setting number(const std::string& key, double& to, double minimum, double maximum) {
  return {key, [&to, minimum, maximum](const TomlValue& value) { to = value.number(minimum, maximum); },
          [&to] { return toml_text(to); }, range_text(minimum, maximum)};
}

Setting positive(const std::string& key, double& to, double maximum) {
  return {key,
          [&to, maximum](const TomlValue& value) {
            value.positive();
            to = value.number(0.0, maximum);
          },
          [&to] { return toml_text(to); }, positive_text(maximum)};
}

Setting boolean(const std::string& key, bool& to) {
  return {key, [&to](const TomlValue& value) { to = value.boolean(); }, [&to] { return to ? "true" : "false"; },
          boolean_text};
}

Setting seconds(const std::string& key, std::int64_t& to_ns) {
  return time_setting(key, to_ns, min_time_s, max_time_s);
}
Setting seconds_or_never(const std::string& key, std::int64_t& to_ns) {
  return time_setting(key, to_ns, 0.0, max_time_s);
}
Setting latency(const std::string& key, std::int64_t& to_ns) {
  return time_setting(key, to_ns, 0.0, max_latency_s);
}

Setting subtable(const std::string& key, const Settings& settings, const std::function<void(const TomlTable&)>& check) {
  return {key,
          [settings, check](const TomlValue& value) {
            const TomlTable table = value.table();
            table.read(readers_of(settings));
            if (check) check(table);
          },
          [settings] { return inline_table(settings); }};
}

}  // namespace dmrp::host
