// SPDX-License-Identifier: MIT
// toml_document.hpp: reads a TOML file so that every mistake is one line: `file:line:column: what was expected`.
// All errors are InputErrors.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
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

class TomlDocument {
 public:
  // `shown_path`: the file as the user wrote it.
  TomlDocument(std::string shown_path, std::string_view text);
  ~TomlDocument();
  TomlDocument(const TomlDocument&) = delete;
  TomlDocument& operator=(const TomlDocument&) = delete;

  TomlTable root() const;
  [[noreturn]] void fail(SourcePosition at, const std::string& text) const;
  std::string place(SourcePosition at) const;  // "file:line:column"

 private:
  std::string shown_path_;
  std::unique_ptr<const toml::v3::table> table_;
};

// A value of the document. The accessors say what was expected when it is something else.
class TomlValue {
 public:
  TomlValue(const TomlDocument& document, const toml::v3::node& node, std::string key)
      : document_(&document), node_(&node), key_(std::move(key)) {}

  const std::string& key() const { return key_; }
  SourcePosition position() const;
  [[noreturn]] void fail(const std::string& text) const;

  bool boolean() const;
  std::int64_t integer(std::int64_t minimum = std::numeric_limits<std::int64_t>::min(),
                       std::int64_t maximum = std::numeric_limits<std::int64_t>::max()) const;
  double number(double minimum = -std::numeric_limits<double>::infinity(),
                double maximum = std::numeric_limits<double>::infinity()) const;  // finite; an integer will do
  double positive() const;                                                        // a number > 0
  std::string text() const;
  std::string choice(const std::vector<std::string>& choices) const;
  std::vector<TomlValue> array() const;
  TomlTable table() const;

  bool is_integer() const;
  bool is_array() const;
  std::string type_name() const;  // "a string", "an integer", ...

 private:
  const TomlDocument* document_;
  const toml::v3::node* node_;
  std::string key_;
};

// A table whose keys are asked for one by one; finish() refuses those that nobody asked for.
class TomlTable {
 public:
  // `title`: as messages call it, "[experiment]"; "" for the root.
  TomlTable(const TomlDocument& document, const toml::v3::table& table, std::string title);

  SourcePosition position() const;
  [[noreturn]] void fail(const std::string& text) const;
  const std::string& title() const { return title_; }

  std::optional<TomlValue> find(const std::string& key);
  TomlValue need(const std::string& key);
  std::optional<TomlTable> find_table(const std::string& key);
  std::vector<TomlTable> tables(const std::string& key);  // [[key]]; empty if there are none

  // All keys, in the order of the file, without marking them.
  std::vector<TomlValue> entries() const;

  // `whose`: "" or " for ID of a plugin", for the message.
  void finish(const std::string& whose = "") const;

 private:
  const TomlDocument* document_;
  const toml::v3::table* table_;
  std::string title_;
  std::vector<std::string> asked_;
};

}  // namespace dmrp::host
