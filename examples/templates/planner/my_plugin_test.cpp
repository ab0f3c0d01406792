// SPDX-License-Identifier: MIT
// The planner without dmrp-host, on halls drawn in text (dmrp/testing.hpp): '#' is a wall, A starts and goes to a.
#include "my_plugin.cpp"

#include <cstdio>
#include <dmrp/testing.hpp>

namespace {

int failures = 0;

void expect(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "FAILED: %s\n", what);
  ++failures;
}

void two_robots_pass_each_other() {
  const std::vector<std::string> rows = {"A.#.b",  // the top
                                         ".....",  //
                                         "B.#.a"};
  const dmrp::testing::Hall hall(rows);
  const auto answer = dmrp::testing::plan("org.example.my_plugin", hall);
  expect(answer.status == DMRP_OK, "there is a plan");
  expect(answer.breach.empty(), answer.breach.c_str());
}

void nobody_walks_through_a_wall() {
  const dmrp::testing::Hall hall({"A#a"});
  expect(dmrp::testing::plan("org.example.my_plugin", hall).status == DMRP_NO_SOLUTION, "there is no way");
}

}  // namespace

int main() {
  two_robots_pass_each_other();
  nobody_walks_through_a_wall();
  return failures;
}
