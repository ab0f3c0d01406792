// SPDX-License-Identifier: MIT
// Runs before and after a change: paired differences, for people and for CI.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/commands/command.hpp"
#include "host/commands/command_output.hpp"
#include "host/compare/comparison_data.hpp"
#include "host/compare/reference_run.hpp"
#include "host/compare/run_comparison.hpp"
#include "host/errors/input_error.hpp"
#include "host/program/executable.hpp"
#include "host/report/report_page.hpp"
#include "host/terminal/display_width.hpp"
#include "host/toml/nearest_name.hpp"

namespace dmrp::host {
namespace {

namespace fs = std::filesystem;

struct CompareOptions {
  std::vector<fs::path> runs;        // at least two; each is compared with the first
  std::vector<std::string> metrics;  // empty: those that the report compares
  std::vector<std::string> fail_if;  // "success < -0.02"
  fs::path report;                   // empty: no page is written
  bool json = false;                 // the page's data instead of tables
};

// What is compared: the metrics that the report compares, those of its answer, and those of conditions.
std::vector<std::string> metrics_of(const CompareOptions& options, const ReportLayouts& layouts,
                                    std::span<const FailCondition> conditions) {
  std::vector<std::string> names = options.metrics;
  if (names.empty()) {
    names = layouts.summary.answer.shares;
    for (const ComparedMetric& compared : layouts.report.comparisons) names.push_back(compared.metric);
  }
  for (const FailCondition& condition : conditions) names.push_back(condition.metric);
  std::vector<std::string> distinct;
  for (const std::string& name : names)
    if (std::find(distinct.begin(), distinct.end(), name) == distinct.end()) distinct.push_back(name);
  return distinct;
}

void check_measured(const CompareOptions& options, std::span<const FailCondition> conditions, const ReportRun& run,
                    const fs::path& directory) {
  std::vector<std::string> known;
  for (const MetricColumn& metric : run.metrics) known.push_back(metric.name);
  const auto check = [&](const char* option, const std::string& name) {
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw InputError(fmt::format("{}: '{}' was not measured in {}{}", option, name, directory.string(),
                                   did_you_mean(name, known)));
  };
  for (const std::string& metric : options.metrics) check("--metric", metric);
  for (const FailCondition& condition : conditions) check("--fail-if", condition.metric);
}

std::string p_words(const PairedDifference& difference) {
  const double p = difference.p_holm;
  return difference.equal ? "=" : std::isnan(p) ? "–" : p < 0.001 ? "< 0.001" : fmt::format("{:.3f}", p);
}

int decimals_of(const MetricComparison& one) {
  const double largest = std::max(std::fabs(one.before), std::fabs(one.after));
  return largest >= 100.0 ? 1 : largest >= 10.0 ? 2 : 3;
}

// With its sign; zero has none.
std::string change_words(double value, int decimals) {
  const std::string text = fmt::format("{:+.{}f}", value, decimals);
  return text.find_first_not_of("+-0.") == std::string::npos ? text.substr(1) : text;
}

void print_row(const MetricComparison& one, std::size_t name_width) {
  const std::string name = one.unit.empty() || one.unit == "1" ? one.metric : one.metric + " " + one.unit;
  if (one.pairs == 0) {
    fmt::print("  {}  {:>6}\n", pad_right(name, name_width), 0);
    return;
  }
  const int decimals = decimals_of(one);
  const core::MeanOfTasks& over_tasks = one.difference.over_tasks;
  std::string difference = change_words(over_tasks.mean, decimals);
  if (!std::isnan(over_tasks.interval.low))
    difference += fmt::format(" [{}, {}]", change_words(over_tasks.interval.low, decimals),
                              change_words(over_tasks.interval.high, decimals));
  fmt::print("  {}  {:>6}  {:>5}  {:>9.{}f}  {:>9.{}f}  {:>28}  {:>8}\n", pad_right(name, name_width), one.pairs,
             over_tasks.n, one.before, decimals, one.after, decimals, difference, p_words(one.difference));
}

void print_comparison(const RunComparison& comparison, const fs::path& before, const fs::path& after) {
  fmt::print("before  {}\nafter   {}\n", before.string(), after.string());
  for (const std::string& change : comparison.changes) fmt::print("        {}\n", change);
  fmt::print("{} in both", plural(comparison.pairs, "trial"));
  if (comparison.only_before + comparison.only_after > 0)
    fmt::print(", {} only before, {} only after", comparison.only_before, comparison.only_after);
  std::size_t name_width = 6;
  for (const MetricComparison& one : comparison.metrics)
    name_width = std::max(name_width, one.metric.size() + 1 + one.unit.size());
  fmt::print(": {}\n\n  {}  {:>6}  {:>5}  {:>9}  {:>9}  {:>28}  {:>8}\n", met_words(comparison.met),
             pad_right("metric", name_width), "pairs", "n", "before", "after", "difference, 95 % interval", "p (Holm)");
  for (const MetricComparison& one : comparison.metrics) print_row(one, name_width);
  fmt::print("  n: {}s, with all their trials in both runs\n\n", observation_name(comparison.met));
}

// Prints what became of the conditions, and returns the exit status.
int judge_conditions(const RunComparison& comparison, std::span<const FailCondition> conditions) {
  static constexpr const char* words[] = {"no", "YES", "the trials cannot decide"};  // by Verdict
  int status = exit_status::done;
  for (const FailCondition& condition : conditions) {
    const auto metric = std::find_if(comparison.metrics.begin(), comparison.metrics.end(),
                                     [&](const auto& one) { return one.metric == condition.metric; });
    const Verdict verdict = judge(condition, *metric);
    fmt::print("  {} {} {:g}: {}\n", condition.metric, condition.below ? "<" : ">", condition.limit,
               words[static_cast<std::size_t>(verdict)]);
    if (verdict == Verdict::fails) status = exit_status::worse;
    if (verdict == Verdict::undecided && status == exit_status::done) status = exit_status::undecided;
  }
  return status;
}

int compare_command(const CompareOptions& options) {
  check_output_file("--report", options.report);
  std::vector<FailCondition> conditions;
  for (const std::string& text : options.fail_if) conditions.push_back(parse_fail_condition(text));
  const ReportLayouts layouts = read_report_layouts(shared_data_path() / "layouts");
  const fs::path& first = options.runs.front();
  const ReportRun before = is_reference_run(first) ? read_reference_run(first, read_report_run(options.runs[1]).metrics)
                                                   : read_report_run(first);
  check_measured(options, conditions, before, options.runs.front());
  const std::vector<std::string> metrics = metrics_of(options, layouts, conditions);
  ComparedRuns compared{{options.runs.front().string(), before}, {}};
  int status = exit_status::done;
  for (std::size_t i = 1; i < options.runs.size(); ++i) {
    ReportRun after = read_report_run(options.runs[i]);
    check_measured(options, conditions, after, options.runs[i]);
    RunComparison comparison = compare_runs(before, after, layouts, metrics);
    if (comparison.pairs == 0)
      throw InputError(fmt::format("{}: no trial has scenario, robots, seed and labels of one in {}",
                                   options.runs[i].string(), options.runs.front().string()));
    if (!options.json) print_comparison(comparison, options.runs.front(), options.runs[i]);
    const int of_run = judge_conditions(comparison, conditions);
    if (of_run == exit_status::worse || status == exit_status::done) status = of_run;
    after.trials.clear();  // one run is in memory at a time
    compared.others.push_back({{options.runs[i].string(), std::move(after)}, std::move(comparison)});
  }
  const std::string data = comparison_data_json(compared, layouts);
  if (options.json) fmt::print("{}\n", data);
  if (!options.report.empty())
    write_output("--report", options.report, report_page(shared_data_path() / "report", "compare", data, {}));
  return status;
}

}  // namespace

void add_compare(CLI::App& app) {
  const auto options = std::make_shared<CompareOptions>();
  CLI::App* command = app.add_subcommand("compare", "compare runs of the same trials, each with the first");
  command
      ->add_option("runs", options->runs,
                   "run directories: before and after a change; the first may have trials.csv and manifest.json alone")
      ->required()
      ->expected(2, 1000)
      ->type_name("RUN_DIR");
  command->add_option("--metric", options->metrics, "metrics (default: those that the report compares)")
      ->delimiter(',')
      ->type_name("NAME");
  CLI::Option* fail_if =
      command
          ->add_option(
              "--fail-if", options->fail_if,
              "exit with 1 if the interval of the metric's difference lies beyond this, with 4 if the trials cannot "
              "decide")
          ->allow_extra_args(false)
          ->type_name("\"METRIC < X\"");
  command->add_flag("--json", options->json, "print one JSON object: means, differences and p of each metric")
      ->excludes(fail_if);
  command->add_option("--report", options->report, "write the comparison as a page, by combination, too")
      ->type_name("FILE.html");
  finish_command(command, "dmrp-host compare runs/before runs/after --fail-if \"success < -0.02\"",
                 [options] { return compare_command(*options); });
}

}  // namespace dmrp::host
