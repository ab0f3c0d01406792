// SPDX-License-Identifier: MIT
// bench_pedestrians: the number of people that the pedestrian models move per second of processor time, on one core.
//
//   pedestrian/MODEL/N    agent-steps/s of N people in crossing flows at 0.25 people/m2 among furniture
//
// Times only the models' step(), through the plugins' C entry. Best of three parts of the same walk.
#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "tests/bench/bench_pedestrians_crowd.hpp"
#include "tests/bench/bench_rows.hpp"

namespace {

using namespace dmrp::bench;

constexpr std::uint32_t people_at_least = 1000;          // small crowds are measured several at a time
constexpr std::uint32_t agent_steps_at_least = 150'000;  // in a part
constexpr int parts = 3;
constexpr int warm_up_steps = 25;

using Crowds = std::vector<std::unique_ptr<CrossingCrowd>>;

double seconds_of_step(Crowds& crowds) {
  const double start_s = processor_s();
  for (const auto& crowd : crowds) crowd->step_model();
  const double used_s = processor_s() - start_s;
  for (const auto& crowd : crowds) crowd->move();
  return used_s;
}

double agent_steps_per_second(const std::string& model, std::uint32_t people, bool quick) {
  const Square square(people);
  Crowds crowds;
  for (std::uint32_t i = 0; i * people < people_at_least; ++i)
    crowds.push_back(std::make_unique<CrossingCrowd>(square, "dmrp.pedestrian." + model, i + 1));
  const auto agents = static_cast<std::uint32_t>(crowds.size()) * people;
  const std::uint32_t steps = quick ? 1 : std::max(agent_steps_at_least / agents, 1u);

  for (int i = 0; i < warm_up_steps; ++i) seconds_of_step(crowds);
  double best = 0.0;
  for (int part = 0; part < (quick ? 1 : parts); ++part) {
    double used_s = 0.0;
    for (std::uint32_t i = 0; i < steps; ++i) used_s += seconds_of_step(crowds);
    best = std::max(best, static_cast<double>(steps) * agents / used_s);
  }
  return best;
}

}  // namespace

int main(int argc, char** argv) {
  const Output output = output_options(argc, argv);
  std::vector<Row> rows;
  for (const char* model : {"social_force", "orca", "collision_free_speed"})
    for (const std::uint32_t people : {10u, 100u, 1000u, 10000u})
      if (!output.quick || people <= 100)
        rows.push_back({"pedestrian/" + std::string(model) + "/" + std::to_string(people),
                        agent_steps_per_second(model, people, output.quick), "agent-steps/s"});
  write_rows(rows, output);
  return 0;
}
