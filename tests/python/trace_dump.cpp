// SPDX-License-Identifier: MIT
// trace_dump TRACE.mcap: the numbers of every sample as the C++ reader has them, a line a robot, person and contact, doubles
// in hexadecimal: tests/python compares the Python reader with it. trace_dump --time TRACE.mcap: the number of samples, and
// the seconds of processor time that the fastest of several readings took.
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <exception>
#include <limits>

#include "core/trace/trace_reader.hpp"

namespace {

void print_robots(const dmrp_sample& sample) {
  for (std::uint32_t i = 0; i < sample.robot_count; ++i) {
    const dmrp_robot_sample& robot = *DMRP_AT(dmrp_robot_sample, sample.robots, sample.robot_stride, i);
    std::printf("robot %a %a %a %a %a %a %a %a %a %u %u %a %a %a %a %a %d\n", robot.pose.x, robot.pose.y,
                robot.pose.theta, robot.velocity.v_x, robot.velocity.v_y, robot.velocity.omega, robot.command.v_x,
                robot.command.v_y, robot.command.omega, robot.state, robot.goal_index, robot.progress_m,
                robot.steering_angle, robot.answer.v_x, robot.answer.v_y, robot.answer.omega, robot.answer_status);
  }
}

void print_people(const dmrp_sample& sample) {
  for (std::uint32_t i = 0; i < sample.person_count; ++i) {
    const dmrp_person& person = *DMRP_AT(dmrp_person, sample.people, sample.person_stride, i);
    std::printf("person %llu %u %u %a %a %a %a %a %a %a %a %a %a %a %a %u\n",
                static_cast<unsigned long long>(person.id), person.group, person.target_id, person.position.x,
                person.position.y, person.velocity.x, person.velocity.y, person.radius_m, person.desired_speed,
                person.target.x, person.target.y, person.area_lower.x, person.area_lower.y, person.area_upper.x,
                person.area_upper.y, person.reaction);
  }
}

void print_contacts(const dmrp_sample& sample) {
  for (std::uint32_t i = 0; i < sample.contact_count; ++i) {
    const dmrp_contact& contact = *DMRP_AT(dmrp_contact, sample.contacts, sample.contact_stride, i);
    std::printf("contact %u %u %u %u %a %a %a %a\n", contact.kind, contact.flags, contact.a, contact.b, contact.depth_m,
                contact.point.x, contact.point.y, contact.impact_speed);
  }
}

void time_reading(const char* file) {
  std::size_t samples = 0;
  std::clock_t least = std::numeric_limits<std::clock_t>::max();
  for (int repetition = 0; repetition < 7; ++repetition) {
    const std::clock_t begin = std::clock();
    dmrp::core::TraceReader reader(dmrp::core::TraceRecords(file), dmrp::core::TraceExtent::everything);
    samples = 0;
    while (reader.next_sample()) ++samples;
    least = std::min(least, std::clock() - begin);
  }
  std::printf("%zu %.6f\n", samples, static_cast<double>(least) / CLOCKS_PER_SEC);
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc == 3 && std::strcmp(argv[1], "--time") == 0) {
    time_reading(argv[2]);
    return 0;
  }
  if (argc != 2) return 2;
  dmrp::core::TraceReader reader(dmrp::core::TraceRecords(argv[1]), dmrp::core::TraceExtent::samples);
  while (const dmrp_sample* sample = reader.next_sample()) {
    std::printf("sample %lld %lld %u\n", static_cast<long long>(sample->t_ns), static_cast<long long>(sample->dt_ns),
                sample->control_tick);
    print_robots(*sample);
    print_people(*sample);
    print_contacts(*sample);
  }
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "trace_dump: %s\n", error.what());
  return 1;
}
