// SPDX-License-Identifier: MIT
#include <dmrp/abi.h>
#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>

#include "host/check/check_library.hpp"
#include "host/commands/command.hpp"
#include "host/commands/command_output.hpp"
#include "host/plugins/library.hpp"
#include "host/program/version.hpp"

namespace dmrp::host {

namespace {

struct CheckOptions {
  std::string library;
  std::string only;  // a regular expression; empty: all cases
  std::uint64_t seed = 1;
  bool json = false;
};

std::string counts_text(const CheckCounts& counts) {
  std::string out;
  for (const CheckResult result :
       {CheckResult::pass, CheckResult::warn, CheckResult::fail, CheckResult::crash, CheckResult::skip})
    out +=
        fmt::format("{}{} {}", out.empty() ? "" : ", ", counts[static_cast<std::size_t>(result)], result_name(result));
  return out;
}

// Findings in full, skipped cases by reason; of cases that passed, what they have measured.
class TextReport {
 public:
  void add(const CheckedCase& checked) {
    if (plugin_ != checked.plugin) finish_subject();
    plugin_ = checked.plugin;
    if (plugin_) info_ = *plugin_;
    const CaseOutcome& outcome = checked.outcome;
    if (outcome.result == CheckResult::pass && outcome.detail.empty()) return;
    if (outcome.result == CheckResult::skip) return skipped_[outcome.detail].push_back(checked.check_case->name);
    print_heading();
    fmt::print("  {:<6}{}: {}\n", result_name(outcome.result), checked.check_case->name, outcome.detail);
    if (outcome.result == CheckResult::pass) return;
    fmt::print("        rule: {}\n        mend: {}\n", checked.check_case->rule, checked.check_case->mend);
    if (!outcome.printed.empty()) fmt::print("        it printed: {}\n", outcome.printed);
  }

  void finish_subject() {
    for (const auto& [reason, names] : skipped_) {
      print_heading();
      fmt::print("  {:<6}{}: {}\n", "skip", fmt::join(names, ", "), reason);
    }
    if (plugin_) print_heading(), fmt::print("  not driven: {}\n", fmt::join(not_driven(info_), "; "));
    skipped_.clear();
    has_heading_ = false;
  }

 private:
  void print_heading() {
    if (!has_heading_) fmt::print("{}\n", plugin_ ? info_.id : "library");
    has_heading_ = true;
  }

  const PluginInfo* plugin_ = nullptr;  // whose cases they are; nullptr: the library's
  PluginInfo info_;                     // its copy, which is there at the end too
  bool has_heading_ = false;
  std::map<std::string, std::vector<std::string>> skipped_;  // names of cases by reason
};

nlohmann::ordered_json to_json(const CheckedCase& checked) {
  nlohmann::ordered_json json;
  json["plugin"] = checked.plugin ? checked.plugin->id : "";
  json["case"] = checked.check_case->name;
  json["result"] = result_name(checked.outcome.result);
  json["detail"] = checked.outcome.detail;
  json["rule"] = checked.check_case->rule;
  json["mend"] = checked.check_case->mend;
  json["printed"] = checked.outcome.printed;
  return json;
}

int check_command(const CheckOptions& options) {
  const CheckChoice choice = {library_to_open(options.library), options.only, options.seed};
  nlohmann::ordered_json cases = nlohmann::ordered_json::array();
  TextReport text;
  const CheckCounts counts = check_library(choice, [&](const CheckedCase& checked) {
    if (options.json)
      cases.push_back(to_json(checked));
    else
      text.add(checked);
  });
  if (options.json) {
    nlohmann::ordered_json json;
    json["library"] = choice.file.string();
    json["host"] = version;
    json["seed"] = options.seed;
    for (const CheckResult result :
         {CheckResult::pass, CheckResult::warn, CheckResult::fail, CheckResult::crash, CheckResult::skip})
      json["counts"][result_name(result)] = counts[static_cast<std::size_t>(result)];
    json["cases"] = std::move(cases);
    fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
  } else {
    text.finish_subject();
    fmt::print("{}: {}\n", options.library, counts_text(counts));
  }
  const bool found = counts[static_cast<std::size_t>(CheckResult::fail)] > 0 ||
                     counts[static_cast<std::size_t>(CheckResult::crash)] > 0;
  return found ? exit_status::findings : exit_status::done;
}

}  // namespace

void add_check(CLI::App& app) {
  const auto options = std::make_shared<CheckOptions>();
  CLI::App* command = app.add_subcommand("check", "test a plugin library against its contract");
  command->add_option("library", options->library, "plugin library")->required()->type_name("LIB.so");
  command->add_option("--only", options->only, "only cases whose \"ID GROUP/CASE\" matches this regular expression")
      ->type_name("REGEX");
  command->add_option("--seed", options->seed, "seed of all trials")->type_name("N")->capture_default_str();
  command->add_flag("--json", options->json, "print JSON: all cases, also those that passed");
  finish_command(command, "dmrp-host check ./libmine.so", [options] { return check_command(*options); });
}

}  // namespace dmrp::host
