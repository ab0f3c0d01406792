// SPDX-License-Identifier: MIT
// collisions.hpp: contact events of robots, by partner and by fault.
#pragma once

#include <map>
#include <tuple>

#include "metrics/measure/contact_fault.hpp"
#include "metrics/measure/values.hpp"

namespace dmrp::metrics {

class Collisions final : public Metric {
 public:
  static Descriptor describe() {
    return describe_metric("dmrp.metric.collisions", "Collisions")
        .summary("contacts of robots as events (rising edges 0.5 s apart), by partner and by fault")
        .source("rising-edge events attributed as in HuNavSim; fault by passive motion safety: Bouraine et al. 2012")
        .value("collisions", "1", lower_is_better, system_and_robots,
               "contact events of the robot, regardless of fault; system: all events, one between two robots once; "
               "undefined if planning failed, like all that follow",
               never_negative)
        .value("collisions_at_fault", "1", lower_is_better, system_and_robots,
               "contact events at the robot's fault: it was neither at rest nor moving away when they touched; system: "
               "events at the fault of at least one robot",
               never_negative)
        .value("collisions_static", "1", lower_is_better, system_and_robots,
               "contact events with walls, furniture or the world's border; system: all", never_negative)
        .value("collisions_robot", "1", lower_is_better, system_and_robots,
               "contact events between robots; counted for both, once for the system", never_negative)
        .value("collisions_person", "1", lower_is_better, system_and_robots,
               "contact events with people, regardless of fault; system: all", never_negative)
        .value(
            "impact_speed", "m/s", lower_is_better, system_and_robots,
            "maximum over contact events, regardless of fault, of the speed at which the two surfaces closed along the "
            "normal when they touched; undefined without a contact, and in traces that do not have it; system: maximum",
            never_negative)
        .channels(DMRP_CHANNEL_PEOPLE);
  }

  void begin(const MetricTrial& trial) override {
    planned_ = static_cast<bool>(trial.plan);
    events_.clear();
    latest_.clear();
  }

  void observe(const Sample& sample) override {
    for (const Contact& contact : sample.contacts) {
      if (!is_known(contact)) continue;
      const Pair pair = pair_of(contact, sample);
      if (begins(contact)) {
        latest_[pair] = events_.size();
        events_.push_back({contact.kind,
                           contact.a,
                           std::get<2>(pair),
                           fault_of_a(contact),
                           fault_of_b(contact),
                           impact_speed(sample, contact),
                           {sample.t_ns, sample.t_ns}});
      } else if (const auto found = latest_.find(pair); found != latest_.end()) {
        events_[found->second].time.to_ns = sample.t_ns;
      }
    }
  }

  void finish(const TrialEnd& end, MetricSink& sink) override {
    Tally system;
    std::vector<Tally> tallies(end.robots.size());
    for (const Event& event : events_) {
      const bool two_robots = event.kind == DMRP_CONTACT_ROBOT;
      system.count(event.kind, event.fault_of_a || (two_robots && event.fault_of_b), event.impact_speed);
      tallies[event.a].count(event.kind, event.fault_of_a, event.impact_speed);
      std::vector<std::uint32_t> robots = {event.a};
      if (two_robots) {
        tallies[event.b].count(event.kind, event.fault_of_b, event.impact_speed);
        robots.push_back(static_cast<std::uint32_t>(event.b));
      }
      give_event(sink, "collisions", event.time, robots, text_of(event));
    }
    for (std::size_t robot = 0; robot < tallies.size(); ++robot)
      give_all(tallies[robot],
               [&](const char* name, double value) { sink.robot(name, robot, planned_ ? value : undefined); });
    give_all(system, [&](const char* name, double value) { sink.system(name, planned_ ? value : undefined); });
  }

 private:
  // The counts of events of one robot or of the system.
  struct Tally {
    double all = 0.0, at_fault = 0.0, with_static = 0.0, with_robots = 0.0, with_people = 0.0;
    double impact_speed = undefined;

    void count(std::uint32_t kind, bool fault, double speed) {
      ++all;
      at_fault += fault;
      with_static += kind == DMRP_CONTACT_STATIC;
      with_robots += kind == DMRP_CONTACT_ROBOT;
      with_people += kind == DMRP_CONTACT_PERSON;
      impact_speed = std::fmax(impact_speed, speed);
    }
  };

  // One contact, from its first to its last sample.
  struct Event {
    std::uint32_t kind;  // DMRP_CONTACT_*
    std::uint32_t a;     // the robot, or the first of two
    std::uint64_t b;     // the partner: index of a shape or robot, id of a person
    bool fault_of_a, fault_of_b;
    double impact_speed;  // m/s; NaN: the trace does not have it
    Spell time;
  };
  using Pair = std::tuple<std::uint32_t, std::uint32_t, std::uint64_t>;  // kind, a, b

  template <class Give>
  static void give_all(const Tally& tally, Give&& give) {
    give("collisions", tally.all);
    give("collisions_at_fault", tally.at_fault);
    give("collisions_static", tally.with_static);
    give("collisions_robot", tally.with_robots);
    give("collisions_person", tally.with_people);
    give("impact_speed", tally.impact_speed);
  }

  // Identifies people by id, because their indices in the array change.
  static Pair pair_of(const Contact& contact, const Sample& sample) {
    const bool person = contact.kind == DMRP_CONTACT_PERSON && contact.b < sample.people.size();
    return {contact.kind, contact.a, person ? sample.people[contact.b].id : contact.b};
  }

  std::string text_of(const Event& event) const {
    const std::string a = "robot " + std::to_string(event.a);
    if (event.kind == DMRP_CONTACT_STATIC) {
      const bool border = event.b >= world().shapes().size();
      return a + " against " + (border ? "the border" : world().shapes()[event.b].name);
    }
    const std::string b = (event.kind == DMRP_CONTACT_ROBOT ? "robot " : "person ") + std::to_string(event.b);
    const std::string at_fault = event.fault_of_a ? event.fault_of_b ? "both" : a : event.fault_of_b ? b : "neither";
    return a + " and " + b + ": " + at_fault + " at fault";
  }

  bool planned_ = false;                // without a plan, nothing moves
  std::vector<Event> events_;           // by beginning
  std::map<Pair, std::size_t> latest_;  // index of the pair's latest event
};

}  // namespace dmrp::metrics
