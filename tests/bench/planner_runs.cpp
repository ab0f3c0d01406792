// SPDX-License-Identifier: MIT
#include "tests/bench/planner_runs.hpp"

#include <sys/resource.h>
#include <sys/wait.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "tests/path_check/path_check.hpp"

namespace dmrp::bench {

namespace {

namespace fs = std::filesystem;

const std::string own_prefix = "dmrp.planner.";

std::string quoted(const std::string& word) {
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::string content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

std::string last_line(const std::string& text) {
  const std::size_t end = text.find_last_not_of('\n');
  if (end == std::string::npos) return "";
  const std::size_t begin = text.find_last_of('\n', end);
  return text.substr(begin == std::string::npos ? 0 : begin + 1, end - (begin == std::string::npos ? 0 : begin));
}

// Of all processes that were started and have ended.
double cpu_of_children_s() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

struct Called {
  int status = 0;  // exit status, or 128 + signal
  nlohmann::json document;
  std::string errors;
};

Called call(const Bench& bench, const std::vector<std::string>& arguments) {
  const fs::path out = bench.scratch / "stdout";
  const fs::path errors = bench.scratch / "stderr";
  std::string command = quoted(bench.host.string());
  for (const std::string& argument : arguments) command += " " + quoted(argument);
  const int status = std::system((command + " >" + quoted(out.string()) + " 2>" + quoted(errors.string())).c_str());
  Called called;
  called.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  if (called.status >= 128) throw std::runtime_error("interrupted");
  called.document = nlohmann::json::parse(content(out), nullptr, false);
  called.errors = last_line(content(errors));
  return called;
}

std::optional<double> number(const nlohmann::json& document, const char* key) {
  const auto found = document.find(key);
  return found != document.end() && found->is_number() ? std::optional(found->get<double>()) : std::nullopt;
}

// Checks the host's figures of a plan against the file of paths and the tasks. Returns the error, or nothing.
std::string validate(const nlohmann::json& document, const KnownPlanner& known, const Instance& instance,
                     const fs::path& paths) {
  if (!document.at("valid").get<bool>()) return "the host reports an invalid plan";
  if (!instance.scenario.empty()) return "";  // there is no map to check against
  const test::PathVerdict verdict = test::check_paths(instance.map.string(), instance.tasks.string(), instance.agents,
                                                      known.connectivity, paths.string());
  if (!verdict.error.empty()) return "wrong paths: " + verdict.error;
  if (verdict.conflicts > 0 && !known.uncoordinated) return "wrong paths: " + verdict.first_conflict;
  if (std::abs(verdict.cost() - number(document, "cost").value_or(-1.0)) > 1e-6 * verdict.cost())
    return "the cost of the paths differs from the host's";
  return "";
}

}  // namespace

PlannerChoice planner_choice(const std::string& text) {
  std::istringstream words(text);
  PlannerChoice choice;
  words >> choice.id;
  if (choice.id.find('.') == std::string::npos) choice.id = own_prefix + choice.id;
  for (std::string setting; words >> setting;) choice.settings.push_back(setting);
  return choice;
}

std::string short_name(const PlannerChoice& planner) {
  const bool ours = planner.id.rfind(own_prefix, 0) == 0;
  std::string name = ours ? planner.id.substr(own_prefix.size()) : planner.id;
  const std::string common = "suboptimality=";
  for (const std::string& setting : planner.settings)
    name += " " + (setting.rfind(common, 0) == 0 ? setting.substr(common.size()) : setting);
  return name;
}

std::vector<KnownPlanner> known_planners(const Bench& bench) {
  std::vector<std::string> arguments = {"plugins", "--json"};
  Called called = call(bench, arguments);  // libraries of the plugin path
  nlohmann::json libraries = called.document;
  if (!bench.libraries.empty()) {
    arguments.insert(arguments.end(), bench.libraries.begin(), bench.libraries.end());
    called = call(bench, arguments);
    if (called.status == 0) libraries.insert(libraries.end(), called.document.begin(), called.document.end());
  }
  if (called.status != 0) throw std::runtime_error(called.errors);
  std::vector<KnownPlanner> planners;
  for (const auto& library : libraries)
    for (const auto& plugin : library.at("plugins"))
      if (plugin.at("kind") == "global_planner") {
        const auto connectivity = plugin.at("connectivity").get<std::string>();
        const auto flags = plugin.at("flags").get<std::vector<nlohmann::json>>();
        planners.push_back({plugin.at("id").get<std::string>(), connectivity == "any" ? 255 : std::stoi(connectivity),
                            std::find(flags.begin(), flags.end(), "uncoordinated") != flags.end()});
      }
  return planners;
}

PlannerRunResult run(const Bench& bench, const PlannerChoice& planner, const KnownPlanner& known,
                     const Instance& instance) {
  const fs::path paths = bench.scratch / "paths.csv";
  std::vector<std::string> arguments = {"plan",     "--json",       "--planner",
                                        planner.id, "--time-limit", std::to_string(bench.time_limit_s),
                                        "--paths",  paths.string()};
  for (const std::string& library : bench.libraries) arguments.insert(arguments.end(), {"--plugin", library});
  for (const std::string& setting : planner.settings) arguments.insert(arguments.end(), {"--set", setting});
  if (instance.scenario.empty())
    arguments.insert(arguments.end(), {"--map", instance.map.string(), "--scen", instance.tasks.string(), "--agents",
                                       std::to_string(instance.agents)});
  else
    arguments.insert(arguments.end(), {"--scenario", instance.scenario});

  const double cpu_before_s = cpu_of_children_s();
  const Called called = call(bench, arguments);
  if (called.status == 2) throw std::runtime_error(called.errors);  // all other instances would fail, too
  PlannerRunResult result;
  result.cpu_s = cpu_of_children_s() - cpu_before_s;
  if (!called.document.is_object()) {
    result.error = "no JSON: " + called.errors;
    return result;
  }
  result.planning_ms = number(called.document, "planning_ms").value_or(0.0);
  result.high_level_expanded = number(called.document, "high_level_expanded");
  result.peak_rss_mb = number(called.document, "peak_rss_mb").value_or(0.0);
  result.robots = static_cast<int>(number(called.document, "robots").value_or(0.0));
  if (called.status != 0) result.error = called.errors;
  if (!called.document.at("solved").get<bool>()) return result;
  result.error = validate(called.document, known, instance, paths);
  result.solved = result.error.empty();
  result.cost = number(called.document, "cost").value_or(0.0);
  return result;
}

PlannerRunResult run_peer(const Bench& bench, const Peer& peer, const Instance& instance) {
  const fs::path paths = bench.scratch / "peer.csv";
  fs::remove(paths);
  const std::string command = "MAP=" + quoted(instance.map.string()) + " SCEN=" + quoted(instance.tasks.string()) +
                              " AGENTS=" + std::to_string(instance.agents) +
                              " TIME_LIMIT=" + std::to_string(bench.time_limit_s) + " PATHS=" + quoted(paths.string()) +
                              " sh -c " + quoted(peer.command) + " >" + quoted((bench.scratch / "stdout").string()) +
                              " 2>&1";
  const double cpu_before_s = cpu_of_children_s();
  const auto begin = std::chrono::steady_clock::now();
  const int status = std::system(command.c_str());
  PlannerRunResult result;
  result.planning_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  result.cpu_s = cpu_of_children_s() - cpu_before_s;
  result.robots = instance.agents;
  if (WIFSIGNALED(status)) throw std::runtime_error("interrupted");
  if (!fs::exists(paths)) return result;
  const test::PathVerdict verdict =
      test::check_paths(instance.map.string(), instance.tasks.string(), instance.agents, 4, paths.string());
  result.error = !verdict.error.empty() ? verdict.error : verdict.first_conflict;
  result.solved = result.error.empty();
  result.cost = verdict.cost();
  return result;
}

}  // namespace dmrp::bench
