// SPDX-License-Identifier: MIT
#include "host/run/run_results.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <nlohmann/json.hpp>
#include <string>

#include "host/errors/machine_error.hpp"
#include "host/files/atomic_file.hpp"
#include "host/files/read_file.hpp"
#include "host/findings/conditions.hpp"
#include "host/ranking/answer.hpp"
#include "host/ranking/answer_text.hpp"
#include "host/ranking/best_marks.hpp"
#include "host/ranking/bounds.hpp"
#include "host/ranking/failure_causes.hpp"
#include "host/ranking/graded_series.hpp"
#include "host/report/write_report.hpp"
#include "host/results/manifest.hpp"
#include "host/results/trials_csv.hpp"
#include "host/terminal/closing_line.hpp"
#include "host/terminal/colors.hpp"
#include "host/terminal/display_width.hpp"
#include "host/terminal/progress.hpp"
#include "host/terminal/summary_table.hpp"
#include "host/terminal/wrapped_text.hpp"

namespace dmrp::host {

namespace fs = std::filesystem;

RunResults read_results(ResultsDatabase database, const SummaryLayout& layout, const fs::path& directory) {
  database.finish();
  RunResults results{database.metrics(), database.trials_with_events_of(layout.arrived), {}, {}};
  results.summaries = summarise(results.metrics, results.trials, kinds_of(layout));
  results.summarised = results.metrics;
  const fs::path effective = directory / "effective.toml";
  add_places(bounds_of(read_file(effective, effective.string())), layout, results.trials, results.summarised,
             results.summaries);
  return results;
}

void write_tables(const RunResults& results, const fs::path& directory) {
  write_file_atomically(directory / "trials.csv", trials_csv(results.metrics, results.trials));
  write_file_atomically(directory / "summary.csv", summary_csv(results.summarised, results.summaries));
}

bool try_to_report(const RunResults& results, const fs::path& directory) {
  if (results.trials.empty()) return false;
  try {
    write_report(directory);
    return true;
  } catch (const std::exception& error) {
    if (is_machine_failure(error)) throw;
    fmt::print(stderr, "warning: no report.html: {}\n", error.what());
    return false;
  }
}

namespace {

// The thresholds of tests with levels, in lines for the terminal. A block for each series: its levels from hard to
// easy, then a line for each combination with its threshold and its success at every level.
std::string graded_table(std::span<const GradedSeries> all) {
  if (all.empty()) return "";
  std::size_t name_width = 0;
  std::size_t words_width = 0;
  for (const GradedSeries& series : all)
    for (const GradedResult& result : series.results) {
      name_width = std::max(name_width, display_width(combination_name(all, result)));
      words_width = std::max(words_width, display_width(threshold_words(series, result.estimate)));
    }
  std::string out;
  for (const GradedSeries& series : all) {
    out += fmt::format("  {} · {}{}\n", series.title, series.quantity, series.unit == "1" ? "" : ", " + series.unit);
    out += fmt::format("    {}  {}", pad_right("", name_width), pad_right("passes half", words_width));
    for (const double level : series.levels) out += fmt::format("  {:>5}", fmt::format("{:.3g}", level));
    out += "\n";
    for (const GradedResult& result : series.results) {
      out += fmt::format("    {}  {}", pad_right(combination_name(all, result), name_width),
                         pad_right(threshold_words(series, result.estimate), words_width));
      for (const double mean : result.means)
        out += fmt::format("  {:>5}", std::isnan(mean) ? "–" : fmt::format("{:.2f}", mean));
      out += "\n";
    }
    out += "\n";
  }
  return out;
}

// Which combination is better, in sentences (answer_text.hpp) that are indented and wrapped at `width` columns (0: not
// wrapped): what stands above the table, and what explains it below.
struct AnswerBlocks {
  std::string first;
  std::string rest;
};
AnswerBlocks answer_blocks(const Answer& answer, std::span<const CombinationFailures> failures, std::size_t width) {
  const std::vector<std::string> lines = answer_lines(answer, failures);
  AnswerBlocks blocks{wrapped_text(answer_heading(answer) + ". " + lines.front(), width, "  ") + "\n", ""};
  for (std::size_t i = 1; i < lines.size(); ++i) blocks.rest += wrapped_text(lines[i], width, "  ");
  if (!blocks.rest.empty()) blocks.rest += "\n";
  return blocks;
}

// Says what the combination with the fewest observations has met, if that is too little.
std::string caution_about_few(std::span<const CombinationSummary> summaries) {
  std::size_t least = fewest_observations;
  std::string words;
  std::uint32_t robots = 0;
  for (const CombinationSummary& summary : summaries) {
    MetricSummary most;
    for (const MetricSummary& metric : summary.metrics)
      if (metric.n > most.n) most = metric;
    if (most.n >= least) continue;
    least = most.n;
    robots = summary.combination.robots;
    const bool has_each_once = most.n == summary.trials || most.n == 0;
    words = !has_each_once        ? met_words(most.met)
            : summary.trials == 1 ? "one trial"
                                  : fmt::format("{} trials", summary.trials);
  }
  const std::string tasks =
      robots > 0 ? fmt::format("[[scenario]] robots = {}, tasks = {{ drawn = 40 }} and ", robots) : "";
  return words.empty() ? "" : fmt::format("caution: {}. For a comparison: {}[experiment] trials = 40", words, tasks);
}

}  // namespace

void print_results(const RunResults& results, const SummaryLayout& own_layout, const fs::path& directory, bool reported,
                   std::span<const ScenarioFacts> scenarios) {
  const SummaryLayout layout = with_added_columns(own_layout, results.summarised);
  const std::vector<GradedSeries> graded = graded_series(layout, scenarios, results.trials);
  const bool all_graded = !graded.empty() && std::all_of(scenarios.begin(), scenarios.end(),
                                                         [](const auto& facts) { return !facts.series.empty(); });
  constexpr std::size_t text_width = 120;  // of sentences where no terminal limits them
  TableStyle style;
  style.width = terminal_width();
  style.ansi = has_colors(STDOUT_FILENO);
  const auto marks = best_marks(layout, results.metrics, results.trials, Contestants::planners_and_controllers);
  const std::size_t width = style.width > 0 ? style.width : text_width;
  const std::vector<CombinationFailures> failures = failure_causes(layout, results.trials);
  AnswerBlocks answer;
  if (const auto found = answers(layout, results.metrics, results.trials); !found.empty() && !all_graded)
    answer = answer_blocks(found.front(), failures, width);
  if (!all_graded) {
    fmt::print("\n{}{}", answer.first, summary_table(layout, results.summarised, results.summaries, marks, style));
    fmt::print("{}", table_legend(layout, results.summarised, results.summaries, met_by_all(results.trials), marks,
                                  {width, style.ansi}));
  }
  fmt::print("{}\n", wrapped_text("conditions: " + conditions_of_run(directory), width, "  "));
  if (const std::string drawn = drawn_tasks_line(scenarios); !drawn.empty())
    fmt::print("{}\n", wrapped_text(drawn, width, "  "));
  fmt::print("{}{}", all_graded ? "\n" : "", graded_table(graded));
  if (const std::string caution = caution_about_few(results.summaries); !caution.empty())
    fmt::print("  {}\n\n", colored(caution, TextColor::yellow, style.ansi));
  fmt::print("{}", answer.rest);
  const std::string growth = growth_line(read_manifest(directory / "manifest.json").experiment);
  if (!growth.empty()) fmt::print("  {}\n\n", growth);
  fmt::print("  {}\n", closing_line(layout, results.trials));
  if (const std::string by_type = arrivals_line(layout.arrived, scenarios, results.trials); !by_type.empty())
    fmt::print("  {}\n", by_type);
  for (const std::string& line : {failures_line(failures), standstills_line(layout, results.trials)})
    if (!line.empty()) fmt::print("  {}\n", line);
  std::vector<std::string> files = {"results.sqlite"};
  if (reported) files.insert(files.begin(), "report.html");
  if (std::error_code ignored; fs::is_directory(directory / "traces", ignored)) files.push_back("traces/");
  fmt::print("  {}\n", files_line(directory, files));
}

void print_results_as_json(const RunResults& results, const SummaryLayout& layout, const fs::path& directory) {
  using Json = nlohmann::ordered_json;
  Json json = {{"run_directory", fs::absolute(directory).string()}};
  for (const char* outcome : {trial_outcome::succeeded, trial_outcome::failed, trial_outcome::fault,
                              trial_outcome::skipped, trial_outcome::unsupported})
    json["trials"][outcome] = std::count_if(results.trials.begin(), results.trials.end(),
                                            [&](const TrialRecord& trial) { return trial.outcome == outcome; });
  json["answer"] = Json::array();
  if (const auto found = answers(layout, results.metrics, results.trials); !found.empty())
    json["answer"] = answer_lines(found.front(), failure_causes(layout, results.trials));
  json["combinations"] = Json::array();
  for (const CombinationSummary& summary : results.summaries) {
    const CombinationLabels& labels = summary.combination;
    Json& one = json["combinations"].emplace_back(Json{{"scenario", labels.scenario},
                                                       {"robots", labels.robots},
                                                       {"global_planner", labels.global_planner},
                                                       {"local_controller", labels.local_controller},
                                                       {"pedestrian_model", labels.pedestrian_model},
                                                       {"trials", summary.trials}});
    for (std::size_t i = 0; i < results.summarised.size(); ++i)
      one["metrics"][results.summarised[i].name] = {
          {"unit", results.summarised[i].unit},      {"tasks", summary.metrics[i].met.tasks},
          {"crowds", summary.metrics[i].met.crowds}, {"n", summary.metrics[i].n},
          {"defined", summary.metrics[i].defined},   {"mean", summary.metrics[i].mean},
          {"low", summary.metrics[i].interval.low},  {"high", summary.metrics[i].interval.high}};
  }
  fmt::print("{}\n", json.dump(2, ' ', false, Json::error_handler_t::replace));
}

}  // namespace dmrp::host
