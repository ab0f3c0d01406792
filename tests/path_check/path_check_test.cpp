// SPDX-License-Identifier: MIT
// Each rule of the path check has a file that violates only this rule.
#include "tests/path_check/path_check.hpp"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

using dmrp::test::check_paths;
using dmrp::test::PathVerdict;

namespace {

namespace fs = std::filesystem;

// A 4x3 map with one blocked cell, (1, 1), and two tasks: (0, 0) to (2, 0), and (3, 2) to (3, 0).
class Files {
 public:
  Files() {
    fs::create_directory(folder_);
    write("m.map", "type octile\nheight 3\nwidth 4\nmap\n....\n.@..\n....\n");
    write("s.scen", "version 1\n0\tm.map\t4\t3\t0\t0\t2\t0\t2\n0\tm.map\t4\t3\t3\t2\t3\t0\t2\n");
  }
  ~Files() { fs::remove_all(folder_); }

  PathVerdict judge(const std::string& paths, int connectivity = 4, int agents = 2) const {
    write("p.csv", paths);
    return check_paths(path("m.map"), path("s.scen"), agents, connectivity, path("p.csv"));
  }

  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }

 private:
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  fs::path folder_ = fs::temp_directory_path() / ("dmrp_path_check_" + std::to_string(getpid()));
};

const std::string first = "agent,t,x,y\n0,0,0,0\n0,1,1,0\n0,2,2,0\n";
const std::string second = "1,0,3,2\n1,1,3,1\n1,2,3,0\n";

}  // namespace

TEST_CASE("valid paths have no error, and their steps are counted") {
  const Files files;
  const PathVerdict verdict = files.judge(first + "1,0,3,2\n1,1,3,2\n1,2,3,1\n1,3,3,0\n");
  CHECK(verdict.error == "");
  CHECK(verdict.conflicts == 0);
  CHECK(verdict.cost() == 5.0);
  CHECK(verdict.makespan == 3);
}

TEST_CASE("an invalid single path is rejected") {
  const Files files;
  const auto error = [&](const std::string& paths, int connectivity = 4) {
    return files.judge(paths, connectivity).error;
  };
  CHECK_THAT(error("0,0,0,0\n"), Catch::Contains("does not begin with"));
  CHECK_THAT(error(first), Catch::Contains("1 paths for 2 agents"));
  CHECK_THAT(error(second), Catch::Contains("does not begin with"));
  CHECK_THAT(error(first + "1,0,3,2\n1,2,3,1\n1,3,3,0\n"), Catch::Contains("out of order"));
  CHECK_THAT(error(first + "1,0,3,2\n1,1,3,1.5\n"), Catch::Contains("not four whole numbers"));
  CHECK_THAT(error(first + "1,0,3,1\n1,1,3,0\n"), Catch::Contains("agent 1 begins at (3, 1)"));
  CHECK_THAT(error(first + "1,0,3,2\n1,1,3,1\n"), Catch::Contains("agent 1 ends at (3, 1)"));
  CHECK_THAT(error(first + "1,0,3,2\n1,1,3,0\n"), Catch::Contains("jumps"));
  CHECK_THAT(error(first + second + "1,3,3,0\n"), Catch::Contains("goes on after"));
  CHECK_THAT(error("agent,t,x,y\n0,0,0,0\n0,1,0,1\n0,2,1,1\n0,3,1,0\n0,4,2,0\n" + second),
             Catch::Contains("blocked cell (1, 1)"));
  CHECK_THAT(error("agent,t,x,y\n0,0,0,0\n0,1,0,-1\n0,2,1,-1\n0,3,2,0\n" + second), Catch::Contains("blocked cell"));
  const std::string with_diagonal = first + "1,0,3,2\n1,1,2,1\n1,2,3,1\n1,3,3,0\n";
  CHECK_THAT(error(with_diagonal), Catch::Contains("moves diagonally"));
  CHECK(error(with_diagonal, 8) == "");
  CHECK_THAT(error("agent,t,x,y\n0,0,0,0\n0,1,0,1\n0,2,1,0\n0,3,2,0\n" + second, 8), Catch::Contains("cuts a corner"));
}

TEST_CASE("conflicts are found") {
  const Files files;
  const auto conflict = [&](const std::string& tasks, const std::string& paths) {
    files.write("s.scen", "version 1\n" + tasks);
    const PathVerdict verdict = files.judge(paths, 8);
    CHECK(verdict.error == "");
    return verdict.first_conflict;
  };
  const auto task = [](const std::string& places) { return "0\tm.map\t4\t3\t" + places + "\t1\n"; };
  const std::string head = "agent,t,x,y\n";
  CHECK(conflict(task("0\t0\t2\t0") + task("2\t1\t2\t2"),
                 head + "0,0,0,0\n0,1,1,0\n0,2,2,0\n1,0,2,1\n1,1,2,0\n1,2,2,1\n1,3,2,2\n") == "");
  CHECK(conflict(task("0\t0\t2\t0") + task("3\t0\t2\t1"),
                 head + "0,0,0,0\n0,1,1,0\n0,2,2,0\n1,0,3,0\n1,1,3,0\n1,2,2,0\n1,3,2,1\n") ==
        "vertex conflict of agents 0 and 1 at step 2");
  CHECK(conflict(task("0\t0\t2\t0") + task("3\t0\t3\t1"),
                 head + "0,0,0,0\n0,1,1,0\n0,2,2,0\n1,0,3,0\n1,1,3,0\n1,2,3,0\n1,3,2,0\n1,4,3,0\n1,5,3,1\n") ==
        "vertex conflict of agents 0 and 1 at step 3");  // it rests there
  CHECK(conflict(task("0\t0\t1\t0") + task("1\t0\t0\t0"), head + "0,0,0,0\n0,1,1,0\n1,0,1,0\n1,1,0,0\n") ==
        "swap conflict of agents 0 and 1 at step 1");
  CHECK(conflict(task("2\t0\t3\t1") + task("3\t0\t2\t1"), head + "0,0,2,0\n0,1,3,1\n1,0,3,0\n1,1,2,1\n") ==
        "passing conflict of agents 0 and 1 at step 1");  // two diagonals cross
  CHECK(conflict(task("2\t0\t3\t1") + task("3\t0\t3\t0"), head + "0,0,2,0\n0,1,3,1\n1,0,3,0\n") ==
        "passing conflict of agents 0 and 1 at step 1");  // stands beside
  CHECK(conflict(task("2\t0\t3\t1") + task("2\t2\t2\t1"), head + "0,0,2,0\n0,1,3,1\n1,0,2,2\n1,1,2,1\n") ==
        "passing conflict of agents 0 and 1 at step 1");  // comes there
  CHECK(conflict(task("3\t1\t3\t2") + task("2\t0\t3\t1"), head + "0,0,3,1\n0,1,3,2\n1,0,2,0\n1,1,3,1\n") ==
        "");  // follows
}
