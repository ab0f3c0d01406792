// SPDX-License-Identifier: MIT
#include "host/scenario/read_recordings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>

#include "host/files/read_file.hpp"
#include "host/files/text_lines.hpp"
#include "host/scenario/named_file.hpp"
#include "host/toml/setting.hpp"

namespace dmrp::host {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";  // some spreadsheets write it
constexpr std::array<std::string_view, 4> columns = {"time", "id", "x", "y"};

std::string_view without_spaces(std::string_view text) {
  const auto begin = text.find_first_not_of(" \t\r");
  return begin == std::string_view::npos ? std::string_view()
                                         : text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

class Recording {
 public:
  Recording(std::string text, const std::string& shown_path)
      : lines_(std::move(text), shown_path), shown_path_(shown_path) {}

  void read(ScenarioFile& out) {
    bool has_header = false;
    for (line_ = 1; line_ <= lines_.count(); ++line_) {
      std::string_view line = lines_.line(line_);
      if (line_ == 1 && line.starts_with(byte_order_mark)) line.remove_prefix(byte_order_mark.size());
      if (without_spaces(line).empty()) continue;
      const std::array<TextField, 4> fields = split(line);
      if (has_header)
        read_row(fields, out);
      else
        check_header(fields);
      has_header = true;
    }
    line_ = lines_.count();
    if (!has_header) fail(1, "the file needs the line 'time,id,x,y'");
    if (persons_.empty()) fail(1, "the recording has no rows");
  }

 private:
  [[noreturn]] void fail(std::size_t column, const std::string& text) const {
    lines_.fail(std::max<std::size_t>(line_, 1), column, text);
  }

  std::array<TextField, 4> split(std::string_view line) const {
    std::array<TextField, 4> fields;
    std::size_t begin = 0;
    for (std::size_t i = 0; i < fields.size(); ++i) {
      const auto end = line.find(',', begin);
      if ((end == std::string_view::npos) != (i + 1 == fields.size()))
        fail(1, fmt::format("a row has 4 values, time,id,x,y, not {}", 1 + std::count(line.begin(), line.end(), ',')));
      fields[i] = {without_spaces(line.substr(begin, end - begin)), begin + 1};
      begin = end + 1;
    }
    return fields;
  }

  void check_header(const std::array<TextField, 4>& fields) const {
    for (std::size_t i = 0; i < fields.size(); ++i)
      if (fields[i].text != columns[i])
        fail(fields[i].column,
             fmt::format("the first line must be 'time,id,x,y': '{}' should be '{}'", fields[i].text, columns[i]));
  }

  // Whether the whole field is a number of this type.
  template <class Number>
  static bool parse(std::string_view text, Number& value) {
    if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
    const char* const end = text.data() + text.size();
    const auto read = std::from_chars(text.data(), end, value);
    return read.ec == std::errc() && read.ptr == end;
  }

  double number(const TextField& field, std::size_t index, double farthest) const {
    double value = 0.0;
    if (!parse(field.text, value) || !(std::abs(value) <= farthest))
      fail(field.column,
           fmt::format("'{0}' must be a number from -{1} to {1}, not '{2}'", columns[index], farthest, field.text));
    return value;
  }

  std::uint64_t id(const TextField& field) const {
    std::uint64_t value = 0;
    if (!parse(field.text, value))
      fail(field.column, fmt::format("'id' must be a whole number of at least 0, not '{}'", field.text));
    return value;
  }

  void read_row(const std::array<TextField, 4>& fields, ScenarioFile& out) {
    const std::int64_t t_ns = std::llround(number(fields[0], 0, max_time_s) * 1e9);
    const auto [person, is_new] = persons_.try_emplace(id(fields[1]), out.scenario.tracks.size());
    if (is_new) {
      out.scenario.tracks.emplace_back();
      out.tracks.push_back({shown_path_, std::to_string(person->first), {}});
    }
    auto& points = out.scenario.tracks[person->second].points;
    if (!points.empty() && t_ns == points.back().t_ns)
      fail(fields[0].column, fmt::format("person {} has two rows at {} s, line {} is the first", person->first,
                                         fields[0].text, out.tracks[person->second].lines.back()));
    if (!points.empty() && t_ns < points.back().t_ns)
      fail(fields[0].column, fmt::format("the rows of person {} must be in order of time: {} s comes after {} s",
                                         person->first, fields[0].text, static_cast<double>(points.back().t_ns) / 1e9));
    const double x = number(fields[2], 2, max_side_m);
    points.push_back({t_ns, {x, number(fields[3], 3, max_side_m)}});
    out.tracks[person->second].lines.push_back(line_);
  }

  TextLines lines_;
  std::string shown_path_;
  std::size_t line_ = 0;
  std::map<std::uint64_t, std::size_t> persons_;  // by id: the track
};

}  // namespace

void read_recordings(const TomlTable& root, const fs::path& file, const std::string& shown_path, ScenarioFile& out) {
  root.read_tables("recording", [&](const TomlTable& table) {
    table.allow_only_keys(recording_keys);
    const TomlValue name = table.need("file");
    const NamedFile recording = named_file(name, file, shown_path, out);
    const std::size_t first = out.scenario.tracks.size();
    Recording(read_file(recording.path, recording.shown_path), recording.shown_path).read(out);
    out.recordings.push_back({name.position(), recording.shown_path, first, out.scenario.tracks.size()});
  });
}

}  // namespace dmrp::host
