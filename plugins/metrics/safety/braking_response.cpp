// SPDX-License-Identifier: MIT
#include "metrics/safety/braking_response.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "metrics/measure/contact_fault.hpp"
#include "metrics/measure/describe_metric.hpp"
#include "metrics/measure/hidden_places.hpp"
#include "metrics/measure/per_robot.hpp"

namespace dmrp::metrics {
namespace {

constexpr double rest_speed = 0.05;  // m/s; as for the fault of contacts (sample.h)

std::int64_t nanoseconds(double seconds) {
  return std::llround(1e9 * seconds);
}

}  // namespace

Descriptor BrakingResponse::describe() {
  return describe_metric("dmrp.metric.braking_response", "Braking response")
      .summary("robots that arrived and had no contact at their fault but those before which they braked at once")
      .source("in the spirit of Shalev-Shwartz et al., On a Formal Model of Safe and Scalable Self-driving Cars, 2017")
      .channels(DMRP_CHANNEL_PEOPLE)
      .value(
          "braking_response_success", "1", Direction::higher_is_better, Subjects::system_and_robots,
          "as safe_success, but a contact with a robot or a person is excused if the robot braked at its full "
          "ability from the first moment of danger, plus reaction_s, until it stood, and did not drive on: the other "
          "is in sight and both would touch at constant velocities within the robot's stopping time plus reaction_s; "
          "or it is not, and somebody could come out of a place that the robot does not see at hidden_speed and "
          "touch it within that time; system: mean over robots");
}

// Full braking from the greatest speed, and the danger before it.
void BrakingResponse::begin(const dmrp_plan*) {
  blamed_.assign(world().robots().size(), false);
  history_.clear();
  memory_ns_ = 0;
  for (const Robot& robot : world().robots()) {
    const dmrp_limits& limits = *robot.limits;
    const double braking_s = std::hypot(limits.v_max, limits.v_y_max) / (braking_share * limits.a_max);
    memory_ns_ = std::max(memory_ns_, nanoseconds(reaction_s + swerve_s + braking_s));
  }
}

// A wall excuses nobody.
void BrakingResponse::observe(const Sample& sample) {
  Moment now = moment_of(sample);
  for (const Contact& contact : sample.contacts) {
    if (!is_known(contact) || !begins(contact)) continue;
    const std::size_t a = contact.a;
    const std::size_t b = contact.b + (between_robots(contact) ? 0 : blamed_.size());  // unless it is a wall
    const bool is_wall = contact.kind == DMRP_CONTACT_STATIC;
    if (fault_of_a(contact) && (is_wall || !is_excused(a, now.bodies[b], now.t_ns))) blamed_[a] = true;
    if (between_robots(contact) && fault_of_b(contact) && !is_excused(b, now.bodies[a], now.t_ns)) blamed_[b] = true;
  }
  while (history_.size() > 1 && history_[1].t_ns <= now.t_ns - memory_ns_) history_.pop_front();
  history_.push_back(std::move(now));
}

BrakingResponse::Moment BrakingResponse::moment_of(const Sample& sample) const {
  Moment moment = {sample.t_ns, {}};
  for (std::size_t i = 0; i < blamed_.size(); ++i) {
    const Robot& robot = world().robots()[i];
    const Moving now = moving(robot, sample.robots[i]);
    const double turning_m = robot.footprint->part_count == 0 ? 0.0 : robot.footprint->radius_m;
    moment.bodies.push_back({DMRP_AGENT_ROBOT, i, now,
                             toolkit::norm(now.velocity) + turning_m * std::abs(sample.robots[i].velocity.omega)});
  }
  for (const Person& person : sample.people)
    moment.bodies.push_back({DMRP_AGENT_PERSON, person.id, moving(person), toolkit::norm(person.velocity)});
  return moment;
}

// Null: it was not there.
const BrakingResponse::Body* BrakingResponse::find(const Moment& moment, const Body& body) {
  const auto found = std::find_if(moment.bodies.begin(), moment.bodies.end(),
                                  [&](const Body& one) { return one.kind == body.kind && one.id == body.id; });
  return found == moment.bodies.end() ? nullptr : &*found;
}

double BrakingResponse::horizon_s(std::size_t robot, Vec2 velocity) const {
  return toolkit::norm(velocity) / world().robots()[robot].limits->a_max + reaction_s;
}

bool BrakingResponse::is_danger(const Moment& moment, std::size_t robot, const Body& other) const {
  const Moving& self = moment.bodies[robot].moving;
  const double within_s = horizon_s(robot, self.velocity);
  const Body* const there = find(moment, other);
  if (there && in_sight(world().shapes(), self.disc.center, there->moving.disc.center))
    return time_to_contact(self, there->moving) <= within_s;
  return may_be_surprised(world(), self, within_s, hidden_speed, other.moving.disc.radius_m);
}

// In the step after this moment.
bool BrakingResponse::is_braking(std::size_t moment, std::size_t robot) const {
  const Moment& before = history_[moment];
  const Moment& after = history_[moment + 1];
  const double loss =
      braking_share * world().robots()[robot].limits->a_max * 1e-9 * static_cast<double>(after.t_ns - before.t_ns);
  return after.bodies[robot].speed <= std::max(before.bodies[robot].speed - loss, rest_speed);
}

// Whether the robot would be in no danger had it kept its velocity of the moment before.
bool BrakingResponse::made_the_danger(std::size_t moment, std::size_t robot, const Body& other) const {
  if (moment == 0) return false;
  const Body* const there = find(history_[moment], other);
  Moving self = history_[moment].bodies[robot].moving;
  self.velocity = history_[moment - 1].bodies[robot].moving.velocity;
  return there && !(time_to_contact(self, there->moving) <= horizon_s(robot, self.velocity));
}

bool BrakingResponse::is_excused(std::size_t robot, const Body& other, std::int64_t contact_ns) const {
  if (history_.empty()) return false;
  const std::size_t last = history_.size() - 1;
  std::size_t braking_from = last;
  while (braking_from > 0 && is_braking(braking_from - 1, robot)) --braking_from;
  std::optional<std::size_t> first;  // moment of danger
  std::int64_t dangerous_ns = contact_ns;
  for (std::size_t i = history_.size(); i-- > 0;) {
    const std::int64_t t_ns = history_[i].t_ns;
    if (!is_danger(history_[i], robot, other)) {
      if (dangerous_ns - t_ns >= nanoseconds(swerve_s)) break;
      continue;
    }
    dangerous_ns = t_ns;
    first = i;
    if (braking_from > 0 && history_[braking_from - 1].t_ns >= t_ns + nanoseconds(reaction_s)) return false;
  }
  // it brakes, or the danger came too late for it
  return braking_from < last || !first || !made_the_danger(*first, robot, other);
}

void BrakingResponse::finish(const TrialEnd& end, MetricSink& sink) {
  std::vector<double> values;
  for (std::size_t robot = 0; robot < blamed_.size(); ++robot) {
    const bool succeeded = end.robots[robot].arrival_ns >= 0 && end.robots[robot].failure == DMRP_FAILURE_NONE;
    values.push_back(succeeded && !blamed_[robot] ? 1.0 : 0.0);
  }
  give_mean(sink, "braking_response_success", values);
}

}  // namespace dmrp::metrics
