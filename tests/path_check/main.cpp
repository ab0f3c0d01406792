// SPDX-License-Identifier: MIT
// check_paths MAP SCEN AGENTS CONNECTIVITY PATHS.csv: one line "cost C makespan M conflicts N"; status 1 with conflicts
// or if a single path is invalid.
#include <cstdio>
#include <cstdlib>

#include "tests/path_check/path_check.hpp"

int main(int argc, char** argv) {
  if (argc != 6) {
    std::fprintf(stderr, "check_paths MAP SCEN AGENTS CONNECTIVITY PATHS.csv\n");
    return 2;
  }
  const auto verdict = dmrp::test::check_paths(argv[1], argv[2], std::atoi(argv[3]), std::atoi(argv[4]), argv[5]);
  if (!verdict.error.empty()) {
    std::printf("%s\n", verdict.error.c_str());
    return 1;
  }
  std::printf("cost %.6f makespan %ld conflicts %ld\n", verdict.cost(), verdict.makespan, verdict.conflicts);
  if (verdict.conflicts > 0) std::fprintf(stderr, "%s\n", verdict.first_conflict.c_str());
  return verdict.conflicts > 0 ? 1 : 0;
}
