// SPDX-License-Identifier: MIT
// Results for papers and for other programs: LaTeX tables, CSV, a table or a map as a figure.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "core/picture/trial_picture.hpp"
#include "core/trace/trace_reader.hpp"
#include "host/commands/command.hpp"
#include "host/commands/command_output.hpp"
#include "host/commands/figure_file.hpp"
#include "host/commands/trial_trace.hpp"
#include "host/errors/input_error.hpp"
#include "host/export/mean_table.hpp"
#include "host/export/table_figure.hpp"
#include "host/export/thresholds_table.hpp"
#include "host/export/trial_filter.hpp"
#include "host/export/trials_table.hpp"
#include "host/program/executable.hpp"
#include "host/report/data/report_data.hpp"
#include "host/toml/nearest_name.hpp"

namespace dmrp::host {

namespace {

enum class ExportFormat { latex, csv, table, thresholds, map };
constexpr const char* own_table = "own";

struct ExportOptions {
  std::filesystem::path run_directory;
  ExportFormat format = ExportFormat::latex;
  std::vector<std::string> rows;     // labels; empty with the others: the tables of the report
  std::vector<std::string> columns;  // labels
  std::vector<std::string> metrics;
  std::string table;               // table: one of the report's, or own_table, of rows, columns and metrics
  std::vector<std::string> where;  // only trials that agree with these
  std::uint64_t trial = 0;         // map: the trial
  std::filesystem::path out;       // empty: standard output; figures also to a .png or .pdf
};

SummaryTableColumn parse_column(const nlohmann::json& json) {
  SummaryTableColumn column;
  column.metric = json.at("metric");
  column.header = json.value("header", column.metric);
  column.decimals = json.value("decimals", 2u);
  column.spread = json.value("spread", "");
  column.median = json.value("median", false);
  return column;
}

bool several_models(std::span<const TrialRecord> trials) {
  return std::any_of(trials.begin(), trials.end(), [&](const TrialRecord& trial) {
    return trial.robots > 0 && trial.pedestrian_model != trials.back().pedestrian_model;
  });
}

// The tables of the report's layout (host/layouts/report.json). Rows stand below their scenario, except in tables that
// have scenarios across. People are named only if there are several pedestrian models.
std::vector<TableSpec> layout_tables(const std::string& report_layout_json, std::span<const TrialRecord> trials) {
  std::vector<TableSpec> specs;
  const nlohmann::json layout = nlohmann::json::parse(report_layout_json);
  for (const nlohmann::json& table : layout.value("tables", nlohmann::json::array())) {
    TableSpec spec{table.at("id"), table.at("title"), {}, {}, {}};
    std::vector<Label>& places = table.contains("across") ? spec.columns : spec.rows;
    places = {Label::scenario, Label::robots};
    for (const std::string row : table.at("rows"))
      if (const auto label = label_named(row); label && (label != Label::pedestrian_model || several_models(trials)))
        spec.rows.push_back(*label);
    for (const nlohmann::json& column : table.at("columns")) spec.metrics.push_back(parse_column(column));
    specs.push_back(std::move(spec));
  }
  return specs;
}

// How the layout writes a metric: header, decimals, spread; its name and two decimals if it does not.
SummaryTableColumn column_of(const std::string& report_layout_json, const std::string& metric) {
  const nlohmann::json layout = nlohmann::json::parse(report_layout_json);
  for (const nlohmann::json& table : layout.value("tables", nlohmann::json::array()))
    for (const nlohmann::json& column : table.at("columns"))
      if (column.at("metric") == metric) return parse_column(column);
  SummaryTableColumn column;
  column.metric = metric;
  column.header = metric;
  std::replace(column.header.begin(), column.header.end(), '_', ' ');
  return column;
}

std::vector<Label> labels_of(const char* option, const std::vector<std::string>& names) {
  std::vector<Label> labels;
  for (const std::string& name : names) {
    const auto label = label_named(name);
    if (!label) throw InputError(fmt::format("{}: '{}' is none of {}", option, name, label_names));
    labels.push_back(*label);
  }
  return labels;
}

void check_metrics(const std::vector<std::string>& chosen, std::span<const MetricColumn> metrics) {
  std::vector<std::string> known;
  for (const MetricColumn& metric : metrics) known.push_back(metric.name);
  for (const std::string& name : chosen)
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw InputError(fmt::format("--metric: '{}' was not measured{}", name, did_you_mean(name, known)));
}

TableSpec spec_of(const ExportOptions& options, const ReportRun& run, const std::string& layout) {
  TableSpec spec{"results", "Results", labels_of("--rows", options.rows), labels_of("--columns", options.columns), {}};
  if (spec.rows.empty()) spec.rows = {Label::global_planner, Label::local_controller};
  std::vector<std::string> metrics = options.metrics;
  if (metrics.empty()) metrics = {"success"};
  for (const std::string& metric : metrics) spec.metrics.push_back(column_of(layout, metric));
  spec.people = people_counts(run.manifest.experiment.scenarios);
  return spec;
}

std::string latex(const ExportOptions& options, const ReportRun& run, const ReportLayouts& layouts) {
  const bool own = !options.rows.empty() || !options.columns.empty() || !options.metrics.empty();
  std::vector<TableSpec> specs =
      own ? std::vector{spec_of(options, run, layouts.report.json)} : layout_tables(layouts.report.json, run.trials);
  std::string text = "% dmrp-host export --latex. Needs \\usepackage{booktabs}.\n";
  for (TableSpec& spec : specs) {
    spec.conditions = run.conditions;
    for (const MeanTable& part : latex_parts(make_mean_table(spec, layouts.summary, run.metrics, run.trials)))
      text += latex_table(part) + "\n";
  }
  return text;
}

TableSpec chosen_table(const ExportOptions& options, const ReportRun& run, const ReportLayouts& layouts) {
  if (options.table == own_table) return spec_of(options, run, layouts.report.json);
  std::vector<std::string> known = {own_table};
  for (TableSpec& spec : layout_tables(layouts.report.json, run.trials)) {
    if (spec.id == options.table) return std::move(spec);
    known.push_back(spec.id);
  }
  throw InputError(fmt::format("--table: '{}' is none of {}{}", options.table, fmt::join(known, ", "),
                               did_you_mean(options.table, known)));
}

std::string table_svg(const ExportOptions& options, const ReportRun& run, const ReportLayouts& layouts) {
  const MeanTable table =
      make_mean_table(chosen_table(options, run, layouts), layouts.summary, run.metrics, run.trials);
  if (table.rows.empty() || table.spec.metrics.empty())
    throw InputError(fmt::format("--table {}: {} has no values for it", options.table, options.run_directory.string()));
  return table_figure(table);
}

std::string thresholds(const ExportOptions& options, const ReportRun& run, const ReportLayouts& layouts) {
  const auto series = graded_series(layouts.summary, run.manifest.experiment.scenarios, run.trials);
  if (series.empty()) throw InputError(options.run_directory.string() + ": no scenario of this run has levels");
  return thresholds_table_csv(series);
}

std::vector<MetricColumn> chosen_metrics(const ExportOptions& options, std::span<const MetricColumn> metrics) {
  std::vector<MetricColumn> chosen;
  for (const MetricColumn& metric : metrics)
    if (options.metrics.empty() ||
        std::find(options.metrics.begin(), options.metrics.end(), metric.name) != options.metrics.end())
      chosen.push_back(metric);
  return chosen;
}

std::string map_of(const ExportOptions& options) {
  const core::PictureFormat format = picture_format("--out", options.out);
  const TrialTrace found = trace_of(options.run_directory, "--map", options.trial);
  core::TraceReader trace(core::TraceRecords(found.file), core::TraceExtent::samples);
  core::TrialMap map(trace.world());
  while (const dmrp_sample* sample = trace.next_sample()) map.observe(*sample);
  return map.document(format, found.title);
}

int export_command(const ExportOptions& options) {
  check_output_file("--out", options.out);
  if (options.format == ExportFormat::map) {
    write_output("--out", options.out, map_of(options));
    return exit_status::done;
  }
  ReportRun run = read_report_run(options.run_directory);
  const RunSettings settings(run.effective_toml, run.trials, people_counts(run.manifest.experiment.scenarios));
  if (!options.where.empty()) run.trials = trials_where(options.where, run.trials, settings);
  const ReportLayouts layouts = read_report_layouts(shared_data_path() / "layouts");
  check_metrics(options.metrics, run.metrics);
  std::string text;
  if (options.format == ExportFormat::latex) {
    text = latex(options, run, layouts);
  } else if (options.format == ExportFormat::thresholds) {
    text = thresholds(options, run, layouts);
  } else if (options.format == ExportFormat::table) {
    text = table_svg(options, run, layouts);
  } else {
    text = trials_table_csv(chosen_metrics(options, run.metrics), run.trials, settings);
  }
  if (options.format == ExportFormat::table)
    write_figure("--out", options.out, text);
  else
    write_output("--out", options.out, text);
  return exit_status::done;
}

}  // namespace

void add_export(CLI::App& app) {
  const auto options = std::make_shared<ExportOptions>();
  CLI::App* command = app.add_subcommand("export", "write results for papers and other programs");
  command->add_option("run", options->run_directory, "run directory")->required()->type_name("RUN_DIR");
  CLI::Option_group* formats = command->add_option_group("format");
  const auto format = [&](const char* name, ExportFormat value, const char* about) {
    return formats->add_flag_callback(
        name, [options, value] { options->format = value; }, about);
  };
  format("--latex", ExportFormat::latex, "tables with booktabs: those of the report, or one of --rows and --columns");
  format("--csv", ExportFormat::csv, "one line a trial, with a column for each parameter, setting and metric");
  format("--thresholds", ExportFormat::thresholds, "the levels that are passed half of the time, as CSV");
  CLI::Option* map =
      formats
          ->add_option_function<std::uint64_t>(
              "--map",
              [options](const std::uint64_t& trial) {
                options->format = ExportFormat::map;
                options->trial = trial;
              },
              "the map of this trial with the robots' plans and ways: SVG, or PNG or PDF by the ending of --out")
          ->type_name("TRIAL");
  formats
      ->add_option_function<std::string>(
          "--table",
          [options](const std::string& name) {
            options->format = ExportFormat::table;
            options->table = name;
          },
          "a table of the report as an SVG figure: plans, driving, ...; own: one of --rows and --columns")
      ->type_name("NAME");
  formats->require_option(1);
  command->add_option("--rows", options->rows, "scenario, robots, people, planner, controller, pedestrian_model")
      ->delimiter(',');
  command->add_option("--columns", options->columns, "the same, across")->delimiter(',');
  command
      ->add_option("--where", options->where,
                   "only trials with this value in a column of --csv; of one column: any, of several: all")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false)
      ->excludes(map);
  command->add_option("--metric", options->metrics, "only these metrics")->delimiter(',')->type_name("NAME");
  command
      ->add_option("--out", options->out,
                   "output file (default: standard output); figures also as .pdf and .png, tables by rsvg-convert")
      ->type_name("FILE");
  finish_command(command, "dmrp-host export runs/quickstart --latex --out tables.tex",
                 [options] { return export_command(*options); });
}

}  // namespace dmrp::host
