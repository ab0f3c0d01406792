// SPDX-License-Identifier: MIT
// A trial of the supervisor, from the messages of its worker.
#include "host/workers/open_trial.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "host/process/fault_kind.hpp"
#include "host/results/result_json.hpp"

namespace open_trial_test {

using namespace dmrp::host;
using nlohmann::json;

class Conversation {
 public:
  Conversation() : trial_(blank()) { trial_.begin(); }

  bool say(const char* type, json message = json::object()) {
    message["type"] = type;
    return trial_.take(message);
  }
  void metric(unsigned index, const char* name) {
    say("metric", MetricResult{index, {{name, DMRP_SUBJECT_SYSTEM, {}, {}, 1.0}}, {}});
  }
  void fault(const char* kind) { say("fault", FaultRecord{kind, "test.one", "step", 7, -1, 0, "", ""}); }
  bool done(const char* outcome, const std::vector<TimingReason>& timing = {}) {
    return say("done", TrialDone{outcome, timing, 1.5, ""});
  }
  OpenTrial& trial() { return trial_; }
  const TrialRecord& record() const { return trial_.record(); }

 private:
  static TrialRecord blank() {
    TrialRecord record;
    record.id = 5;
    return record;
  }

  OpenTrial trial_;
};

TEST_CASE("a trial has the values of its metrics, in the pieces that come") {
  Conversation worker;
  CHECK_FALSE(worker.trial().has_begun());
  CHECK_FALSE(worker.say("began"));
  CHECK(worker.trial().has_begun());
  worker.metric(0, "length");
  worker.metric(1, "speed");
  CHECK(worker.done(trial_outcome::failed));
  CHECK(worker.record().outcome == "failed");
  CHECK(worker.record().values.size() == 2);
  CHECK(worker.record().sim_time_s == 1.5);
}

TEST_CASE("a trial is repeatable if no plugin depends on timing, and otherwise says why") {
  const std::vector<TimingReason> reasons = {{"test.one", "reads a clock"}};
  Conversation worker;
  worker.say("began");
  SECTION("a plugin says so") {
    worker.done(trial_outcome::succeeded, reasons);
    CHECK_FALSE(worker.record().repeatable);
    CHECK(worker.record().timing == reasons);
  }
  SECTION("a plugin hangs") {
    worker.fault(fault_kind::hang);
    worker.done(trial_outcome::fault);
    CHECK_FALSE(worker.record().repeatable);
    CHECK(worker.record().timing == std::vector<TimingReason>{{"test.one", "step() was stopped: it did not return"}});
  }
  SECTION("none does") {
    worker.done(trial_outcome::succeeded);
    CHECK(worker.record().repeatable);
  }
}

TEST_CASE("a trial whose worker ends has its fault alone, and one that is run again begins anew") {
  Conversation worker;
  worker.say("began");
  worker.metric(0, "length");
  worker.fault(fault_kind::bad_output);
  SECTION("ends") {
    worker.trial().end_by({fault_kind::worker_error, "", "", 0, -1, 0, "", ""});
    CHECK(worker.record().outcome == trial_outcome::fault);
  }
  SECTION("is run again") {
    worker.trial().restart();
    worker.trial().begin();
    CHECK_FALSE(worker.trial().has_begun());
  }
  CHECK(worker.record().values.empty());
  CHECK(worker.record().faults.size() == (worker.record().outcome.empty() ? 0 : 1));
}

}  // namespace open_trial_test
