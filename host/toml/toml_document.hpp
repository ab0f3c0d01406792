// SPDX-License-Identifier: MIT
// toml_document.hpp: reads a TOML file; every mistake is an InputError in one line, `file:line:column: what was
// expected`. What reads several keys or tables goes on behind a mistake, and throws all in one InputErrors.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace toml {
inline namespace v3 {
class node;
class table;
}  // namespace v3
}  // namespace toml

namespace dmrp::host {

struct SourcePosition {
  std::uint32_t line = 1;
  std::uint32_t column = 1;
};

class TomlTable;

// A key of the format.
struct TomlKey {
  std::string name;
  std::string range = {};     // the values that it takes, in words; "" where its page says it
  std::string fallback = {};  // its default as TOML; "" where the readers know none
};
std::vector<std::string> names_of(const std::vector<TomlKey>& keys);

// The keys of a table of the format. `title`: its name in messages, for example "[robot]".
struct TomlKeys {
  std::string title;
  std::vector<TomlKey> keys;
};

class TomlDocument {
 public:
  // `shown_path`: the path of the file in messages.
  TomlDocument(std::string shown_path, std::string_view text);
  ~TomlDocument();
  TomlDocument(const TomlDocument&) = delete;
  TomlDocument& operator=(const TomlDocument&) = delete;

  // Sets all tables of the format, so that messages about an unknown key can name the table to which it belongs.
  void know(std::vector<TomlKeys> tables) { tables_ = std::move(tables); }
  std::vector<std::string> tables_with(const std::string& key) const;  // their titles, without the root's
  const TomlKeys* keys_of(const std::string& title) const;             // nullptr: not known

  // With a level, numbers may be written as formulas of it (expression.hpp): "5 - level / 2".
  void set_level(double level) { level_ = level; }
  std::optional<double> level() const { return level_; }

  TomlTable root() const;
  [[noreturn]] void fail(SourcePosition at, const std::string& text) const;
  void refuse_long_key(std::string_view text) const;
  std::string place(SourcePosition at) const;  // "file:line:column"

 private:
  std::string_view line(std::size_t number) const;

  std::string shown_path_;
  std::string text_;
  std::unique_ptr<const toml::v3::table> table_;
  std::vector<TomlKeys> tables_;
  std::optional<double> level_;
};

// A value of the document. An accessor fails with the expected type if the value has another one.
class TomlValue {
 public:
  TomlValue(const TomlDocument& document, const toml::v3::node& node, std::string key, SourcePosition key_position)
      : document_(&document), node_(&node), key_(std::move(key)), key_position_(key_position) {}

  const std::string& key() const { return key_; }
  SourcePosition position() const;
  SourcePosition key_position() const { return key_position_; }
  std::string place() const;  // "file:line:column"
  [[noreturn]] void fail(const std::string& text) const;
  [[noreturn]] void fail_at_key(const std::string& text) const;

  bool boolean() const;
  std::int64_t integer(std::int64_t minimum = std::numeric_limits<std::int64_t>::min(),
                       std::int64_t maximum = std::numeric_limits<std::int64_t>::max()) const;
  double number(double minimum = -std::numeric_limits<double>::infinity(),
                double maximum = std::numeric_limits<double>::infinity()) const;  // finite; may be an integer
  double positive() const;                                                        // a number > 0
  std::string text() const;
  std::string line() const;  // a text for messages and tables: not empty, without control characters
  std::string choice(const std::vector<std::string>& choices) const;
  std::vector<TomlValue> array() const;
  TomlTable table(const std::string& title = "") const;  // `title`: its name in messages; "": its key

  bool is_text() const;
  bool is_array() const;
  bool is_table() const;
  std::optional<double> formula() const;  // the value of a formula; none if it is none
  std::string type_name() const;          // "a string", "an integer", ...

 private:
  const TomlDocument* document_;
  const toml::v3::node* node_;
  std::string key_;
  SourcePosition key_position_;
};

// A table. Its reader must first state the allowed keys, by read() or allow_only().
class TomlTable {
 public:
  // `title`: its name in messages, for example "[experiment]"; "" for the root.
  TomlTable(const TomlDocument& document, const toml::v3::table& table, std::string title);

  SourcePosition position() const;
  [[noreturn]] void fail(const std::string& text) const;
  const std::string& title() const { return title_; }

  // Reads every key in the order of the file; refuses other keys.
  using KeyReader = std::pair<std::string, std::function<void(const TomlValue&)>>;
  void read(const std::vector<KeyReader>& readers) const;
  static std::vector<std::string> keys_of(const std::vector<KeyReader>& readers);

  // Refuses every key that is not in the list. `whose`: "" or " for org.example.planner", for the message.
  void allow_only(const std::vector<std::string>& keys, const std::string& whose = "") const;
  void allow_only_keys(const std::vector<TomlKey>& keys) const { allow_only(names_of(keys)); }

  std::optional<TomlValue> find(const std::string& key) const;
  TomlValue need(const std::string& key) const;
  std::optional<TomlTable> find_table(const std::string& key) const;
  std::vector<TomlTable> tables(const std::string& key) const;  // [[key]]; empty if there are none
  void read_tables(const std::string& key, const std::function<void(const TomlTable&)>& read) const;  // each [[key]]

  // Fails because there is no `key`. If one of the keys is `key` misspelt, that is the mistake.
  [[noreturn]] void fail_missing(const std::string& key, const std::string& text) const;

  // All keys, in the order of the file.
  std::vector<TomlValue> entries() const;

 private:
  [[noreturn]] void refuse_key(const TomlValue& entry, const std::vector<std::string>& known,
                               const std::string& whose) const;

  const TomlDocument* document_;
  const toml::v3::table* table_;
  std::string title_;
};

}  // namespace dmrp::host
