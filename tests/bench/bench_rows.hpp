// SPDX-License-Identifier: MIT
// bench_rows.hpp: what benchmarks print, and the time they measure in.
#pragma once

#include <time.h>

#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

namespace dmrp::bench {

struct Row {
  std::string name;
  double value;
  std::string unit;
};

// Lines for people, or [{"name", "value", "unit"}, ...].
inline void print_rows(const std::vector<Row>& rows, bool json) {
  if (json) std::printf("[");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (json) {
      std::printf("%s\n  {\"name\": \"%s\", \"value\": %.6g, \"unit\": \"%s\"}", i == 0 ? "" : ",",
                  rows[i].name.c_str(), rows[i].value, rows[i].unit.c_str());
    } else {
      std::printf("%-50s %12.6g %s\n", rows[i].name.c_str(), rows[i].value, rows[i].unit.c_str());
    }
  }
  if (json) std::printf("\n]\n");
}

// Of processor time: of one core, whoever else is using the machine.
inline double processor_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace dmrp::bench
