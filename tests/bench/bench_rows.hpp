// SPDX-License-Identifier: MIT
// bench_rows.hpp: what benchmarks measure, where they write it, and the time they measure in.
#pragma once

#include <string>
#include <vector>

namespace dmrp::bench {

struct Row {
  std::string name;
  double value;
  std::string unit;
};

struct Output {
  bool json = false;
  std::string csv;     // a file to append to; empty: none
  bool quick = false;  // a small part, once: it shows that the program works
};

// The options --json, --quick and --csv FILE of a benchmark that has no others; ends the program with status 2 on
// anything else.
Output output_options(int argc, char** argv);

// To standard output as lines for people or as [{"name", "value", "unit"}, ...]; and to the CSV file, with its head if it
// is new: commit,date,cpu,name,value,unit. The commit is that of the source tree now, with "-dirty" where files differ
// from it; the date is UTC. Throws std::runtime_error if the file cannot be written.
void write_rows(const std::vector<Row>& rows, const Output& output);

// The second part of write_rows alone.
void append_csv(const std::vector<Row>& rows, const std::string& file);

// Of processor time: of this thread, independent of the machine's load.
double processor_s();

}  // namespace dmrp::bench
