// SPDX-License-Identifier: MIT
#include "host/report/report_page.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "host/errors/input_error.hpp"
#include "host/files/read_file.hpp"

namespace dmrp::host {
namespace {

namespace fs = std::filesystem;

// Files of that ending, in the order of their names but for those in `first`.
std::vector<fs::path> parts(const fs::path& folder, std::string_view ending, std::span<const char* const> first) {
  std::vector<fs::path> ordered;
  for (const char* name : first) ordered.push_back(folder / name);
  const auto begin = static_cast<std::ptrdiff_t>(ordered.size());
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
    if (entry.path().extension() == ending &&
        std::find(ordered.begin(), ordered.begin() + begin, entry.path()) == ordered.begin() + begin)
      ordered.push_back(entry.path());
  std::sort(ordered.begin() + begin, ordered.end());
  return ordered;
}

// "</script" would end the element that holds it; in a script, within a string or a regular expression, "<\/script"
// means the same.
std::string script_text(std::string text) {
  constexpr std::string_view end_tag = "</script";
  for (std::size_t at = 0; at + end_tag.size() <= text.size(); ++at)
    if (std::equal(end_tag.begin(), end_tag.end(), text.begin() + static_cast<std::ptrdiff_t>(at),
                   [](char a, char b) { return a == static_cast<char>(std::tolower(static_cast<unsigned char>(b))); }))
      text.insert(at + 1, "\\");
  return text;
}

// In JSON a "<" stands in texts only.
std::string json_text(const std::string& json) {
  std::string text;
  text.reserve(json.size());
  for (const char c : json)
    if (c == '<')
      text += "\\u003c";
    else
      text += c;
  return text;
}

void replace_line(std::string& page, const std::string& line, const std::string& content, const fs::path& file) {
  const std::size_t at = page.find(line);
  if (at == std::string::npos) throw InputError(file.string() + ": has no line " + line);
  page.replace(at, line.size(), content);
}

}  // namespace

std::string report_page(const fs::path& folder, const std::string& data_json, std::span<const EmbeddedReplay> replays) {
  static constexpr const char* const styles_first[] = {"style.css"};
  static constexpr const char* const libraries[] = {"d3.min.js", "three.min.js"};
  const fs::path file = folder / "page.html";
  std::string page = read_file(file, file.string());

  std::string styles;
  for (const fs::path& part : parts(folder, ".css", styles_first))
    styles += "<style>\n" + read_file(part, part.string()) + "</style>\n";
  std::string data = "<script type=\"application/json\" id=\"dmrp-data\">" + json_text(data_json) + "</script>\n";
  for (const EmbeddedReplay& replay : replays)
    data += "<script type=\"application/gzip\" id=\"" + replay.element + "\">" + replay.base64 + "</script>\n";
  std::string scripts;
  for (const fs::path& part : parts(folder, ".js", libraries))
    scripts += "<script>\n" + script_text(read_file(part, part.string())) + "</script>\n";

  // from the page's end: what is put in is not searched again
  replace_line(page, "<!-- dmrp:scripts -->", scripts, file);
  replace_line(page, "<!-- dmrp:data -->", data, file);
  replace_line(page, "<!-- dmrp:styles -->", styles, file);
  return page;
}

}  // namespace dmrp::host
