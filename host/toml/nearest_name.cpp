// SPDX-License-Identifier: MIT
#include "host/toml/nearest_name.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace dmrp::host {

namespace {

// Counts insertions, deletions, substitutions and swaps of adjacent letters (optimal string alignment).
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    std::swap(before, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

// The one known name whose last part is what was written: "pace" is "org.controller.pace". Empty if there are several.
std::string only_name_ending_with(std::string written, const std::vector<std::string>& known) {
  for (char& c : written)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  std::string found;
  for (const std::string& name : known) {
    if (written.empty() || !name.ends_with("." + written)) continue;
    if (!found.empty()) return "";
    found = name;
  }
  return found;
}

}  // namespace

std::string nearest_name(const std::string& written, const std::vector<std::string>& known) {
  if (const std::string name = only_name_ending_with(written, known); !name.empty()) return name;
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(2, written.size() / 3) + 1;
  for (const std::string& name : known) {
    const std::size_t distance = edit_distance(written, name);
    if (distance < best_distance) {
      best_distance = distance;
      best = name;
    }
  }
  return best;
}

std::string did_you_mean(const std::string& written, const std::vector<std::string>& known) {
  const std::string name = nearest_name(written, known);
  return name.empty() ? "" : " (did you mean '" + name + "'?)";
}

std::string among(const std::string& written, const std::vector<std::string>& known) {
  const std::string name = nearest_name(written, known);
  return (name.empty() ? " (" : " (did you mean '" + name + "'? ") + "there: " + join_names(known) + ")";
}

std::string join_names(const std::vector<std::string>& names) {
  std::string out;
  for (const std::string& name : names) out += (out.empty() ? "" : ", ") + name;
  return out.empty() ? "none" : out;
}

}  // namespace dmrp::host
