// SPDX-License-Identifier: MIT
#include "tests/bench/bench_rows.hpp"

#include <time.h>

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace dmrp::bench {

namespace {

// Counts exactly, measured values with six digits.
std::string text(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, value == std::floor(value) && std::fabs(value) < 1e15 ? "%.0f" : "%.6g", value);
  return buffer;
}

void print_rows(const std::vector<Row>& rows, bool json) {
  if (json) std::printf("[");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (json) {
      std::printf("%s\n  {\"name\": \"%s\", \"value\": %s, \"unit\": \"%s\"}", i == 0 ? "" : ",", rows[i].name.c_str(),
                  text(rows[i].value).c_str(), rows[i].unit.c_str());
    } else {
      std::printf("%-55s %12s %s\n", rows[i].name.c_str(), text(rows[i].value).c_str(), rows[i].unit.c_str());
    }
  }
  if (json) std::printf("\n]\n");
}

std::string commit() {
  std::FILE* const git = popen("git -C '" DMRP_SOURCE_DIR "' describe --always --dirty --exclude='*' 2>/dev/null", "r");
  char line[100] = "";
  if (git) {
    if (!std::fgets(line, sizeof line, git)) line[0] = '\0';
    pclose(git);
  }
  line[std::strcspn(line, "\n")] = '\0';
  return line[0] ? line : "unknown";
}

std::string date() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  char buffer[20];
  std::strftime(buffer, sizeof buffer, "%Y-%m-%dT%H:%MZ", &utc);
  return buffer;
}

std::string cpu() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.rfind("model name", 0) == 0 && line.find(": ") != std::string::npos)
      return line.substr(line.find(": ") + 2);
  return "unknown";
}

std::string csv_field(const std::string& field) {
  if (field.find_first_of(",\"\n") == std::string::npos) return field;
  std::string quoted = "\"";
  for (const char c : field) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

}  // namespace

Output output_options(int argc, char** argv) {
  Output output;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--json") == 0) {
      output.json = true;
    } else if (std::strcmp(argv[i], "--quick") == 0) {
      output.quick = true;
    } else if (std::strcmp(argv[i], "--csv") == 0 && i + 1 < argc) {
      output.csv = argv[++i];
    } else {
      std::fprintf(stderr, "usage: %s [--json] [--quick] [--csv FILE]\n", argv[0]);
      std::exit(2);
    }
  }
  return output;
}

void append_csv(const std::vector<Row>& rows, const std::string& file) {
  std::error_code absent;
  const bool is_new = std::filesystem::file_size(file, absent) == 0 || absent;
  std::ofstream out(file, std::ios::app);
  if (is_new) out << "commit,date,cpu,name,value,unit\n";
  const std::string common = csv_field(commit()) + "," + date() + "," + csv_field(cpu()) + ",";
  for (const Row& row : rows)
    out << common << csv_field(row.name) << "," << text(row.value) << "," << csv_field(row.unit) << "\n";
  if (!out.flush()) throw std::runtime_error(file + ": cannot be written");
}

void write_rows(const std::vector<Row>& rows, const Output& output) {
  print_rows(rows, output.json);
  if (!output.csv.empty()) append_csv(rows, output.csv);
}

double processor_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace dmrp::bench
