// SPDX-License-Identifier: MIT
#include "host/results/manifest.hpp"

#include <dmrp/abi.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <utility>

#include "host/files/sha256.hpp"

namespace dmrp::host {
namespace {

using Json = nlohmann::ordered_json;

std::string abi_name() {
  std::string name = std::to_string(DMRP_ABI_MAJOR) + "." + std::to_string(DMRP_ABI_MINOR);
  if (DMRP_ABI_DRAFT != 0) name += " draft " + std::to_string(DMRP_ABI_DRAFT);
  return name;
}

std::string utc_text(std::chrono::system_clock::time_point time) {
  const std::time_t seconds = std::chrono::system_clock::to_time_t(time);
  std::tm parts{};
  gmtime_r(&seconds, &parts);
  std::array<char, 32> text;
  const std::size_t length = std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts);
  return {text.data(), length};
}

Json to_json(const ExperimentFacts& experiment) {
  Json scenarios = Json::array();
  for (const ScenarioFacts& scenario : experiment.scenarios) {
    Json& json = scenarios.emplace_back(Json{{"name", scenario.name},
                                             {"title", scenario.title},
                                             {"description", scenario.description},
                                             {"robots", scenario.robots},
                                             {"people", scenario.people},
                                             {"time_limit_s", scenario.time_limit_s}});
    if (!scenario.world.empty() && scenario.world != scenario.name) json["world"] = scenario.world;
    if (scenario.tasks_drawn) json["tasks_drawn"] = true;
    if (!scenario.robot_types.empty()) json["robot_types"] = scenario.robot_types;
    if (scenario.series.empty()) continue;
    json["grade"] = {{"series", scenario.series},
                     {"quantity", scenario.quantity},
                     {"unit", scenario.unit},
                     {"harder_when_higher", scenario.harder_when_higher},
                     {"level", scenario.level}};
  }
  return {{"name", experiment.name},
          {"seed", experiment.seed},
          {"repetitions", experiment.repetitions},
          {"shard", {{"index", experiment.shard.index}, {"count", experiment.shard.count}}},
          {"trials_planned", experiment.trials_planned},
          {"grown_from", experiment.grown_from},
          {"scenarios", std::move(scenarios)}};
}

ExperimentFacts parse_experiment(const Json& json) {
  ExperimentFacts experiment;
  json.at("name").get_to(experiment.name);
  json.at("seed").get_to(experiment.seed);
  json.at("repetitions").get_to(experiment.repetitions);
  json.at("trials_planned").get_to(experiment.trials_planned);
  json.at("grown_from").get_to(experiment.grown_from);
  experiment.shard = {json.at("shard").at("index"), json.at("shard").at("count")};
  for (const Json& scenario : json.at("scenarios")) {
    ScenarioFacts& facts = experiment.scenarios.emplace_back();
    scenario.at("name").get_to(facts.name);
    scenario.at("title").get_to(facts.title);
    scenario.at("description").get_to(facts.description);
    scenario.at("robots").get_to(facts.robots);
    scenario.at("people").get_to(facts.people);
    scenario.at("time_limit_s").get_to(facts.time_limit_s);
    facts.robot_types = scenario.value("robot_types", facts.robot_types);
    facts.world = scenario.value("world", facts.world);
    facts.tasks_drawn = scenario.value("tasks_drawn", false);
    const auto grade = scenario.find("grade");
    if (grade == scenario.end()) continue;
    facts.series = grade->at("series");
    facts.quantity = grade->at("quantity");
    facts.unit = grade->at("unit");
    facts.harder_when_higher = grade->at("harder_when_higher");
    facts.level = grade->at("level");
  }
  return experiment;
}

Manifest parse_manifest(const Json& json) {
  Manifest manifest;
  json.at("dmrp_version").get_to(manifest.dmrp_version);
  json.at("abi").get_to(manifest.abi);
  json.at("command_line").get_to(manifest.command_line);
  json.at("started_at").get_to(manifest.started_at);
  json.at("commit").get_to(manifest.commit);
  json.at("identity").get_to(manifest.identity);
  json.at("digest").get_to(manifest.digest);
  manifest.protocol = json.value("protocol", "");
  manifest.experiment = parse_experiment(json.at("experiment"));
  const Json& limits = json.at("plugin_limits");
  manifest.plugin_limits = {limits.at("box"), limits.at("memory"), limits.at("plugins_with_processes")};
  manifest.left_out = json.value("left_out", manifest.left_out);
  const Json& machine = json.at("machine");
  machine.at("libc").get_to(manifest.machine.libc);
  machine.at("cpu_level").get_to(manifest.machine.cpu_level);
  machine.at("cpu_features").get_to(manifest.machine.cpu_features);
  machine.at("compiler").get_to(manifest.machine.compiler);
  for (const Json& file : json.at("files"))
    manifest.files.push_back({file.at("role"), file.at("path"), file.at("sha256"), file.value("code", "")});
  if (json.contains("not_repeatable"))
    for (const Json& some : json.at("not_repeatable"))
      manifest.not_repeatable.push_back({{some.at("plugin"), some.at("reason")}, some.at("trials")});
  return manifest;
}

void compare(std::vector<std::string>& found, const std::string& what, const std::string& before,
             const std::string& now) {
  if (before != now) found.push_back(what + ": " + before + ", now " + now);
}

std::vector<std::string> only_in(const std::vector<std::string>& some, const std::vector<std::string>& others) {
  std::vector<std::string> rest;
  std::set_difference(some.begin(), some.end(), others.begin(), others.end(), std::back_inserter(rest));
  return rest;
}

// Flags by which glibc may select code. The level covers most of them, but a machine can lack "fma" alone.
bool decides_on_code(const std::string& feature) {
  return feature == "fma" || feature == "fma4" || feature.rfind("avx", 0) == 0;
}

void compare_features(std::vector<std::string>& found, const Machine& before, const Machine& now) {
  for (const std::string& feature : only_in(before.cpu_features, now.cpu_features))
    if (decides_on_code(feature)) found.push_back("CPU feature " + feature + " is missing now");
  for (const std::string& feature : only_in(now.cpu_features, before.cpu_features))
    if (decides_on_code(feature)) found.push_back("CPU feature " + feature + " is new");
}

// Two libraries in different folders can have the same name.
std::map<std::string, std::set<std::string>> code_by_name(const Manifest& manifest) {
  std::map<std::string, std::set<std::string>> libraries;
  for (const HashedFile& file : manifest.files)
    if (file.role == "plugin library" || file.role == "plugin object")
      libraries[std::filesystem::path(file.path).filename()].insert(file.code.empty() ? file.sha256 : file.code);
  return libraries;
}

void compare_libraries(std::vector<std::string>& found, const Manifest& before, const Manifest& now) {
  auto was = code_by_name(before);
  auto is = code_by_name(now);
  for (const auto& [name, code] : was)
    if (is[name].empty())
      found.push_back("plugin library " + name + " is missing now");
    else if (is[name] != code)
      found.push_back("plugin library " + name + " has changed");
  for (const auto& [name, code] : is)
    if (was[name].empty()) found.push_back("plugin library " + name + " is new");
}

bool is_hash(std::string_view word) {
  return word.size() == 64 && word.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

// With 12 digits of each hash.
std::string shortened(const std::string& text) {
  std::string out;
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t end = std::min(text.find_first_of(" ,\"", at), text.size());
    const std::string word = text.substr(at, end - at);
    out += is_hash(word) ? word.substr(0, 12) : word;
    if (end < text.size()) out += text[end];
    at = end + 1;
  }
  return out;
}

}  // namespace

Manifest new_manifest(std::string dmrp_version, std::vector<std::string> command_line,
                      std::chrono::system_clock::time_point started_at) {
  Manifest manifest;
  manifest.dmrp_version = std::move(dmrp_version);
  manifest.abi = abi_name();
  manifest.command_line = std::move(command_line);
  manifest.started_at = utc_text(started_at);
  manifest.machine = this_machine();
  return manifest;
}

std::string growth_line(const ExperimentFacts& facts) {
  if (facts.grown_from.empty()) return "";
  return fmt::format("You added trials after seeing results ({}, then {}): treat p values as exploratory.",
                     fmt::join(facts.grown_from, ", then "), facts.repetitions);
}

std::string shard_text(const Shard& shard) {
  if (shard.count == 1) return "the whole experiment";
  return "shard " + std::to_string(shard.index) + "/" + std::to_string(shard.count);
}

HashedFile hashed_file(std::string role, const std::filesystem::path& path) {
  return {std::move(role), path.string(), sha256_of_file(path)};
}

std::string to_json_text(const Manifest& manifest) {
  Json json;
  json["dmrp_version"] = manifest.dmrp_version;
  json["commit"] = manifest.commit;
  json["abi"] = manifest.abi;
  json["command_line"] = manifest.command_line;
  json["started_at"] = manifest.started_at;
  json["experiment"] = to_json(manifest.experiment);
  const PluginLimits& limits = manifest.plugin_limits;
  json["plugin_limits"] = {
      {"box", limits.box}, {"memory", limits.memory}, {"plugins_with_processes", limits.with_processes}};
  json["machine"] = {{"libc", manifest.machine.libc},
                     {"cpu_level", manifest.machine.cpu_level},
                     {"cpu_features", manifest.machine.cpu_features},
                     {"compiler", manifest.machine.compiler}};
  if (!manifest.left_out.empty()) json["left_out"] = manifest.left_out;
  json["files"] = Json::array();
  for (const HashedFile& file : manifest.files) {
    Json& written = json["files"].emplace_back(Json{{"role", file.role}, {"path", file.path}, {"sha256", file.sha256}});
    if (!file.code.empty()) written["code"] = file.code;
  }
  json["digest"] = manifest.digest;
  json["protocol"] = manifest.protocol;
  json["identity"] = manifest.identity;
  for (const UnrepeatableTrials& some : manifest.not_repeatable)
    json["not_repeatable"].push_back(
        {{"plugin", some.reason.plugin}, {"reason", some.reason.text}, {"trials", some.trials}});
  // a path need not be UTF-8
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Manifest read_manifest(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(path.string() + ": cannot be read");
  try {
    return parse_manifest(Json::parse(file));
  } catch (const Json::exception& error) {
    throw std::runtime_error(path.string() + ": " + error.what());
  }
}

void count_unrepeatable(std::vector<UnrepeatableTrials>& counted, std::span<const TrialRecord> trials) {
  for (const TrialRecord& trial : trials)
    for (const TimingReason& reason : trial.timing) {
      auto known =
          std::find_if(counted.begin(), counted.end(), [&](const auto& some) { return some.reason == reason; });
      if (known == counted.end()) known = counted.insert(counted.end(), {reason, 0});
      ++known->trials;
    }
}

std::vector<std::string> differences(const Manifest& before, const Manifest& now) {
  std::vector<std::string> found;
  compare(found, "dmrp", before.dmrp_version, now.dmrp_version);
  if (!before.commit.empty() && !now.commit.empty()) compare(found, "commit", before.commit, now.commit);
  compare(found, "ABI", before.abi, now.abi);
  compare(found, "libc", before.machine.libc, now.machine.libc);
  compare(found, "CPU level", before.machine.cpu_level, now.machine.cpu_level);
  compare(found, "compiler", before.machine.compiler, now.machine.compiler);
  compare_features(found, before.machine, now.machine);
  compare_libraries(found, before, now);
  return found;
}

std::vector<KeyDifference> differences(const Identity& before, const Identity& now) {
  std::vector<KeyDifference> found;
  for (const auto& [key, value] : before)
    if (const auto other = now.find(key); other == now.end())
      found.push_back({key, shortened(value), "missing"});
    else if (other->second != value)
      found.push_back({key, shortened(value), shortened(other->second)});
  for (const auto& [key, value] : now)
    if (!before.contains(key)) found.push_back({key, "missing", shortened(value)});
  return found;
}

}  // namespace dmrp::host
