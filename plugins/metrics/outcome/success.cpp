// SPDX-License-Identifier: MIT
#include "metrics/outcome/success.hpp"

#include "metrics/measure/contact_fault.hpp"
#include "metrics/measure/describe_metric.hpp"
#include "metrics/measure/per_robot.hpp"

namespace dmrp::metrics {
namespace {

const char* reason(std::uint32_t failure) {
  switch (failure) {
    case DMRP_FAILURE_TIMEOUT:
      return "time limit";
    case DMRP_FAILURE_OSCILLATION:
      return "oscillation";
    case DMRP_FAILURE_CONTROLLER:
      return "no command from its controller";
    case DMRP_FAILURE_NO_PLAN:
      return "no plan";
    case DMRP_FAILURE_HELD_BEHIND:
      return "held behind another robot";
    case DMRP_FAILURE_CIRCLING:
      return "circling";
    case DMRP_FAILURE_BLOCKED_PERSON:
      return "blocked by a person";
    case DMRP_FAILURE_BLOCKED_ROBOT:
      return "blocked by a robot";
    case DMRP_FAILURE_STUCK:
      return "stuck";
    default:
      return "unknown reason";
  }
}

}  // namespace

Descriptor Success::describe() {
  return describe_metric("dmrp.metric.success", "Success")
      .summary("robots that reached their last goal in time, and those that did so safely")
      .source(
          "success rate: Hu et al., DMRP-Bench, ICRA 2026; passive motion safety: Bouraine, Fraichard, Salhi, "
          "Autonomous Robots 32, 2012")
      .value("success", "1", Direction::higher_is_better, Subjects::system_and_robots,
             "1 if the robot arrived by the time limit and was not failed by the host, else 0")
      .value("trial_success", "1", Direction::higher_is_better, Subjects::system,
             "1 if every robot succeeded, else 0; undefined without robots")
      .value("safe_success", "1", Direction::higher_is_better, Subjects::system_and_robots,
             "1 if the robot succeeded and at every contact was at rest (below 0.05 m/s) or moving away from the other "
             "when they touched, else 0 (passive motion safety)")
      .value("contact_free_success", "1", Direction::higher_is_better, Subjects::system_and_robots,
             "1 if the robot succeeded without any contact, else 0");
}

void Success::begin(const dmrp_plan*) {
  at_fault_.assign(world().robots().size(), false);
  touched_.assign(world().robots().size(), false);
}

void Success::observe(const Sample& sample) {
  for (const Contact& contact : sample.contacts) {
    if (!is_known(contact)) continue;
    touched_[contact.a] = true;
    if (fault_of_a(contact)) at_fault_[contact.a] = true;
    if (!between_robots(contact)) continue;
    touched_[contact.b] = true;
    if (fault_of_b(contact)) at_fault_[contact.b] = true;
  }
}

void Success::finish(const TrialEnd& end, MetricSink& sink) {
  std::vector<double> success, safe_success, contact_free_success;
  bool all = true;
  for (std::size_t robot = 0; robot < at_fault_.size(); ++robot) {
    // a robot that circled may be excluded though it arrived
    const bool succeeded = end.robots[robot].arrival_ns >= 0 && end.robots[robot].failure == DMRP_FAILURE_NONE;
    all = all && succeeded;
    success.push_back(succeeded ? 1.0 : 0.0);
    safe_success.push_back(succeeded && !at_fault_[robot] ? 1.0 : 0.0);
    contact_free_success.push_back(succeeded && !touched_[robot] ? 1.0 : 0.0);
    if (succeeded) continue;
    std::vector<Subject> robots = {robot_subject(robot)};  // and the culprit
    if (end.robots[robot].culprit < end.robots.size()) robots.push_back(robot_subject(end.robots[robot].culprit));
    sink.event({"success", end.t_ns, end.t_ns, robots,
                "robot " + std::to_string(robot) + " failed: " + reason(end.robots[robot].failure)});
  }
  give_mean(sink, "success", success);
  sink.system("trial_success", success.empty() ? undefined : all ? 1.0 : 0.0);
  give_mean(sink, "safe_success", safe_success);
  give_mean(sink, "contact_free_success", contact_free_success);
}

}  // namespace dmrp::metrics
