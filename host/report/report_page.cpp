// SPDX-License-Identifier: MIT
#include "host/report/report_page.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "host/errors/input_error.hpp"
#include "host/files/read_file.hpp"
#include "host/report/replay/page_packing.hpp"

namespace dmrp::host {
namespace {

namespace fs = std::filesystem;

std::string part(const fs::path& folder, const std::string& name) {
  const fs::path file = folder / name;
  return read_file(file, file.string());
}

// "</script" ends a script element. In a string or a regular expression of a script, "<\/script" is equivalent.
std::string script_text(std::string text) {
  constexpr std::string_view end_tag = "</script";
  for (std::size_t at = 0; at + end_tag.size() <= text.size(); ++at)
    if (std::equal(end_tag.begin(), end_tag.end(), text.begin() + static_cast<std::ptrdiff_t>(at),
                   [](char a, char b) { return a == static_cast<char>(std::tolower(static_cast<unsigned char>(b))); }))
      text.insert(at + 1, "\\");
  return text;
}

// In JSON, "<" occurs in strings only.
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

// A script element of a type that browsers do not run.
std::string packed_element(const std::string& id, const std::string& base64) {
  return "<script type=\"application/gzip\" id=\"" + id + "\">" + base64 + "</script>\n";
}

void replace_line(std::string& page, const std::string& line, const std::string& content, const fs::path& file) {
  const std::size_t at = page.find(line);
  if (at == std::string::npos) throw InputError(file.string() + ": has no line " + line);
  page.replace(at, line.size(), content);
}

}  // namespace

std::string report_page(const fs::path& folder, const std::string& name, const std::string& data_json,
                        std::span<const EmbeddedReplay> replays) {
  const fs::path file = folder / (name + ".html");
  std::string page = part(folder, name + ".html");
  const std::string styles = "<style>\n" + part(folder, name + ".css") + "</style>\n";
  std::string data = "<script type=\"application/json\" id=\"dmrp-data\">" + json_text(data_json) + "</script>\n";
  for (const EmbeddedReplay& replay : replays) data += packed_element(replay.element, replay.base64);
  if (!replays.empty()) data += packed_element("dmrp-three", base64(gzip(part(folder, "three.min.js"))));
  const std::string scripts = "<script>\n" + script_text(part(folder, name + ".js")) + "</script>\n";

  // from the end of the page, so that inserted text is not searched
  replace_line(page, "<!-- dmrp:scripts -->", scripts, file);
  replace_line(page, "<!-- dmrp:data -->", data, file);
  replace_line(page, "<!-- dmrp:styles -->", styles, file);
  return page;
}

}  // namespace dmrp::host
