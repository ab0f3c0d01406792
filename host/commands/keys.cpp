// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "host/commands/command.hpp"
#include "host/experiment/experiment_keys.hpp"
#include "host/files/read_file.hpp"
#include "host/program/executable.hpp"
#include "host/scenario/read_scenario.hpp"
#include "host/toml/nearest_name.hpp"

namespace dmrp::host {
namespace {

// What keys mean, by table and key; the table "any" for those that mean the same everywhere.
class Meanings {
 public:
  Meanings() {
    const std::filesystem::path file = shared_data_path() / "layouts/keys.json";
    tables_ = nlohmann::json::parse(read_file(file, file.string()));
  }

  std::string of(std::string table, const std::string& key) const {
    // robot types have the keys of [robot]
    if (table.starts_with(type_title)) table = "[robot" + table.substr(type_title.size());
    for (const std::string& title : {table, std::string("any")})
      if (const auto found = tables_.find(title); found != tables_.end() && found->contains(key))
        return found->at(key).get<std::string>();
    return "";
  }

 private:
  static constexpr std::string_view type_title = "[robot_type.NAME";
  nlohmann::json tables_;
};

// "  key = default   # meaning (range)", the meanings below one another.
int keys_command(const std::string& format) {
  const std::vector<std::string> known = {"experiment", "scenario"};
  if (std::find(known.begin(), known.end(), format) == known.end())
    throw InputError(fmt::format("dmrp-host keys: no format '{}'{}", format, among(format, known)));
  constexpr std::size_t most_width = 36;
  const Meanings meanings;
  for (const TomlKeys& table : format == "experiment" ? experiment_keys() : scenario_keys()) {
    fmt::print("{}\n", table.title);
    for (const TomlKey& key : table.keys) {
      const std::string line = key.name + (key.fallback.empty() ? "" : " = " + key.fallback);
      fmt::print("  {:<{}}  # {}{}\n", line, most_width, meanings.of(table.title, key.name),
                 key.range.empty() ? "" : " (" + key.range + ")");
    }
  }
  return exit_status::done;
}

}  // namespace

void add_keys(CLI::App& app) {
  const auto format = std::make_shared<std::string>();
  CLI::App* command =
      app.add_subcommand("keys", "list the keys of experiment or scenario files, with defaults and meanings");
  command->add_option("format", *format, "experiment or scenario")->required()->type_name("FORMAT");
  finish_command(command, "dmrp-host keys experiment", [format] { return keys_command(*format); });
}

}  // namespace dmrp::host
