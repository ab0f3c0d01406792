// SPDX-License-Identifier: MIT
#include "host/results/database.hpp"

#include <dmrp/descriptor.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "host/errors/escaped_text.hpp"
#include "host/errors/machine_error.hpp"
#include "host/results/value_views.hpp"

namespace dmrp::host {
namespace {

constexpr std::int64_t schema_version = 6;

constexpr const char* schema = R"sql(
CREATE TABLE trial(
  id INTEGER PRIMARY KEY,
  scenario TEXT NOT NULL,
  robots INTEGER NOT NULL,
  global_planner TEXT NOT NULL,
  local_controller TEXT NOT NULL,
  pedestrian_model TEXT NOT NULL,
  repetition INTEGER NOT NULL,
  seed INTEGER NOT NULL,
  outcome TEXT NOT NULL CHECK (outcome IN ('succeeded', 'failed', 'fault', 'skipped')),
  repeatable INTEGER NOT NULL CHECK (repeatable IN (0, 1)),
  sim_time_s REAL NOT NULL,
  wall_time_s REAL NOT NULL,
  task TEXT NOT NULL DEFAULT '',
  task_is_drawn INTEGER NOT NULL CHECK (task_is_drawn IN (0, 1)),
  plan_sha256 TEXT NOT NULL DEFAULT '',
  trace_sha256 TEXT NOT NULL DEFAULT '',
  row_sha256 TEXT NOT NULL DEFAULT ''
);
CREATE TABLE metric(
  name TEXT PRIMARY KEY,
  unit TEXT NOT NULL,
  direction TEXT NOT NULL CHECK (direction IN ('none', 'lower', 'higher')),
  wall_clock INTEGER NOT NULL CHECK (wall_clock IN (0, 1)),
  description TEXT NOT NULL,
  minimum REAL NOT NULL,
  maximum REAL NOT NULL
);
-- of plugins that are not built in: tables show them although no layout names them
CREATE TABLE added_metric(name TEXT PRIMARY KEY REFERENCES metric(name)) WITHOUT ROWID;
CREATE TABLE value(
  trial_id INTEGER NOT NULL REFERENCES trial(id) ON DELETE CASCADE,
  metric TEXT NOT NULL REFERENCES metric(name),
  subject_kind TEXT NOT NULL CHECK (subject_kind IN ('system', 'robot', 'pedestrian')),
  subject INTEGER,
  coordinate REAL,
  value REAL
);
CREATE INDEX value_of_trial ON value(trial_id, metric);
CREATE TABLE event(
  trial_id INTEGER NOT NULL REFERENCES trial(id) ON DELETE CASCADE,
  metric TEXT NOT NULL,
  from_s REAL NOT NULL,
  to_s REAL NOT NULL,
  subjects TEXT NOT NULL,
  text TEXT NOT NULL,
  people TEXT NOT NULL DEFAULT '[]',
  severity TEXT NOT NULL DEFAULT 'info',
  x_m REAL,
  y_m REAL
);
CREATE INDEX event_of_trial ON event(trial_id);
CREATE TABLE fault(
  trial_id INTEGER NOT NULL REFERENCES trial(id) ON DELETE CASCADE,
  kind TEXT NOT NULL,
  plugin TEXT NOT NULL,
  function TEXT NOT NULL,
  step INTEGER NOT NULL,
  robot INTEGER,
  signal INTEGER,
  detail TEXT NOT NULL,
  rerun TEXT NOT NULL
);
CREATE INDEX fault_of_trial ON fault(trial_id);
CREATE TABLE swept(
  trial_id INTEGER NOT NULL REFERENCES trial(id) ON DELETE CASCADE,
  "table" TEXT NOT NULL,
  "key" TEXT NOT NULL,
  value TEXT NOT NULL
);
CREATE INDEX swept_of_trial ON swept(trial_id);
-- why trials are not repeatable
CREATE TABLE timing(
  trial_id INTEGER NOT NULL REFERENCES trial(id) ON DELETE CASCADE,
  plugin TEXT NOT NULL,
  reason TEXT NOT NULL
);
CREATE INDEX timing_of_trial ON timing(trial_id);
)sql";

constexpr std::array<const char*, 3> direction_names{"none", "lower", "higher"};    // by DMRP_DIRECTION_*
constexpr std::array<const char*, 3> severity_names{"info", "warning", "serious"};  // by DMRP_SEVERITY_*

std::uint32_t index_of(const std::array<const char*, 3>& names, const std::string& name) {
  for (std::uint32_t i = 0; i < names.size(); ++i)
    if (name == names[i]) return i;
  throw SqliteError("'" + name + "' is unknown");
}

std::int64_t as_signed(std::uint64_t value) {
  return static_cast<std::int64_t>(value);
}
std::uint64_t as_unsigned(std::int64_t value) {
  return static_cast<std::uint64_t>(value);
}

double seconds(std::int64_t ns) {
  return static_cast<double>(ns) / 1e9;
}
std::int64_t nanoseconds(double s) {
  return std::llround(s * 1e9);
}

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();  // bound as NULL

void write_trial(const SqliteConnection& connection, const TrialRecord& trial) {
  SqliteStatement insert(connection, "INSERT INTO trial VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  insert.bind(as_signed(trial.id)).bind(trial.scenario).bind(std::int64_t{trial.robots});
  insert.bind(trial.global_planner).bind(trial.local_controller).bind(trial.pedestrian_model);
  insert.bind(std::int64_t{trial.repetition}).bind(as_signed(trial.seed));
  insert.bind(trial.outcome).bind(std::int64_t{trial.repeatable}).bind(trial.sim_time_s).bind(trial.wall_time_s);
  insert.bind(trial.task)
      .bind(std::int64_t{trial.task_is_drawn})
      .bind(trial.plan_sha256)
      .bind(trial.trace_sha256)
      .bind(row_sha256(trial))
      .run();
}

void write_swept(const SqliteConnection& connection, const TrialRecord& trial) {
  SqliteStatement insert(connection, "INSERT INTO swept VALUES (?, ?, ?, ?)");
  for (const SweptValue& swept : trial.swept)
    insert.bind(as_signed(trial.id)).bind(swept.table).bind(swept.key).bind(swept.value).run();
}

void write_values(const SqliteConnection& connection, const TrialRecord& trial) {
  SqliteStatement insert(connection, "INSERT INTO value VALUES (?, ?, ?, ?, ?, ?)");
  for (const MetricValue& value : trial.values) {
    insert.bind(as_signed(trial.id))
        .bind(value.metric)
        .bind(std::string_view(subject_kind_names.at(value.subject_kind)));
    if (value.subject)
      insert.bind(as_signed(*value.subject));
    else
      insert.bind_null();
    insert.bind(value.coordinate.value_or(undefined)).bind(value.value.value_or(undefined)).run();
  }
}

void write_events(const SqliteConnection& connection, const TrialRecord& trial) {
  SqliteStatement insert(connection, "INSERT INTO event VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  for (const MetricEvent& event : trial.events) {
    insert.bind(as_signed(trial.id)).bind(event.metric).bind(seconds(event.from_ns)).bind(seconds(event.to_ns));
    insert.bind(nlohmann::json(event.robots).dump()).bind(event.text).bind(nlohmann::json(event.people).dump());
    insert.bind(std::string_view(severity_names.at(event.severity)));
    insert.bind(event.place ? event.place->x : undefined).bind(event.place ? event.place->y : undefined).run();
  }
}

void write_faults(const SqliteConnection& connection, std::uint64_t trial, std::span<const FaultRecord> faults) {
  SqliteStatement insert(connection, "INSERT INTO fault VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)");
  for (const FaultRecord& fault : faults) {
    insert.bind(as_signed(trial)).bind(fault.kind).bind(fault.plugin).bind(fault.function).bind(fault.step);
    if (fault.robot >= 0)
      insert.bind(std::int64_t{fault.robot});
    else
      insert.bind_null();
    if (fault.signal != 0)
      insert.bind(std::int64_t{fault.signal});
    else
      insert.bind_null();
    insert.bind(fault.detail).bind(fault.rerun).run();
  }
}

void write_timing(const SqliteConnection& connection, const TrialRecord& trial) {
  SqliteStatement insert(connection, "INSERT INTO timing VALUES (?, ?, ?)");
  for (const TimingReason& reason : trial.timing)
    insert.bind(as_signed(trial.id)).bind(reason.plugin).bind(reason.text).run();
}

// `sha256s`: of each row as it was written.
std::vector<TrialRecord> read_trials(const SqliteConnection& connection, std::vector<std::string>& sha256s) {
  SqliteStatement select(connection,
                         "SELECT id, scenario, robots, global_planner, local_controller, pedestrian_model, repetition, "
                         "seed, outcome, repeatable, sim_time_s, wall_time_s, task, task_is_drawn, plan_sha256, "
                         "trace_sha256, row_sha256 FROM trial ORDER BY id");
  std::vector<TrialRecord> trials;
  while (select.step()) {
    TrialRecord& trial = trials.emplace_back();
    trial.id = as_unsigned(select.column_integer(0));
    trial.scenario = select.column_text(1);
    trial.robots = static_cast<std::uint32_t>(select.column_integer(2));
    trial.global_planner = select.column_text(3);
    trial.local_controller = select.column_text(4);
    trial.pedestrian_model = select.column_text(5);
    trial.repetition = static_cast<std::uint32_t>(select.column_integer(6));
    trial.seed = as_unsigned(select.column_integer(7));
    trial.outcome = select.column_text(8);
    trial.repeatable = select.column_integer(9) != 0;
    trial.sim_time_s = select.column_number(10);
    trial.wall_time_s = select.column_number(11);
    trial.task = select.column_text(12);
    trial.task_is_drawn = select.column_integer(13) != 0;
    trial.plan_sha256 = select.column_text(14);
    trial.trace_sha256 = select.column_text(15);
    sha256s.push_back(select.column_text(16));
  }
  return trials;
}

// Calls `take` with every row of `select`, which is ordered by trial as the trials are, and its trial.
template <class Take>
void read_rows(const SqliteConnection& connection, SqliteStatement select, std::vector<TrialRecord>& trials,
               Take take) {
  auto trial = trials.begin();
  while (select.step()) {
    const std::uint64_t id = as_unsigned(select.column_integer(0));
    while (trial != trials.end() && trial->id != id) ++trial;
    // the column is a foreign key, but another program can have deleted the trial
    if (trial == trials.end())
      throw SqliteError(connection.file() + ": has results of trial " + std::to_string(id) +
                        ", which is not in its table 'trial': it was changed after the run");
    take(select, *trial);
  }
}

void take_swept(const SqliteStatement& row, TrialRecord& trial) {
  trial.swept.push_back({row.column_text(1), row.column_text(2), row.column_text(3)});
}

void take_value(const SqliteStatement& row, TrialRecord& trial) {
  MetricValue& value = trial.values.emplace_back();
  value.metric = row.column_text(1);
  value.subject_kind = index_of(subject_kind_names, row.column_text(2));
  if (!row.column_is_null(3)) value.subject = as_unsigned(row.column_integer(3));
  if (!row.column_is_null(4)) value.coordinate = row.column_number(4);
  if (!row.column_is_null(5)) value.value = row.column_number(5);
}

MetricEvent event_of(const SqliteStatement& row) {
  MetricEvent event;
  event.metric = row.column_text(1);
  event.from_ns = nanoseconds(row.column_number(2));
  event.to_ns = nanoseconds(row.column_number(3));
  event.robots = nlohmann::json::parse(row.column_text(4)).get<std::vector<std::uint32_t>>();
  event.text = row.column_text(5);
  event.people = nlohmann::json::parse(row.column_text(6)).get<std::vector<std::uint64_t>>();
  event.severity = index_of(severity_names, row.column_text(7));
  if (!row.column_is_null(8)) event.place = dmrp_vec2{row.column_number(8), row.column_number(9)};
  return event;
}

void take_event(const SqliteStatement& row, TrialRecord& trial) {
  trial.events.push_back(event_of(row));
}

void take_fault(const SqliteStatement& row, TrialRecord& trial) {
  FaultRecord& fault = trial.faults.emplace_back();
  fault.kind = row.column_text(1);
  fault.plugin = row.column_text(2);
  fault.function = row.column_text(3);
  fault.step = row.column_integer(4);
  if (!row.column_is_null(5)) fault.robot = static_cast<std::int32_t>(row.column_integer(5));
  if (!row.column_is_null(6)) fault.signal = static_cast<std::int32_t>(row.column_integer(6));
  fault.detail = row.column_text(7);
  fault.rerun = row.column_text(8);
}

void take_timing(const SqliteStatement& row, TrialRecord& trial) {
  trial.timing.push_back({row.column_text(1), row.column_text(2)});
}

SqliteStatement select_events(const SqliteConnection& connection, const std::string& rest) {
  return SqliteStatement(
      connection,
      "SELECT trial_id, metric, from_s, to_s, subjects, text, people, severity, x_m, y_m FROM event " + rest);
}

// Without events.
std::vector<TrialRecord> read_results(const SqliteConnection& connection) {
  std::vector<std::string> sha256s;
  std::vector<TrialRecord> trials = read_trials(connection, sha256s);
  const auto select = [&](const char* sql) { return SqliteStatement(connection, sql); };
  read_rows(
      connection,
      select("SELECT trial_id, metric, subject_kind, subject, coordinate, value FROM value ORDER BY trial_id, rowid"),
      trials, take_value);
  read_rows(connection,
            select("SELECT trial_id, kind, plugin, function, step, robot, signal, detail, rerun FROM fault "
                   "ORDER BY trial_id, rowid"),
            trials, take_fault);
  read_rows(connection, select("SELECT trial_id, \"table\", \"key\", value FROM swept ORDER BY trial_id, rowid"),
            trials, take_swept);
  read_rows(connection, select("SELECT trial_id, plugin, reason FROM timing ORDER BY trial_id, rowid"), trials,
            take_timing);
  for (std::size_t i = 0; i < trials.size(); ++i)
    if (row_sha256(trials[i]) != sha256s[i])
      throw SqliteError(
          fmt::format("{}: trial {} has other values than the run has written: it was changed after the run",
                      connection.file(), trials[i].id));
  return trials;
}

// What the host reads is plain tables: something else under their names could answer without end, and a trigger could
// change what is written.
void check_schema(const SqliteConnection& connection, const std::filesystem::path& path) {
  SqliteStatement odd(connection, R"sql(
    SELECT type, name FROM sqlite_schema AS s WHERE type = 'trigger'
      OR (name IN ('trial', 'metric', 'added_metric', 'value', 'event', 'fault', 'swept', 'timing')
        AND (type <> 'table' OR sql LIKE 'CREATE VIRTUAL%'
          OR EXISTS (SELECT 1 FROM pragma_table_xinfo(s.name) WHERE hidden <> 0))))sql");
  if (odd.step())
    throw SqliteError(path.string() + ": has a " + odd.column_text(0) + " '" + escaped(odd.column_text(1).c_str()) +
                      "' that no dmrp-host makes: it was changed after the run");
}

void check_file(const SqliteConnection& connection, const std::filesystem::path& path) {
  check_schema(connection, path);
  SqliteStatement check(connection, "PRAGMA quick_check(1)");
  if (!check.step() || check.column_text(0) != "ok")
    throw SqliteError(path.string() + ": is damaged: " + check.column_text(0));
  SqliteStatement pragma(connection, "PRAGMA user_version");
  const std::int64_t version = pragma.step() ? pragma.column_integer(0) : 0;
  if (version != schema_version)
    throw SqliteError(path.string() + ": results of version " + std::to_string(version) + ", not " +
                      std::to_string(schema_version));
}

}  // namespace

ResultsDatabase::ResultsDatabase(SqliteConnection connection) : connection_(std::move(connection)) {
  connection_.execute("PRAGMA foreign_keys = ON");
}

ResultsDatabase ResultsDatabase::create(const std::filesystem::path& path, std::span<const MetricColumn> metrics) {
  ResultsDatabase database{SqliteConnection(path, SqliteMode::create)};
  SqliteConnection& connection = database.connection_;
  connection.execute("PRAGMA journal_mode = WAL");
  SqliteTransaction transaction(connection);
  connection.execute(schema);
  connection.execute(create_value_views(metrics));
  connection.execute("PRAGMA user_version = " + std::to_string(schema_version));
  SqliteStatement insert(connection, "INSERT INTO metric VALUES (?, ?, ?, ?, ?, ?, ?)");
  for (const MetricColumn& metric : metrics) {
    insert.bind(metric.name).bind(metric.unit).bind(std::string_view(direction_names.at(metric.direction)));
    insert.bind(std::int64_t{metric.wall_clock}).bind(metric.description);
    insert.bind(metric.minimum).bind(metric.maximum).run();
  }
  SqliteStatement insert_added(connection, "INSERT INTO added_metric VALUES (?)");
  for (const MetricColumn& metric : metrics)
    if (metric.added) insert_added.bind(metric.name).run();
  transaction.commit();
  return database;
}

ResultsDatabase ResultsDatabase::open(const std::filesystem::path& path) {
  ResultsDatabase database{SqliteConnection(path, SqliteMode::read_write)};
  check_file(database.connection_, path);
  database.connection_.execute("PRAGMA journal_mode = WAL");
  return database;
}

ResultsDatabase ResultsDatabase::open_read_only(const std::filesystem::path& path) {
  ResultsDatabase database{SqliteConnection(path, SqliteMode::read_only)};
  database.connection_.execute("BEGIN");  // and never ended: a run that goes on may write between two reads
  check_file(database.connection_, path);
  return database;
}

void ResultsDatabase::write(std::span<const TrialRecord> trials) {
  SqliteTransaction transaction(connection_);
  for (const TrialRecord& trial : trials) {
    SqliteStatement(connection_, "DELETE FROM trial WHERE id = ?").bind(as_signed(trial.id)).run();
    // and what another program left of it when it deleted the trial alone
    for (const char* rest : {"DELETE FROM value WHERE trial_id = ?", "DELETE FROM event WHERE trial_id = ?",
                             "DELETE FROM fault WHERE trial_id = ?", "DELETE FROM swept WHERE trial_id = ?",
                             "DELETE FROM timing WHERE trial_id = ?"})
      SqliteStatement(connection_, rest).bind(as_signed(trial.id)).run();
    write_trial(connection_, trial);
    write_swept(connection_, trial);
    write_values(connection_, trial);
    write_events(connection_, trial);
    write_faults(connection_, trial.id, trial.faults);
    write_timing(connection_, trial);
  }
  transaction.commit();
  if (connection_.has_moved())
    throw MachineError(connection_.file() + ": was deleted or replaced while results were written to it");
}

void ResultsDatabase::finish() {
  try {
    connection_.execute("PRAGMA journal_mode = DELETE");
  } catch (const SqliteError&) {
    // somebody reads it: the log stays, and belongs to it
  }
}

void ResultsDatabase::add_fault(std::uint64_t trial, const FaultRecord& fault) {
  SqliteTransaction transaction(connection_);
  write_faults(connection_, trial, {&fault, 1});
  transaction.commit();
}

std::vector<std::uint64_t> ResultsDatabase::finished_trials(Finished which) const {
  SqliteStatement select(connection_,
                         which == Finished::all
                             ? "SELECT id FROM trial WHERE outcome <> 'skipped' ORDER BY id"
                             : "SELECT id FROM trial WHERE outcome <> 'skipped' AND id NOT IN (SELECT trial_id FROM "
                               "fault) ORDER BY id");
  std::vector<std::uint64_t> ids;
  while (select.step()) ids.push_back(as_unsigned(select.column_integer(0)));
  return ids;
}

std::vector<MetricColumn> ResultsDatabase::metrics() const {
  SqliteStatement select(
      connection_,
      "SELECT name, unit, direction, wall_clock, description, minimum, maximum FROM metric ORDER BY rowid");
  std::vector<MetricColumn> metrics;
  while (select.step()) {
    MetricColumn& metric = metrics.emplace_back();
    metric.name = select.column_text(0);
    metric.unit = select.column_text(1);
    metric.direction = index_of(direction_names, select.column_text(2));
    metric.wall_clock = select.column_integer(3) != 0;
    metric.description = select.column_text(4);
    metric.minimum = select.column_number(5);
    metric.maximum = select.column_number(6);
  }
  SqliteStatement added(connection_, "SELECT name FROM added_metric");
  while (added.step())
    for (MetricColumn& metric : metrics)
      if (metric.name == added.column_text(0)) metric.added = true;
  return metrics;
}

std::vector<TrialRecord> ResultsDatabase::trials() const {
  std::vector<TrialRecord> trials = read_results(connection_);
  read_rows(connection_, select_events(connection_, "ORDER BY trial_id, rowid"), trials, take_event);
  return trials;
}

std::vector<TrialRecord> ResultsDatabase::trials_with_events_of(const std::string& metric) const {
  std::vector<TrialRecord> trials = read_results(connection_);
  if (metric.empty()) return trials;
  SqliteStatement select = select_events(connection_, "WHERE metric = ? ORDER BY trial_id, rowid");
  select.bind(std::string_view(metric));
  read_rows(connection_, std::move(select), trials, take_event);
  return trials;
}

std::vector<MetricEvent> ResultsDatabase::events(std::uint64_t trial) const {
  SqliteStatement select = select_events(connection_, "WHERE trial_id = ? ORDER BY rowid");
  select.bind(as_signed(trial));
  std::vector<MetricEvent> events;
  while (select.step()) events.push_back(event_of(select));
  return events;
}

}  // namespace dmrp::host
