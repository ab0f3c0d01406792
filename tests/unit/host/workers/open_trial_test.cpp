// SPDX-License-Identifier: MIT
// The supervisor believes only what fits the state of the worker.
#include "host/workers/open_trial.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "host/process/fault_kind.hpp"
#include "host/results/result_bytes.hpp"

namespace {

using namespace dmrp::host;
using nlohmann::json;
using State = OpenTrial::State;

constexpr std::uint64_t stamp = 77;

Experiment two_metrics() {
  Experiment experiment;
  for (const char* name : {"length", "speed"}) {
    PluginUse use;
    use.info.id = name;
    MetricValueSpec spec;
    spec.name = name;
    spec.subjects = 1u << DMRP_SUBJECT_SYSTEM | 1u << DMRP_SUBJECT_ROBOT;
    use.info.values = {spec};
    experiment.metrics.push_back(use);
  }
  return experiment;
}

class Conversation {
 public:
  Conversation() : trial_(experiment_, blank()) { trial_.begin(stamp); }

  State say(json message, std::uint64_t from = stamp) {
    message["trial"] = 5;
    message["stamp"] = from;
    return trial_.take(message);
  }
  State began() { return say({{"type", "began"}}); }
  State measuring(unsigned index) { return say({{"type", "measuring"}, {"index", index}}); }
  State metric(unsigned index, std::vector<MetricValue> values) { return piece({index, std::move(values), {}}, true); }
  State piece(const MetricResult& result, bool last) {
    json message = result;
    message["type"] = "metric";
    message["last"] = last;
    return say(message);
  }
  State fault(bool fatal, const char* kind = fault_kind::bad_output) {
    json message = FaultRecord{kind, "length", "finish", 0, -1, 0, "", ""};
    message["type"] = "fault";
    message["fatal"] = fatal;
    return say(message);
  }
  State done(const char* outcome, const std::vector<TimingReason>& timing = {}) {
    json message = TrialDone{outcome, timing, 1.5, ""};
    message["type"] = "done";
    return say(message);
  }
  void measure_both() {
    measuring(0);
    metric(0, {system("length")});
    measuring(1);
    metric(1, {system("speed")});
  }
  OpenTrial& trial() { return trial_; }

  static MetricValue system(const char* name) { return {name, DMRP_SUBJECT_SYSTEM, {}, {}, 1.0}; }

 private:
  static TrialRecord blank() {
    TrialRecord record;
    record.id = 5;
    record.robots = 2;
    return record;
  }

  Experiment experiment_ = two_metrics();
  OpenTrial trial_;
};

}  // namespace

TEST_CASE("a trial that goes as it should is believed") {
  Conversation worker;
  CHECK(worker.began() == State::running);
  CHECK(worker.trial().has_begun());
  worker.measure_both();
  CHECK(worker.done(trial_outcome::failed) == State::done);
  CHECK(worker.trial().record().outcome == "failed");
  CHECK(worker.trial().record().values.size() == 2);
  CHECK(worker.trial().record().sim_time_s == 1.5);
}

TEST_CASE("a trial is repeatable if no plugin depends on timing, and otherwise says why") {
  const std::vector<TimingReason> reasons = {{"test.one", "reads a clock"}};
  SECTION("a plugin says so") {
    Conversation worker;
    worker.began();
    worker.measure_both();
    worker.done(trial_outcome::succeeded, reasons);
    CHECK_FALSE(worker.trial().record().repeatable);
    CHECK(worker.trial().record().timing == reasons);
  }
  SECTION("a plugin hangs") {
    Conversation worker;
    worker.began();
    FaultRecord hang{fault_kind::hang, "test.one", "step", 7, -1, 0, "", ""};
    worker.trial().end_attempt(hang);
    CHECK_FALSE(worker.trial().record().repeatable);
    CHECK(worker.trial().record().timing ==
          std::vector<TimingReason>{{"test.one", "step() was stopped: it did not return"}});
  }
  SECTION("none does") {
    Conversation worker;
    worker.began();
    worker.measure_both();
    worker.done(trial_outcome::succeeded);
    CHECK(worker.trial().record().repeatable);
  }
}

TEST_CASE("messages of other processes and of earlier attempts are not believed") {
  Conversation worker;
  CHECK_THROWS_AS(worker.say({{"type", "began"}}, 0), UnbelievableMessage);  // a copy of the worker has no stamp
  CHECK_THROWS_AS(worker.say({{"type", "began"}}, 76), UnbelievableMessage);
  worker.began();
  CHECK_THROWS_AS(worker.began(), UnbelievableMessage);
  CHECK_THROWS_AS(worker.trial().take({{"type", "measuring"}, {"index", 0}}), json::exception);
}

TEST_CASE("messages out of order are not believed") {
  Conversation worker;
  CHECK_THROWS_AS(worker.done(trial_outcome::succeeded), UnbelievableMessage);
  worker.began();
  CHECK_THROWS_AS(worker.done(trial_outcome::succeeded), UnbelievableMessage);  // before the metrics
  CHECK_THROWS_AS(worker.done(trial_outcome::fault), UnbelievableMessage);      // without a fault
  CHECK_THROWS_AS(worker.metric(0, {}), UnbelievableMessage);
  worker.measuring(1);
  CHECK_THROWS_AS(worker.measuring(0), UnbelievableMessage);
  CHECK_THROWS_AS(worker.metric(0, {}), UnbelievableMessage);
  CHECK_THROWS_AS(worker.say({{"type", "dine"}}), UnbelievableMessage);
}

TEST_CASE("numbers that an integer cannot hold are not taken for others") {
  Conversation worker;
  worker.began();
  constexpr std::uint64_t beyond = std::uint64_t{1} << 32;  // 0 in 32 bits
  for (const json& number : {json(beyond), json(1e300), json(0.5), json(-1), json("0")}) {
    INFO(number.dump());
    CHECK_THROWS_AS(worker.say({{"type", "measuring"}, {"index", number}}), UnbelievableMessage);
    CHECK_THROWS_AS(worker.trial().take({{"type", "measuring"}, {"index", 0}, {"trial", 5}, {"stamp", number}}),
                    UnbelievableMessage);
  }
  worker.measuring(0);
  json fault = FaultRecord{fault_kind::bad_output, "length", "finish", 0, -1, 0, "", ""};
  fault["type"] = "fault";
  fault["fatal"] = false;
  for (const char* field : {"step", "robot", "signal"}) {
    json wrong = fault;
    wrong[field] = 1e300;
    CHECK_THROWS_AS(worker.say(wrong), UnbelievableMessage);
  }
  json metric = MetricResult{0, {Conversation::system("length")}, {{"length", 0, 1, {0}, {7}, "", 0, {}}}};
  metric["type"] = "metric";
  metric["last"] = true;
  for (const char* place : {"/index", "/values/0/1", "/values/0/2", "/events/0/1", "/events/0/2", "/events/0/3/0",
                            "/events/0/4/0", "/events/0/6"}) {
    INFO(place);
    json wrong = metric;
    wrong[json::json_pointer(place)] = 1e300;
    CHECK_THROWS_AS(worker.say(wrong), UnbelievableMessage);
  }
  CHECK(worker.say(metric) == State::running);
}

TEST_CASE("a metric gives only what it declares, and that once") {
  Conversation worker;
  worker.began();
  worker.measuring(0);
  const MetricValue good = Conversation::system("length");
  MetricValue bad = good;
  SECTION("another metric's value") {
    bad.metric = "speed";
  }
  SECTION("a robot that is not there") {
    bad = {"length", DMRP_SUBJECT_ROBOT, 2, {}, 1.0};
  }
  SECTION("a subject that it does not declare") {
    bad = {"length", DMRP_SUBJECT_PEDESTRIAN, 0, {}, 1.0};
  }
  SECTION("a robot without a number") {
    bad = {"length", DMRP_SUBJECT_ROBOT, {}, {}, 1.0};
  }
  SECTION("an unknown subject") {
    bad.subject_kind = 40;
  }
  SECTION("a coordinate without a curve") {
    bad.coordinate = 0.5;
  }
  SECTION("twice") {}
  CHECK_THROWS_AS(worker.metric(0, {good, bad}), UnbelievableMessage);
}

TEST_CASE("a metric gives its result in pieces, and has finished with the last") {
  Conversation worker;
  worker.began();
  worker.measuring(0);
  const MetricEvent event = {"length", 0, 1, {0}, {}, "", 0, {}};
  CHECK(worker.piece({0, {Conversation::system("length")}, {event}}, false) == State::running);
  CHECK(worker.trial().record().values.empty());
  SECTION("whole") {
    worker.piece({0, {}, {event, event}}, true);
    CHECK(worker.trial().record().values.size() == 1);
    CHECK(worker.trial().record().events.size() == 3);
    CHECK_THROWS_AS(worker.piece({0, {}, {event}}, false), UnbelievableMessage);
  }
  SECTION("a value in two pieces") {
    CHECK_THROWS_AS(worker.metric(0, {Conversation::system("length")}), UnbelievableMessage);
  }
  SECTION("the next metric begins before the last piece") {
    CHECK_THROWS_AS(worker.measuring(1), UnbelievableMessage);
  }
  SECTION("a fault ends it") {
    worker.fault(false);
    worker.measuring(1);
    worker.metric(1, {Conversation::system("speed")});
    CHECK(worker.trial().record().values.size() == 1);
    CHECK(worker.trial().record().events.empty());
  }
}

TEST_CASE("pieces have an end") {
  Conversation worker;
  worker.began();
  worker.measuring(0);
  const MetricEvent long_event = {"length", 0, 1, {0}, {}, std::string(1 << 20, 'x'), 0, {}};
  const auto flood = [&] {
    for (std::size_t bytes = 0; bytes <= most_result_bytes; bytes += 1 << 20)
      worker.piece({0, {}, {long_event}}, false);
  };
  CHECK_THROWS_AS(flood(), UnbelievableMessage);
}

TEST_CASE("a metric's fault loses its values alone, another's ends the trial") {
  Conversation worker;
  worker.began();
  SECTION("of a metric") {
    worker.measuring(0);
    CHECK(worker.fault(false) == State::running);
    worker.measuring(1);
    worker.metric(1, {Conversation::system("speed")});
    CHECK(worker.done(trial_outcome::succeeded) == State::done);
  }
  SECTION("of a metric that ends the worker: the others are measured in the next attempt") {
    worker.measuring(0);
    worker.metric(0, {Conversation::system("length")});
    worker.measuring(1);
    CHECK(worker.fault(true) == State::ended_by_fault);
    CHECK(worker.trial().record().values.empty());
    CHECK(worker.trial().begin(78).skip_metrics == std::vector<std::uint32_t>{1});
  }
  SECTION("of a controller") {
    CHECK(worker.fault(false) == State::running);
    CHECK_THROWS_AS(worker.measuring(0), UnbelievableMessage);
    CHECK_THROWS_AS(worker.done(trial_outcome::succeeded), UnbelievableMessage);
    CHECK(worker.done(trial_outcome::fault) == State::done);
  }
  SECTION("of a kind that only a supervisor finds") {
    CHECK_THROWS_AS(worker.fault(false, fault_kind::crash), UnbelievableMessage);
  }
}

TEST_CASE("an attempt that is repeated begins anew, without metrics that had a fault") {
  Conversation worker;
  worker.began();
  worker.measuring(0);
  worker.fault(false);
  worker.measuring(1);
  worker.metric(1, {Conversation::system("speed")});
  worker.trial().restart();
  CHECK(worker.trial().record().values.empty());
  CHECK(worker.trial().record().faults.size() == 1);
  CHECK(worker.trial().begin(78).skip_metrics == std::vector<std::uint32_t>{0});
  CHECK_FALSE(worker.trial().has_begun());
}
