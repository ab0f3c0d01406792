// SPDX-License-Identifier: MIT
// success.hpp: robots that arrived, robots that did so without a contact at their fault, and how fast these were.
#pragma once

#include "metrics/measure/contact_ends.hpp"
#include "metrics/measure/contact_fault.hpp"
#include "metrics/measure/values.hpp"
#include "metrics/outcome/shortest_way.hpp"

namespace dmrp::metrics {

class Success final : public Metric {
 public:
  static Descriptor describe() {
    return describe_metric("dmrp.metric.success", "Success")
        .summary("robots that reached their last goal in time, and those that did so safely")
        .source(
            "success rate: Hu et al., DMRP-Bench, ICRA 2026; passive motion safety: Bouraine, Fraichard, Salhi, "
            "Autonomous Robots 32, 2012; success weighted by completion time: Yokoyama, Ha, Batra, IROS 2021")
        .value("success", "1", higher_is_better, system_and_robots,
               "1 if the robot arrived by the time limit and was not failed by the host, else 0", share_range)
        .value("trial_success", "1", higher_is_better, Subjects::system,
               "1 if every robot succeeded, else 0; undefined without robots", share_range)
        .value("safe_success", "1", higher_is_better, system_and_robots,
               "1 if the robot succeeded and at every contact was at rest (below 0.05 m/s) or moving away from the "
               "other when they touched, else 0 (passive motion safety)",
               share_range)
        .value("contact_free_success", "1", higher_is_better, system_and_robots,
               "1 if the robot succeeded without any contact, else 0", share_range)
        .value("safe_sct", "1", higher_is_better, system_and_robots,
               "safe success weighted by completion time: S min(1, l / (v_max t)): S as safe_success, l = "
               "shortest_length (of SPL), t = completion_time; 1 where l is 0 and 0 without safe success; undefined if "
               "there is no way",
               share_range);
  }

  void begin(const MetricTrial&) override {
    at_fault_.assign(world().robots().size(), false);
    touched_.assign(world().robots().size(), false);
    contacts_.begin(world().robots().size());
  }

  void observe(const Sample& sample) override {
    contacts_.observe(sample);
    for (const Contact& contact : sample.contacts) {
      if (!is_known(contact)) continue;
      touched_[contact.a] = true;
      if (fault_of_a(contact)) at_fault_[contact.a] = true;
      if (!between_robots(contact)) continue;
      touched_[contact.b] = true;
      if (fault_of_b(contact)) at_fault_[contact.b] = true;
    }
  }

  void finish(const TrialEnd& end, MetricSink& sink) override {
    std::vector<double> success, safe_success, contact_free_success;
    for (std::uint32_t robot = 0; robot < at_fault_.size(); ++robot) {
      const RobotEnd& own = end.robots[robot];
      success.push_back(succeeded(own) ? 1.0 : 0.0);
      safe_success.push_back(succeeded(own) && !at_fault_[robot] ? 1.0 : 0.0);
      contact_free_success.push_back(succeeded(own) && !touched_[robot] ? 1.0 : 0.0);
      if (succeeded(own)) continue;
      const bool by_contact = contacts_.failed_by_contact(robot, own);
      std::vector<std::uint32_t> robots = {robot};  // and the culprit
      if (!by_contact && own.culprit < end.robots.size()) robots.push_back(own.culprit);
      give_event(sink, "success", {end.t_ns, end.t_ns}, robots,
                 "robot " + std::to_string(robot) +
                     " failed: " + (by_contact ? contacts_.words(robot, own) : std::string(reason(own.failure))));
    }
    give(sink, "success", &mean_of_defined, success);
    sink.system("trial_success", least_of_defined(success));
    give(sink, "safe_success", &mean_of_defined, safe_success);
    give(sink, "contact_free_success", &mean_of_defined, contact_free_success);
    give(sink, "safe_sct", &mean_of_defined, weighted_by_time(safe_success, end));
  }

 private:
  std::vector<double> weighted_by_time(std::vector<double> safe_success, const TrialEnd& end) {
    if (sum_of_defined(safe_success) > 0.0) {
      tours_.begin(world());
      for (std::size_t robot = 0; robot < safe_success.size(); ++robot)
        if (safe_success[robot] > 0.0) {
          const double least_s = tours_.least_time_s(world().robots()[robot]);
          safe_success[robot] = least_s == 0.0 ? 1.0 : most_one(least_s / in_seconds(end.robots[robot].arrival_ns));
        }
    }
    return safe_success;
  }

  // NaN stays NaN.
  static double most_one(double value) { return value > 1.0 ? 1.0 : value; }

  static const char* reason(std::uint32_t failure) {
    switch (failure) {
      case DMRP_FAILURE_TIMEOUT:
        return "time limit";
      case DMRP_FAILURE_OSCILLATION:
        return "excluded for oscillation";
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

  ShortestTours tours_;
  ContactEnds contacts_;
  std::vector<char> at_fault_;  // by robot: whether it had a contact at its fault
  std::vector<char> touched_;   // by robot: whether it had any contact
};

}  // namespace dmrp::metrics
