// SPDX-License-Identifier: MIT
// check_values RUN_DIR CSV: whether the values that `dmrp-host evaluate` wrote are those of results.sqlite, bit by bit:
// all rows of all metrics that the CSV names, of the trials that it names, in the same order.
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "host/results/database.hpp"

namespace {

using dmrp::host::MetricValue;

struct Row {
  std::uint64_t trial = 0;
  MetricValue value;
};

template <class Number>
Number number_of(const std::string& text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) throw std::runtime_error("no number: '" + text + "'");
  return number;
}

template <class Number>
std::optional<Number> optional_of(const std::string& text) {
  return text.empty() ? std::nullopt : std::optional(number_of<Number>(text));
}

std::uint32_t subject_kind_of(const std::string& text) {
  for (std::uint32_t i = 0; i < dmrp::host::subject_kind_names.size(); ++i)
    if (text == dmrp::host::subject_kind_names[i]) return i;
  throw std::runtime_error("no subject: '" + text + "'");
}

// None of these fields needs quotes.
std::vector<Row> read_csv(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  if (!std::getline(file, line) || line != "trial,metric,subject_kind,subject,coordinate,value")
    throw std::runtime_error("another header: " + line);
  std::vector<Row> rows;
  while (std::getline(file, line)) {
    std::vector<std::string> fields;
    std::istringstream stream(line + ",");
    for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
    if (fields.size() != 6) throw std::runtime_error("not six fields: " + line);
    rows.push_back({number_of<std::uint64_t>(fields[0]),
                    {fields[1], subject_kind_of(fields[2]), optional_of<std::uint64_t>(fields[3]),
                     optional_of<double>(fields[4]), optional_of<double>(fields[5])}});
  }
  return rows;
}

std::vector<Row> read_database(const std::string& run_directory, const std::vector<Row>& like) {
  std::set<std::string> metrics;
  std::set<std::uint64_t> trials;
  for (const Row& row : like) {
    metrics.insert(row.value.metric);
    trials.insert(row.trial);
  }
  std::vector<Row> rows;
  for (const auto& trial : dmrp::host::ResultsDatabase::open_read_only(run_directory + "/results.sqlite").trials())
    for (const MetricValue& value : trial.values)
      if (trials.count(trial.id) > 0 && metrics.count(value.metric) > 0) rows.push_back({trial.id, value});
  return rows;
}

bool same_bits(const std::optional<double>& a, const std::optional<double>& b) {
  if (!a || !b) return !a && !b;
  return std::memcmp(&*a, &*b, sizeof(double)) == 0;
}

bool same(const Row& a, const Row& b) {
  return a.trial == b.trial && a.value.metric == b.value.metric && a.value.subject_kind == b.value.subject_kind &&
         a.value.subject == b.value.subject && same_bits(a.value.coordinate, b.value.coordinate) &&
         same_bits(a.value.value, b.value.value);
}

int compare(const std::string& run_directory, const std::string& csv) {
  const std::vector<Row> evaluated = read_csv(csv);
  const std::vector<Row> measured = read_database(run_directory, evaluated);
  if (evaluated.size() != measured.size()) {
    std::printf("%zu values evaluated, %zu measured\n", evaluated.size(), measured.size());
    return 1;
  }
  for (std::size_t i = 0; i < evaluated.size(); ++i)
    if (!same(evaluated[i], measured[i])) {
      std::printf("line %zu: trial %llu, %s: evaluated %.17g, measured %.17g\n", i + 2,
                  static_cast<unsigned long long>(evaluated[i].trial), evaluated[i].value.metric.c_str(),
                  evaluated[i].value.value.value_or(NAN), measured[i].value.value.value_or(NAN));
      return 1;
    }
  std::size_t of_robots = 0;
  std::size_t of_curves = 0;
  for (const Row& row : evaluated) {
    of_robots += row.value.subject_kind == DMRP_SUBJECT_ROBOT;
    of_curves += row.value.coordinate.has_value();
  }
  std::printf("%zu values, %zu of robots, %zu of curves\n", evaluated.size(), of_robots, of_curves);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return std::fprintf(stderr, "usage: check_values RUN_DIR CSV\n"), 2;
  try {
    return compare(argv[1], argv[2]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "check_values: %s\n", error.what());
    return 2;
  }
}
