// SPDX-License-Identifier: MIT
// Measures how many instances the planners solve, and how fast: instances of the MovingAI benchmark and the shipped
// scenarios. Runs one `dmrp-host plan` for each plan and validates the files of paths. Prints a table; with --json the
// table goes to standard error, and a list of {"name", "value", "unit"} to standard output.
//
// median: of planning_ms over all instances, where an unsolved one counts as the time limit; mean: over the solved
// ones; nodes: median of high-level expansions of the solved ones; memory: the largest peak of all processes.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "tests/bench/bench_rows.hpp"
#include "tests/bench/planner_runs.hpp"
#include "tests/bench/planner_sets.hpp"

namespace {

using namespace dmrp::bench;
namespace fs = std::filesystem;

struct Options {
  std::vector<std::string> planners;
  std::vector<std::string> on;  // MAP:N[,N]...
  std::vector<std::string> scenarios;
  std::vector<std::string> libraries;
  int instances = 0;  // 0: those of the set
  int times = 20;
  double time_limit_s = 10.0;
  bool quick = false;
  std::string set;                 // crowded, large; "": the standing list
  std::vector<std::string> peers;  // NAME=COMMAND
  fs::path known_costs;            // of peers, as CSV
  Output output;
  fs::path host;
  fs::path data;
};

// A planner and a peer on the instances of a set.
struct Comparison {
  int solved_by_peer = 0;
  double own_cost = 0.0;  // over those that both solve
  double peer_cost = 0.0;
  double peer_cpu_s = 0.0;  // over those that it solves
};

// The costs that peers reached elsewhere: map,scen,agents,planner,solved,sum_of_costs,cpu_s,...
struct KnownCost {
  std::string instance;  // "MAP random-K AGENTS"
  std::string peer;
  double cost;
  double cpu_s;
};

std::vector<KnownCost> read_known_costs(const fs::path& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error(file.string() + ": cannot be read");
  std::vector<KnownCost> known;
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::istringstream fields(line);
    std::string map, tasks, agents, peer, solved, cost, cpu;
    for (std::string* field : {&map, &tasks, &agents, &peer, &solved, &cost, &cpu}) std::getline(fields, *field, ',');
    if (solved == "1")
      known.push_back({map + " " + tasks + " " + agents, peer, std::strtod(cost.c_str(), nullptr),
                       std::strtod(cpu.c_str(), nullptr)});
  }
  return known;
}

// The results of a set.
struct SetResult {
  PlannerSet set;
  int robots = 0;
  int solved = 0;
  double median_ms = 0.0;
  std::optional<double> mean_ms;
  std::optional<double> nodes;
  double peak_rss_mb = 0.0;
  std::optional<double> mean_cost;
  double median_cpu_s = 0.0;
  std::map<std::string, Comparison> against;  // by the peer's name
  std::vector<std::string> errors;
};

class ScratchFolder {
 public:
  ScratchFolder() : path_(fs::temp_directory_path() / ("bench_planners_" + std::to_string(getpid()))) {
    fs::create_directory(path_);
  }
  ~ScratchFolder() { fs::remove_all(path_); }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

std::optional<double> median(std::vector<double> values) {
  if (values.empty()) return std::nullopt;
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

std::optional<double> mean(const std::vector<double>& values) {
  if (values.empty()) return std::nullopt;
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

// The instance in the test data; nothing if its files are missing.
std::optional<Instance> instance_of(const fs::path& data, const PlannerSet& set, int number) {
  if (!set.scenario.empty()) return Instance{{}, {}, 0, set.scenario};
  const std::string tasks = fmt::format("{}-random-{}.scen", set.map, number);
  for (const auto& [maps, scens] :
       {std::pair{data / "movingai/maps", data / "movingai/scens"}, std::pair{data / "generated", data / "generated"}})
    if (fs::exists(maps / (set.map + ".map")) && fs::exists(scens / tasks))
      return Instance{maps / (set.map + ".map"), scens / tasks, set.agents, ""};
  return std::nullopt;
}

std::string place_of(const SetResult& row) {
  return row.set.scenario.empty() ? row.set.map : row.set.scenario;
}

void compare(const PlannerRunResult& own, const std::string& peer, double cost, double cpu_s, SetResult& row) {
  Comparison& comparison = row.against[peer];
  ++comparison.solved_by_peer;
  comparison.peer_cpu_s += cpu_s;
  if (!own.solved) return;
  comparison.own_cost += own.cost;
  comparison.peer_cost += cost;
}

// Peers at hand take turns with the planner.
SetResult measure(const Bench& bench, const PlannerSet& set, const KnownPlanner& known, const fs::path& data,
                  const std::vector<Peer>& peers, const std::vector<KnownCost>& known_costs) {
  SetResult row;
  row.set = set;
  row.robots = set.agents;
  std::vector<double> all_ms, solved_ms, nodes, costs, cpu_s;
  for (int number = 1; number <= set.instances; ++number) {
    const auto instance = instance_of(data, set, number);
    if (!instance) throw std::runtime_error(fmt::format("{}-random-{}.scen is missing", set.map, number));
    const PlannerRunResult result = run(bench, set.planner, known, *instance);
    if (!result.error.empty()) row.errors.push_back(fmt::format("instance {}: {}", number, result.error));
    row.peak_rss_mb = std::max(row.peak_rss_mb, result.peak_rss_mb);
    cpu_s.push_back(result.cpu_s);
    for (const KnownCost& cost : known_costs)
      if (cost.instance == fmt::format("{} random-{} {}", set.map, number, set.agents))
        compare(result, cost.peer, cost.cost, cost.cpu_s, row);
    for (const Peer& peer : peers) {
      if (!set.scenario.empty()) continue;
      const PlannerRunResult other = run_peer(bench, peer, *instance);
      if (!other.error.empty())
        row.errors.push_back(fmt::format("instance {}: {}: {}", number, peer.name, other.error));
      if (other.solved) compare(result, peer.name, other.cost, other.cpu_s, row);
    }
    if (result.robots > 0) row.robots = result.robots;
    all_ms.push_back(result.solved ? result.planning_ms : 1e3 * bench.time_limit_s);
    if (!result.solved) continue;
    solved_ms.push_back(result.planning_ms);
    costs.push_back(result.cost);
    if (result.high_level_expanded) nodes.push_back(*result.high_level_expanded);
  }
  row.solved = static_cast<int>(solved_ms.size());
  row.median_ms = median(all_ms).value_or(0.0);
  row.mean_ms = mean(solved_ms);
  if (set.scenario.empty()) row.mean_cost = mean(costs);
  row.median_cpu_s = median(cpu_s).value_or(0.0);
  row.nodes = median(nodes);
  return row;
}

std::string cell(const std::optional<double>& value, int decimals) {
  return value ? fmt::format("{:.{}f}", *value, decimals) : "-";
}

void print_heading(std::FILE* out) {
  fmt::print(out, "{:<18} {:<24} {:>6}  {:>6}  {:>11} {:>11} {:>8} {:>9} {:>9} {:>9}\n", "planner", "map", "agents",
             "solved", "median ms", "mean ms", "cpu s", "mean cost", "nodes", "memory MB");
}

void print(std::FILE* out, const SetResult& row) {
  fmt::print(out, "{:<18} {:<24} {:>6}  {:>6}  {:>11} {:>11} {:>8.2f} {:>9} {:>9} {:>9.1f}{}\n",
             short_name(row.set.planner), place_of(row), row.robots,
             fmt::format("{}/{}", row.solved, row.set.instances), cell(row.median_ms, 3), cell(row.mean_ms, 3),
             row.median_cpu_s, cell(row.mean_cost, 0), cell(row.nodes, 0), row.peak_rss_mb,
             row.solved < row.set.wanted ? fmt::format("  wanted: {}", row.set.wanted) : "");
  for (const auto& [peer, comparison] : row.against)
    fmt::print(out, "    {}: solved {}, {:.2f} s of CPU each; our cost is {} times its\n", peer,
               comparison.solved_by_peer, comparison.peer_cpu_s / comparison.solved_by_peer,
               comparison.peer_cost > 0 ? fmt::format("{:.3f}", comparison.own_cost / comparison.peer_cost) : "-");
  for (const std::string& error : row.errors) fmt::print(out, "    {}\n", error);
  std::fflush(out);
}

// The id; with the settings if another row has the same planner and the same agents.
std::string name_of(const SetResult& row, const std::vector<SetResult>& rows) {
  const auto twins = std::count_if(rows.begin(), rows.end(), [&](const SetResult& other) {
    return other.set.planner.id == row.set.planner.id && place_of(other) == place_of(row) && other.robots == row.robots;
  });
  std::string id = row.set.planner.id;
  if (twins > 1)
    for (const std::string& setting : row.set.planner.settings) id += " " + setting;
  return fmt::format("planner/{}/{}/{}/", id, place_of(row), row.robots);
}

std::vector<Row> rows_of(const std::vector<SetResult>& results) {
  std::vector<Row> rows;
  for (const SetResult& result : results) {
    const std::string name = name_of(result, results);
    rows.push_back({name + "solved", static_cast<double>(result.solved), "1"});
    rows.push_back({name + "median_ms", result.median_ms, "ms"});
    if (result.mean_ms) rows.push_back({name + "mean_ms", *result.mean_ms, "ms"});
    if (result.nodes) rows.push_back({name + "high_level_expanded", *result.nodes, "1"});
    rows.push_back({name + "peak_rss_mb", result.peak_rss_mb, "MB"});
    rows.push_back({name + "median_cpu_s", result.median_cpu_s, "s"});
    if (result.mean_cost) rows.push_back({name + "mean_cost", *result.mean_cost, "1"});
    for (const auto& [peer, comparison] : result.against)
      if (comparison.peer_cost > 0)
        rows.push_back({name + "cost_over/" + peer, comparison.own_cost / comparison.peer_cost, "1"});
  }
  return rows;
}

bool lists_robots(const fs::path& scenario) {
  std::ifstream file(scenario);
  for (std::string line; std::getline(file, line);)
    if (line == "[[robot]]") return true;
  return false;
}

// The scenarios with a task of their own; the others draw theirs by an experiment's order.
std::vector<std::string> scenarios_beside(const fs::path& host) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(host.parent_path().parent_path() / "share/dmrp/scenarios", ignored))
    if (lists_robots(entry.path() / "scenario.toml")) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

// "MAP:N,N" as sets of one planner.
void add_sets(const PlannerChoice& planner, const std::string& on, std::vector<PlannerSet>& sets) {
  const std::size_t colon = on.rfind(':');
  if (colon == std::string::npos) throw std::runtime_error("--on " + on + ": needs MAP:N[,N...]");
  std::istringstream numbers(on.substr(colon + 1));
  for (std::string number; std::getline(numbers, number, ',');) {
    const int agents = std::atoi(number.c_str());
    if (agents < 1) throw std::runtime_error("--on " + on + ": needs MAP:N[,N...]");
    sets.push_back({planner, on.substr(0, colon), agents, 5, -1, ""});
  }
}

// The chosen planners on the chosen maps and scenarios; or the standing list, restricted to the chosen planners.
std::vector<PlannerSet> sets_of(const Options& options, const std::vector<KnownPlanner>& known) {
  std::vector<PlannerChoice> chosen;
  for (const std::string& text : options.planners) chosen.push_back(planner_choice(text));
  std::vector<PlannerSet> sets;
  if (!options.on.empty() || !options.scenarios.empty()) {
    if (chosen.empty())
      for (const KnownPlanner& planner : known) chosen.push_back({planner.id, {}});
    for (const PlannerChoice& planner : chosen) {
      for (const std::string& on : options.on) add_sets(planner, on, sets);
      for (const std::string& scenario : options.scenarios)
        sets.push_back({planner, "", 0, options.times, options.times, scenario});
    }
  } else {
    if (options.set == "crowded") {
      sets = crowded_sets();
    } else if (options.set == "large") {
      sets = large_sets();
    } else {
      sets = options.quick ? quick_sets() : acceptance_sets();
      const auto more = scenario_sets(known, scenarios_beside(options.host), options.quick ? 3 : options.times);
      sets.insert(sets.end(), more.begin(), more.end());
    }
    std::erase_if(sets, [&](const PlannerSet& set) {
      return !chosen.empty() && std::none_of(chosen.begin(), chosen.end(), [&](const PlannerChoice& planner) {
        return planner.id == set.planner.id && (planner.settings.empty() || planner == set.planner);
      });
    });
  }
  for (PlannerSet& set : sets)
    if (options.instances > 0 && set.scenario.empty() && set.instances != options.instances) {
      set.instances = options.instances;
      set.wanted = -1;
    }
  return sets;
}

int run_all(const Options& options) {
  const ScratchFolder scratch;
  const Bench bench{options.host, scratch.path(), options.libraries, options.time_limit_s};
  const std::vector<KnownPlanner> known = known_planners(bench);
  std::vector<Peer> peers;
  for (const std::string& text : options.peers) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0) throw std::runtime_error("--peer " + text + ": needs NAME=COMMAND");
    peers.push_back({text.substr(0, equals), text.substr(equals + 1)});
  }
  std::vector<KnownCost> known_costs;
  if (!options.known_costs.empty()) known_costs = read_known_costs(options.known_costs);
  std::vector<SetResult> rows;
  bool sound = true;
  std::FILE* const table = options.output.json ? stderr : stdout;
  print_heading(table);
  for (const PlannerSet& set : sets_of(options, known)) {
    const auto planner = std::find_if(known.begin(), known.end(),
                                      [&](const KnownPlanner& candidate) { return candidate.id == set.planner.id; });
    if (planner == known.end() || !instance_of(options.data, set, set.instances)) {
      fmt::print(stderr, "skipped: {} on {}: {}\n", short_name(set.planner), set.map,
                 planner == known.end() ? "there is no such planner" : "not in the test data");
      continue;
    }
    rows.push_back(measure(bench, set, *planner, options.data, peers, known_costs));
    sound = sound && rows.back().errors.empty();
    print(table, rows.back());
  }
  if (options.output.json) write_rows(rows_of(rows), {true, ""});
  if (!options.output.csv.empty()) append_csv(rows_of(rows), options.output.csv);
  return sound ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  options.host = fs::read_symlink("/proc/self/exe").parent_path() / "dmrp-host";
  const char* const data = std::getenv("DMRP_TEST_DATA");
  options.data = data ? data : DMRP_TEST_DATA;
  CLI::App app("Measures global planners: without options on the project's standing list and the shipped scenarios.");
  app.add_option("--planner", options.planners, "only this one, as \"eecbs suboptimality=1.2\"")
      ->allow_extra_args(false);
  app.add_option("--on", options.on, "on these agents of a map in place of the standing list")
      ->type_name("MAP:N[,N...]")
      ->allow_extra_args(false);
  app.add_option("--scenario", options.scenarios, "on a scenario in place of the standing list")
      ->allow_extra_args(false);
  app.add_option("--plugin", options.libraries, "another plugin library")->type_name("LIB.so")->allow_extra_args(false);
  app.add_option("--instances", options.instances, "random-1 to random-K of every map")->check(CLI::Range(1, 25));
  app.add_option("--times", options.times, "how often a scenario is planned")->check(CLI::Range(1, 1000));
  app.add_option("--time-limit", options.time_limit_s, "seconds for each plan")->check(CLI::Range(1e-3, 1e6));
  app.add_option("--set", options.set, "many robots on small or on large maps, in place of the standing list")
      ->check(CLI::IsMember({"crowded", "large"}));
  app.add_option("--peer", options.peers,
                 "another program that takes turns on every map: a shell command that reads MAP, SCEN, AGENTS and "
                 "TIME_LIMIT from the environment and writes agent,t,x,y to the file PATHS")
      ->type_name("NAME=COMMAND")
      ->allow_extra_args(false);
  app.add_option("--known-costs", options.known_costs,
                 "compare with map,scen,agents,planner,solved,sum_of_costs,cpu_s of peers")
      ->type_name("FILE.csv");
  app.add_flag("--quick", options.quick, "some of the standing list");
  app.add_flag("--json", options.output.json, "a list of name, value, unit");
  app.add_option("--csv", options.output.csv, "append the values to this file")->type_name("FILE");
  app.add_option("--host", options.host, "dmrp-host (default: the one beside this program)");
  app.add_option("--data", options.data, "folder of the maps (default: DMRP_TEST_DATA)");
  CLI11_PARSE(app, argc, argv);
  try {
    return run_all(options);
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_planners: {}\n", error.what());
    return 2;
  }
}
