// SPDX-License-Identifier: MIT
#include "host/experiment/toml_document.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>

#include "host/experiment/nearest_name.hpp"
#include "host/input_error.hpp"

namespace dmrp::host {

namespace {

SourcePosition position_of(const toml::source_region& region) {
  return {std::max<std::uint32_t>(region.begin.line, 1), std::max<std::uint32_t>(region.begin.column, 1)};
}

}  // namespace

TomlDocument::TomlDocument(std::string shown_path, std::string_view text) : shown_path_(std::move(shown_path)) {
  try {
    table_ = std::make_unique<const toml::table>(toml::parse(text, shown_path_));
  } catch (const toml::parse_error& error) {
    fail(position_of(error.source()), std::string(error.description()));
  }
}

TomlDocument::~TomlDocument() = default;

TomlTable TomlDocument::root() const {
  return {*this, *table_, ""};
}

std::string TomlDocument::place(SourcePosition at) const {
  return fmt::format("{}:{}:{}", shown_path_, at.line, at.column);
}

void TomlDocument::fail(SourcePosition at, const std::string& text) const {
  throw InputError(place(at) + ": " + text);
}

SourcePosition TomlValue::position() const {
  return position_of(node_->source());
}

void TomlValue::fail(const std::string& text) const {
  document_->fail(position(), text);
}

std::string TomlValue::type_name() const {
  switch (node_->type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "an array";
    case toml::node_type::string:
      return "a string";
    case toml::node_type::integer:
      return "an integer";
    case toml::node_type::floating_point:
      return "a number";
    case toml::node_type::boolean:
      return "a boolean";
    default:
      return "a date or time";
  }
}

bool TomlValue::is_integer() const {
  return node_->is_integer();
}
bool TomlValue::is_array() const {
  return node_->is_array();
}

bool TomlValue::boolean() const {
  if (!node_->is_boolean()) fail(fmt::format("'{}' must be true or false, not {}", key_, type_name()));
  return node_->as_boolean()->get();
}

std::int64_t TomlValue::integer(std::int64_t minimum, std::int64_t maximum) const {
  if (!node_->is_integer()) fail(fmt::format("'{}' must be an integer, not {}", key_, type_name()));
  const std::int64_t value = node_->as_integer()->get();
  if (value < minimum) fail(fmt::format("'{}' must be at least {}, not {}", key_, minimum, value));
  if (value > maximum) fail(fmt::format("'{}' must be at most {}, not {}", key_, maximum, value));
  return value;
}

double TomlValue::number(double minimum, double maximum) const {
  if (!node_->is_number()) fail(fmt::format("'{}' must be a number, not {}", key_, type_name()));
  const double value = *node_->value<double>();
  if (!std::isfinite(value)) fail(fmt::format("'{}' must be finite", key_));
  if (value < minimum) fail(fmt::format("'{}' must be at least {}, not {}", key_, minimum, value));
  if (value > maximum) fail(fmt::format("'{}' must be at most {}, not {}", key_, maximum, value));
  return value;
}

double TomlValue::positive() const {
  const double value = number();
  if (value <= 0.0) fail(fmt::format("'{}' must be positive, not {}", key_, value));
  return value;
}

std::string TomlValue::text() const {
  if (!node_->is_string()) fail(fmt::format("'{}' must be a string, not {}", key_, type_name()));
  return node_->as_string()->get();
}

std::string TomlValue::choice(const std::vector<std::string>& choices) const {
  const std::string value = text();
  if (std::find(choices.begin(), choices.end(), value) == choices.end())
    fail(fmt::format("'{}' must be one of {}, not '{}'{}", key_, join_names(choices), value,
                     did_you_mean(value, choices)));
  return value;
}

std::vector<TomlValue> TomlValue::array() const {
  if (!node_->is_array()) fail(fmt::format("'{}' must be an array, not {}", key_, type_name()));
  std::vector<TomlValue> out;
  for (const toml::node& element : *node_->as_array()) out.emplace_back(*document_, element, key_);
  return out;
}

TomlTable TomlValue::table() const {
  if (!node_->is_table()) fail(fmt::format("'{}' must be a table, not {}", key_, type_name()));
  return {*document_, *node_->as_table(), "'" + key_ + "'"};
}

TomlTable::TomlTable(const TomlDocument& document, const toml::table& table, std::string title)
    : document_(&document), table_(&table), title_(std::move(title)) {}

SourcePosition TomlTable::position() const {
  return position_of(table_->source());
}

void TomlTable::fail(const std::string& text) const {
  document_->fail(position(), text);
}

std::optional<TomlValue> TomlTable::find(const std::string& key) {
  if (std::find(asked_.begin(), asked_.end(), key) == asked_.end()) asked_.push_back(key);
  const toml::node* node = table_->get(key);
  if (!node) return std::nullopt;
  return TomlValue(*document_, *node, key);
}

TomlValue TomlTable::need(const std::string& key) {
  if (auto value = find(key)) return *value;
  // A misspelt key is the likelier mistake than a missing one.
  for (const TomlValue& entry : entries())
    if (nearest_name(entry.key(), {key}) == key && std::find(asked_.begin(), asked_.end(), entry.key()) == asked_.end())
      document_->fail(entry.position(), fmt::format("unknown key '{}' in {} (did you mean '{}'?)", entry.key(),
                                                    title_.empty() ? "the file" : title_, key));
  fail(title_.empty() ? fmt::format("the file needs [{}]", key) : fmt::format("{} needs '{}'", title_, key));
}

std::optional<TomlTable> TomlTable::find_table(const std::string& key) {
  const auto value = find(key);
  if (!value) return std::nullopt;
  TomlTable table = value->table();
  table.title_ = title_.empty() ? "[" + key + "]" : "'" + key + "'";
  return table;
}

std::vector<TomlTable> TomlTable::tables(const std::string& key) {
  std::vector<TomlTable> out;
  const auto value = find(key);
  if (!value) return out;
  if (!value->is_array()) value->fail(fmt::format("'{}' must be written as [[{}]]", key, key));
  for (const TomlValue& element : value->array()) {
    TomlTable table = element.table();
    table.title_ = "[[" + key + "]]";
    out.push_back(std::move(table));
  }
  return out;
}

std::vector<TomlValue> TomlTable::entries() const {
  std::vector<std::pair<toml::source_position, TomlValue>> found;
  for (const auto& [key, node] : *table_)
    found.emplace_back(key.source().begin, TomlValue(*document_, node, std::string(key.str())));
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<TomlValue> out;
  for (auto& entry : found) out.push_back(std::move(entry.second));
  return out;
}

void TomlTable::finish(const std::string& whose) const {
  for (const auto& [key, node] : *table_) {
    const std::string name(key.str());
    if (std::find(asked_.begin(), asked_.end(), name) != asked_.end()) continue;
    const std::string in = whose.empty() ? (title_.empty() ? "" : " in " + title_) : whose;
    document_->fail(position_of(key.source()),
                    fmt::format("unknown key '{}'{}{}", name, in, did_you_mean(name, asked_)));
  }
}

}  // namespace dmrp::host
