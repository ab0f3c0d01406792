// SPDX-License-Identifier: MIT
#include "host/workers/open_trial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>
#include <tuple>

#include "host/process/fault_kind.hpp"
#include "host/results/result_bytes.hpp"
#include "host/workers/stored_plan.hpp"
#include "host/workers/whole_number.hpp"

namespace dmrp::host {

namespace {

constexpr std::array found_by_workers = {fault_kind::out_of_memory, fault_kind::bad_output, fault_kind::abi_breach,
                                         fault_kind::error_status};

void expect(bool condition, const char* text) {
  if (!condition) throw UnbelievableMessage(text);
}

bool is_one_of(std::string_view text, std::initializer_list<std::string_view> known) {
  return std::find(known.begin(), known.end(), text) != known.end();
}

bool may_be_value(const MetricValue& value, const MetricValueSpec& declared, std::uint32_t robots) {
  if (value.subject_kind > DMRP_SUBJECT_PEDESTRIAN || !(declared.subjects & (1u << value.subject_kind))) return false;
  if (value.subject.has_value() == (value.subject_kind == DMRP_SUBJECT_SYSTEM)) return false;
  if (value.subject_kind == DMRP_SUBJECT_ROBOT && *value.subject >= robots) return false;
  if (value.coordinate && !declared.curve) return false;
  return std::isfinite(value.value.value_or(0.0)) && std::isfinite(value.coordinate.value_or(0.0));
}

bool may_be_event(const MetricEvent& event, std::uint32_t robots) {
  return event.from_ns <= event.to_ns && event.severity <= DMRP_SEVERITY_SERIOUS &&
         std::all_of(event.robots.begin(), event.robots.end(), [&](std::uint32_t robot) { return robot < robots; });
}

}  // namespace

TrialRecord blank_record(const Experiment& experiment, std::uint64_t trial) {
  const auto all = combinations(experiment);
  const TrialId id = trial_id(trial, all.size());
  const Combination& combination = all[id.combination];
  const ScenarioVariant& variant = experiment.scenarios[combination.scenario];
  TrialRecord record;
  record.id = trial;
  record.scenario = result_name(variant);
  record.robots = robot_count(variant);
  record.swept = variant.swept;
  const auto label = [&record](const std::vector<PluginUse>& uses, std::int32_t index) {
    if (index < 0) return std::string();
    const PluginUse& use = uses[static_cast<std::size_t>(index)];
    record.swept.insert(record.swept.end(), use.swept.begin(), use.swept.end());
    return use.label;
  };
  record.global_planner = label(experiment.global_planners, combination.global_planner);
  record.local_controller = label(experiment.local_controllers, combination.local_controller);
  record.pedestrian_model = label(experiment.pedestrian_models, combination.pedestrian_model);
  record.repetition = id.repetition;
  record.seed = trial_seed(experiment, trial);
  return record;
}

std::optional<std::string> breach_of(const MetricResult& result, const PluginInfo& metric, std::uint32_t robots) {
  std::set<std::tuple<std::string_view, std::uint32_t, std::optional<std::uint64_t>, std::optional<double>>> given;
  for (const MetricValue& value : result.values) {
    const auto declared = std::find_if(metric.values.begin(), metric.values.end(),
                                       [&](const MetricValueSpec& spec) { return spec.name == value.metric; });
    if (declared == metric.values.end()) return fmt::format("{} does not declare this value", metric.id);
    if (!may_be_value(value, *declared, robots)) return fmt::format("no value of {} can be this", value.metric);
    if (!given.emplace(value.metric, value.subject_kind, value.subject, value.coordinate).second)
      return fmt::format("a value of {} twice", value.metric);
  }
  for (const MetricEvent& event : result.events)
    if (!may_be_event(event, robots)) return fmt::format("no event of {} can be this", metric.id);
  return std::nullopt;
}

Job OpenTrial::begin(std::uint64_t stamp) {
  stamp_ = stamp;
  begun_ = false;
  failed_ = false;
  next_metric_ = 0;
  measuring_.reset();
  Job job;
  job.trial = record_.id;
  job.stamp = stamp;
  job.skip_metrics = skip_metrics_;
  return job;
}

void OpenTrial::check_sender(const nlohmann::json& message) const {
  expect(whole_number<std::uint64_t>(message.at("trial")) == record_.id &&
             whole_number<std::uint64_t>(message.at("stamp")) == stamp_,
         "from another trial or process");
}

OpenTrial::State OpenTrial::take(const nlohmann::json& message) {
  check_sender(message);
  const auto type = message.at("type").get<std::string>();
  expect(begun_ != (type == "began"), "before or after the trial");
  if (type == "began") {
    begun_ = true;
  } else if (type == "measuring") {
    const auto index = whole_number<std::uint32_t>(message.at("index"));
    expect(
        !failed_ && !measuring_ && index >= next_metric_ && index < experiment_->metrics.size() && !is_skipped(index),
        "a metric out of order");
    measuring_ = index;
    next_metric_ = index + 1;
  } else if (type == "metric") {
    take_metric(message);
  } else if (type == "fault") {
    return take_fault(message);
  } else {
    expect(type == "done", "of an unknown type");
    take_done(message);
    return State::done;
  }
  return State::running;
}

void OpenTrial::take_metric(const nlohmann::json& message) {
  auto piece = message.get<MetricResult>();
  expect(measuring_ == piece.index, "values of a metric that does not run");
  take_all(piece.values, given_.values);
  take_all(piece.events, given_.events);
  expect(given_bytes_ <= most_result_bytes, "more than a metric may give");
  if (!message.at("last").get<bool>()) return;
  if (const auto breach = breach_of(given_, experiment_->metrics[piece.index].info, record_.robots))
    throw UnbelievableMessage(*breach);
  std::move(given_.values.begin(), given_.values.end(), std::back_inserter(record_.values));
  std::move(given_.events.begin(), given_.events.end(), std::back_inserter(record_.events));
  skip(piece.index);
}

template <class T>
void OpenTrial::take_all(std::vector<T>& piece, std::vector<T>& given) {
  for (T& one : piece) {
    given_bytes_ += bytes_of(one);
    given.push_back(std::move(one));
  }
}

OpenTrial::State OpenTrial::take_fault(const nlohmann::json& message) {
  auto fault = message.get<FaultRecord>();
  expect(!failed_ && std::find(found_by_workers.begin(), found_by_workers.end(), fault.kind) != found_by_workers.end(),
         "a fault out of order");
  if (message.at("fatal").get<bool>()) return end_attempt(std::move(fault));
  record_.faults.push_back(std::move(fault));
  if (measuring_) {
    // should a later metric kill the worker, this one is not measured a second time
    faulty_metrics_.push_back(*measuring_);
    skip(*measuring_);
  } else {
    failed_ = true;
  }
  return State::running;
}

void OpenTrial::take_done(const nlohmann::json& message) {
  const auto done = message.get<TrialDone>();
  expect(is_one_of(done.outcome, {trial_outcome::succeeded, trial_outcome::failed, trial_outcome::fault}) &&
             failed_ == (done.outcome == trial_outcome::fault) && std::isfinite(done.sim_time_s) &&
             done.sim_time_s >= 0.0,
         "an outcome that cannot be");
  expect(failed_ || (!measuring_ && skip_metrics_.size() == experiment_->metrics.size()), "the end before all metrics");
  record_.outcome = done.outcome;
  add_timing(done.timing);
  record_.sim_time_s = done.sim_time_s;
  record_.task = done.task;
}

void OpenTrial::add_timing(const std::vector<TimingReason>& reasons) {
  for (const TimingReason& reason : reasons)
    if (std::find(record_.timing.begin(), record_.timing.end(), reason) == record_.timing.end())
      record_.timing.push_back(reason);
  record_.repeatable = record_.timing.empty();
}

OpenTrial::State OpenTrial::end_attempt(FaultRecord fault) {
  if (fault.kind == fault_kind::hang)
    add_timing({{fault.plugin, fault.function + "() was stopped: it did not return"}});
  record_.faults.push_back(std::move(fault));
  if (measuring_) {
    faulty_metrics_.push_back(*measuring_);
    restart();
    return State::ended_by_fault;
  }
  record_.outcome = trial_outcome::fault;
  record_.values.clear();
  record_.events.clear();
  return State::done;
}

void OpenTrial::end_without_plan(StoredPlan stored) {
  record_.outcome = trial_outcome::fault;
  record_.faults = {std::move(*stored.fault)};
  record_.task = std::move(stored.task);
  add_timing(stored.timing);
}

void OpenTrial::restart() {
  if (failed_) record_.faults.pop_back();
  failed_ = false;
  measuring_.reset();
  forget_given();
  record_.values.clear();
  record_.events.clear();
  skip_metrics_ = faulty_metrics_;
}

void OpenTrial::skip(std::uint32_t metric) {
  skip_metrics_.push_back(metric);
  measuring_.reset();
  forget_given();
}

void OpenTrial::forget_given() {
  given_ = {};
  given_bytes_ = 0;
}

bool OpenTrial::is_skipped(std::uint32_t metric) const {
  return std::find(skip_metrics_.begin(), skip_metrics_.end(), metric) != skip_metrics_.end();
}

}  // namespace dmrp::host
