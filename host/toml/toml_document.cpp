// SPDX-License-Identifier: MIT
#include "host/toml/toml_document.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "host/errors/input_error.hpp"
#include "host/errors/mistakes.hpp"
#include "host/toml/expression.hpp"
#include "host/toml/nearest_name.hpp"

namespace dmrp::host {

namespace {

constexpr std::size_t longest_message = 2000;
constexpr unsigned most_key_parts = 1000;
constexpr std::size_t longest_line = 1000;

SourcePosition position_of(const toml::source_region& region) {
  return {std::max<std::uint32_t>(region.begin.line, 1), std::max<std::uint32_t>(region.begin.column, 1)};
}

bool is_control(char c) {
  return static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
}

}  // namespace

TomlDocument::TomlDocument(std::string shown_path, std::string_view text)
    : shown_path_(std::move(shown_path)), text_(text) {
  refuse_long_key(text);
  try {
    table_ = std::make_unique<const toml::table>(toml::parse(text, shown_path_));
  } catch (const toml::parse_error& error) {
    const std::string text(error.description());
    fail(position_of(error.source()), text.find("unescaped control characters") == std::string::npos
                                          ? text
                                          : "the string before has no closing quote on its line");
  }
}

TomlDocument::~TomlDocument() = default;

std::vector<std::string> names_of(const std::vector<TomlKey>& keys) {
  std::vector<std::string> names;
  for (const TomlKey& key : keys) names.push_back(key.name);
  return names;
}

std::vector<std::string> TomlDocument::tables_with(const std::string& key) const {
  std::vector<std::string> titles;
  for (const TomlKeys& table : tables_)
    for (const TomlKey& known : table.keys)
      if (!table.title.empty() && known.name == key) titles.push_back(table.title);
  return titles;
}

const TomlKeys* TomlDocument::keys_of(const std::string& title) const {
  const auto found =
      std::find_if(tables_.begin(), tables_.end(), [&](const TomlKeys& table) { return table.title == title; });
  return found == tables_.end() ? nullptr : &*found;
}

TomlTable TomlDocument::root() const {
  return {*this, *table_, ""};
}

std::string TomlDocument::place(SourcePosition at) const {
  return fmt::format("{}:{}:{}", shown_path_, at.line, at.column);
}

void TomlDocument::fail(SourcePosition at, const std::string& text) const {
  const bool is_long = text.size() > longest_message;
  throw InputError(place(at) + ": " + text.substr(0, longest_message) + (is_long ? "..." : ""),
                   {shown_path_, at.line, at.column, std::string(line(at.line))});
}

std::string_view TomlDocument::line(std::size_t number) const {
  std::string_view rest = text_;
  for (std::size_t i = 1; i < number; ++i) rest.remove_prefix(std::min(rest.find('\n'), rest.size() - 1) + 1);
  return rest.substr(0, rest.find('\n'));
}

// The parser makes a table in a table for each part, and its stack has an end.
void TomlDocument::refuse_long_key(std::string_view text) const {
  SourcePosition at = {1, 1};
  SourcePosition begin = at;
  unsigned parts = 1;
  for (const char c : text) {
    const bool may_be_key = std::isalnum(static_cast<unsigned char>(c)) || std::strchr("_-.\"' \t", c);
    if (!may_be_key) {
      parts = 1;
      begin = {at.line, at.column + 1};
    } else if (c == '.' && ++parts > most_key_parts) {
      fail(begin, fmt::format("a key of more than {} parts", most_key_parts));
    }
    at = c == '\n' ? SourcePosition{at.line + 1, 1} : SourcePosition{at.line, at.column + 1};
    if (c == '\n') begin = at;
  }
}

SourcePosition TomlValue::position() const {
  return position_of(node_->source());
}

std::string TomlValue::place() const {
  return document_->place(position());
}

void TomlValue::fail(const std::string& text) const {
  document_->fail(position(), text);
}

void TomlValue::fail_at_key(const std::string& text) const {
  document_->fail(key_position_, text);
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
      return "a float";
    case toml::node_type::boolean:
      return "a boolean";
    default:
      return "a date or time";
  }
}

bool TomlValue::is_text() const {
  return node_->is_string();
}
bool TomlValue::is_array() const {
  return node_->is_array();
}
bool TomlValue::is_table() const {
  return node_->is_table();
}

bool TomlValue::boolean() const {
  if (!node_->is_boolean()) fail(fmt::format("'{}' must be true or false, not {}", key_, type_name()));
  return node_->as_boolean()->get();
}

std::optional<double> TomlValue::formula() const {
  if (!document_->level() || !node_->is_string()) return std::nullopt;
  try {
    return evaluate_expression(node_->as_string()->get(), *document_->level());
  } catch (const std::invalid_argument& error) {
    fail(fmt::format("'{}' is no formula: {}", key_, error.what()));
  }
}

std::int64_t TomlValue::integer(std::int64_t minimum, std::int64_t maximum) const {
  const std::optional<double> computed = formula();
  constexpr double largest = 1e15;  // so is every integer below exactly a double
  if (computed && (*computed != std::floor(*computed) || std::abs(*computed) > largest))
    fail(fmt::format("'{}' must be an integer, not {}", key_, *computed));
  if (!computed && !node_->is_integer()) fail(fmt::format("'{}' must be an integer, not {}", key_, type_name()));
  const std::int64_t value = computed ? static_cast<std::int64_t>(*computed) : node_->as_integer()->get();
  if (value < minimum) fail(fmt::format("'{}' must be at least {}, not {}", key_, minimum, value));
  if (value > maximum) fail(fmt::format("'{}' must be at most {}, not {}", key_, maximum, value));
  return value;
}

double TomlValue::number(double minimum, double maximum) const {
  const std::optional<double> computed = formula();
  if (!computed && !node_->is_number()) fail(fmt::format("'{}' must be a number, not {}", key_, type_name()));
  const double value = computed ? *computed : *node_->value<double>();
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
  if (is_array() && key_ == "use") fail("'use' takes one name: write one table, such as [[scenario]], for each");
  if (!node_->is_string()) fail(fmt::format("'{}' must be a string, not {}", key_, type_name()));
  return node_->as_string()->get();
}

std::string TomlValue::line() const {
  const std::string value = text();
  if (value.empty()) fail(fmt::format("'{}' must not be empty", key_));
  if (value.size() > longest_line) fail(fmt::format("'{}' must have at most {} bytes", key_, longest_line));
  if (std::any_of(value.begin(), value.end(), is_control))
    fail(fmt::format("'{}' must not have line breaks or other control characters", key_));
  return value;
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
  for (const toml::node& element : *node_->as_array())
    out.emplace_back(*document_, element, key_, position_of(element.source()));
  return out;
}

TomlTable TomlValue::table(const std::string& title) const {
  if (!node_->is_table()) fail(fmt::format("'{}' must be a table, not {}", key_, type_name()));
  return {*document_, *node_->as_table(), title.empty() ? "'" + key_ + "'" : title};
}

TomlTable::TomlTable(const TomlDocument& document, const toml::table& table, std::string title)
    : document_(&document), table_(&table), title_(std::move(title)) {}

SourcePosition TomlTable::position() const {
  return position_of(table_->source());
}

void TomlTable::fail(const std::string& text) const {
  document_->fail(position(), text);
}

void TomlTable::refuse_key(const TomlValue& entry, const std::vector<std::string>& known,
                           const std::string& whose) const {
  const std::string in = whose.empty() && !title_.empty() ? " in " + title_ : whose;
  std::vector<std::string> others = document_->tables_with(entry.key());
  others.erase(std::remove(others.begin(), others.end(), title_), others.end());
  const std::string meant =
      others.empty() ? did_you_mean(entry.key(), known) : fmt::format(" (it is a key of {})", join_names(others));
  document_->fail(entry.key_position(), fmt::format("unknown key '{}'{}{}", entry.key(), in, meant));
}

std::vector<std::string> TomlTable::keys_of(const std::vector<KeyReader>& readers) {
  std::vector<std::string> keys;
  for (const KeyReader& reader : readers) keys.push_back(reader.first);
  return keys;
}

void TomlTable::read(const std::vector<KeyReader>& readers) const {
  const std::vector<std::string> known = keys_of(readers);
  Mistakes mistakes;
  for (const TomlValue& entry : entries())
    mistakes.attempt([&] {
      const auto found = std::find(known.begin(), known.end(), entry.key());
      if (found == known.end()) refuse_key(entry, known, "");
      readers[static_cast<std::size_t>(found - known.begin())].second(entry);
    });
  mistakes.end();
}

void TomlTable::allow_only(const std::vector<std::string>& keys, const std::string& whose) const {
  Mistakes mistakes;
  for (const TomlValue& entry : entries())
    if (std::find(keys.begin(), keys.end(), entry.key()) == keys.end())
      mistakes.attempt([&] { refuse_key(entry, keys, whose); });
  mistakes.end();
}

std::optional<TomlValue> TomlTable::find(const std::string& key) const {
  const auto entry = table_->find(key);
  if (entry == table_->end()) return std::nullopt;
  return TomlValue(*document_, entry->second, key, position_of(entry->first.source()));
}

TomlValue TomlTable::need(const std::string& key) const {
  if (const auto value = find(key)) return *value;
  fail_missing(key,
               title_.empty() ? fmt::format("the file needs [{}]", key) : fmt::format("{} needs '{}'", title_, key));
}

void TomlTable::fail_missing(const std::string& key, const std::string& text) const {
  if (const TomlKeys* const table = document_->keys_of(title_)) {
    const std::vector<std::string> known = names_of(table->keys);
    for (const TomlValue& entry : entries())
      if (std::find(known.begin(), known.end(), entry.key()) == known.end() && nearest_name(entry.key(), known) == key)
        refuse_key(entry, known, "");
  }
  fail(text);
}

std::optional<TomlTable> TomlTable::find_table(const std::string& key) const {
  const auto value = find(key);
  if (!value) return std::nullopt;
  TomlTable table = value->table();
  table.title_ = title_.empty() ? "[" + key + "]" : "'" + key + "'";
  return table;
}

std::vector<TomlTable> TomlTable::tables(const std::string& key) const {
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

void TomlTable::read_tables(const std::string& key, const std::function<void(const TomlTable&)>& read) const {
  Mistakes mistakes;
  for (const TomlTable& table : tables(key)) mistakes.attempt([&] { read(table); });
  mistakes.end();
}

std::vector<TomlValue> TomlTable::entries() const {
  std::vector<TomlValue> out;
  for (const auto& [key, node] : *table_)
    out.emplace_back(*document_, node, std::string(key.str()), position_of(key.source()));
  std::sort(out.begin(), out.end(), [](const TomlValue& a, const TomlValue& b) {
    const SourcePosition p = a.key_position();
    const SourcePosition q = b.key_position();
    return p.line != q.line ? p.line < q.line : p.column < q.column;
  });
  return out;
}

}  // namespace dmrp::host
