// SPDX-License-Identifier: MIT
// STO, IBTR, LDF and clearance of random trials, compared with the plainest implementations of their definitions.
#include <algorithm>
#include <catch2/catch.hpp>
#include <dmrp/toolkit/random.hpp>

#include "tests/unit/metrics/synthetic_trial.hpp"

namespace brute_force_test {

using namespace dmrp::test;
using dmrp::toolkit::Stream;

double distance(dmrp_vec2 a, dmrp_vec2 b) {
  return std::sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y));
}

// Robots at random positions that sometimes crawl and arrive at different times; steps of one second or less.
struct RandomTrial {
  std::vector<double> times_s;
  std::vector<std::vector<dmrp_robot_sample>> samples;
  std::vector<Points> paths;

  explicit RandomTrial(Stream stream) {
    const std::size_t robots = 1 + stream.below(5);
    const std::size_t count = 2 + stream.below(60);
    std::vector<std::size_t> arrival;
    for (std::size_t robot = 0; robot < robots; ++robot) arrival.push_back(1 + stream.below(80));
    double t_s = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      times_s.push_back(t_s);
      t_s += 0.02 * static_cast<double>(1 + stream.below(30));
      samples.emplace_back();
      for (std::size_t robot = 0; robot < robots; ++robot) {
        const double speed = stream.chance(0.5) ? stream.uniform(0.0, 0.1) : stream.uniform(0.3, 0.8);
        samples.back().push_back(at(stream.uniform(0.0, 4.0), stream.uniform(0.0, 4.0), speed,
                                    i < arrival[robot] ? DMRP_ROBOT_ACTIVE : DMRP_ROBOT_FINISHED));
      }
    }
    for (std::size_t robot = 0; robot < robots; ++robot) {
      paths.push_back({{static_cast<double>(stream.below(4)), static_cast<double>(stream.below(4))}});
      const std::size_t steps = stream.below(15);
      for (std::size_t step = 0; step < steps; ++step) {
        dmrp_vec2 next = paths.back().back();
        const std::uint64_t move = stream.below(5);  // four directions and a wait
        if (move < 2) next.x += move == 0 ? 1.0 : -1.0;
        if (move == 2 || move == 3) next.y += move == 2 ? 1.0 : -1.0;
        paths.back().push_back(next);
      }
    }
  }

  SyntheticTrial trial() const {
    SyntheticTrial out(paths.size());
    out.plan(paths);
    for (std::size_t i = 0; i < times_s.size(); ++i) out.sample(times_s[i], samples[i]);
    out.end(times_s.back());
    return out;
  }
  dmrp_vec2 place(std::size_t i, std::size_t robot) const {
    return {samples[i][robot].pose.x, samples[i][robot].pose.y};
  }
  bool active(std::size_t i, std::size_t robot) const { return samples[i][robot].state == DMRP_ROBOT_ACTIVE; }
  std::size_t robots() const { return paths.size(); }
};

double sto_by_definition(const RandomTrial& random, double reach_m, int window) {
  double sum = 0.0;
  for (std::size_t robot = 0; robot < random.robots(); ++robot) {
    Points own = random.paths[robot];
    while (own.size() > 1 && distance(own.back(), own[own.size() - 2]) == 0.0) own.pop_back();
    int overlapping = 0;
    for (int i = 0; i < static_cast<int>(own.size()); ++i) {
      bool near = false;
      for (std::size_t other = 0; other < random.robots(); ++other) {
        for (int j = std::max(0, i - window); j <= i + window && other != robot; ++j) {
          const Points& path = random.paths[other];
          near |= distance(own[i], path[std::min<std::size_t>(j, path.size() - 1)]) <= reach_m;
        }
      }
      overlapping += near;
    }
    sum += static_cast<double>(overlapping) / static_cast<double>(own.size());
  }
  return sum / static_cast<double>(random.robots());
}

struct Blocking {
  double share, pair_sum;  // percent
};

Blocking ibtr_by_definition(const RandomTrial& random, double reach_m, double fraction) {
  std::vector<double> thresholds;
  for (std::size_t robot = 0; robot < random.robots(); ++robot) {
    double way = 0.0, time = 0.0;
    for (std::size_t i = 1; i < random.times_s.size(); ++i) {
      if (!random.active(i - 1, robot)) continue;
      const double dt = random.times_s[i] - random.times_s[i - 1];
      way += random.samples[i][robot].velocity.v_x * dt;
      time += dt;
    }
    thresholds.push_back(fraction * way / time);
  }
  double blocked = 0.0, pair_sum = 0.0;
  for (std::size_t i = 1; i < random.times_s.size(); ++i) {
    const double dt = random.times_s[i] - random.times_s[i - 1];
    int pairs = 0;
    const auto crawls = [&](std::size_t robot) {
      return random.active(i - 1, robot) && random.samples[i][robot].velocity.v_x < thresholds[robot];
    };
    for (std::size_t a = 0; a < random.robots(); ++a)
      for (std::size_t b = a + 1; b < random.robots(); ++b)
        pairs += crawls(a) && crawls(b) && distance(random.place(i, a), random.place(i, b)) <= reach_m;
    if (pairs > 0) blocked += dt;
    pair_sum += pairs * dt;
  }
  return {100.0 * blocked / random.times_s.back(), 100.0 * pair_sum / random.times_s.back()};
}

// Over the samples that represent 0, 1, 2, ... s; active_only: among active robots, while active.
double ldf_by_definition(const RandomTrial& random, double reach_m, bool active_only) {
  double largest = -1.0;
  for (std::size_t robot = 0; robot < random.robots(); ++robot) {
    std::vector<double> counts;
    for (int second = 0; nanoseconds(second) <= nanoseconds(random.times_s.back()); ++second) {
      std::size_t i = 0;
      while (nanoseconds(random.times_s[i]) < nanoseconds(second)) ++i;
      if (active_only && !random.active(i, robot)) continue;
      double neighbours = 0.0;
      for (std::size_t other = 0; other < random.robots(); ++other)
        neighbours += other != robot && (!active_only || random.active(i, other)) &&
                      distance(random.place(i, robot), random.place(i, other)) <= reach_m;
      counts.push_back(neighbours);
    }
    double mean = 0.0, variance = 0.0;
    for (const double count : counts) mean += count / static_cast<double>(counts.size());
    for (const double count : counts) variance += (count - mean) * (count - mean) / static_cast<double>(counts.size());
    if (!counts.empty()) largest = std::max(largest, variance);
  }
  return largest;
}

TEST_CASE("STO, IBTR and LDF agree with their definitions on random trials") {
  int with_overlap = 0, with_blocking = 0, with_several_pairs = 0;
  for (int i = 0; i < 300; ++i) {
    INFO("random trial " << i);
    Stream stream(1, "metrics.brute_force", i);
    const RandomTrial random(stream);
    const SyntheticTrial trial = random.trial();

    const double sto = measure("dmrp.metric.sto", trial).system("sto");
    CHECK(sto == Approx(sto_by_definition(random, 0.5, 2)).margin(1e-12));

    const Measurement ibtr = measure("dmrp.metric.ibtr", trial);
    const Blocking blocking = ibtr_by_definition(random, 2.0, 0.2);
    CHECK(ibtr.system("ibtr") == Approx(blocking.share).margin(1e-9));
    CHECK(ibtr.system("ibtr_pair_sum") == Approx(blocking.pair_sum).margin(1e-9));

    const Measurement ldf = measure("dmrp.metric.ldf", trial);
    CHECK(ldf.system("ldf") == Approx(ldf_by_definition(random, 2.0, false)).margin(1e-12));
    CHECK(ldf.system("ldf_active") == Approx(ldf_by_definition(random, 2.0, true)).margin(1e-12));

    with_overlap += sto > 0.0;
    with_blocking += blocking.share > 0.0;
    with_several_pairs += blocking.pair_sum > 1.001 * blocking.share;
  }
  // enough trials have events
  CHECK(with_overlap > 50);
  CHECK(with_blocking > 50);
  CHECK(with_several_pairs > 50);
}

// 30 robots that wander, and now and then jump, in a square of 20 m.
std::vector<std::vector<dmrp_robot_sample>> wander(Stream& stream) {
  const std::size_t robots = 30;
  std::vector<std::vector<dmrp_robot_sample>> samples(1);
  for (std::size_t robot = 0; robot < robots; ++robot)
    samples[0].push_back(at(stream.uniform(0.0, 20.0), stream.uniform(0.0, 20.0)));
  for (int i = 1; i < 60; ++i) {
    samples.push_back(samples.back());
    for (dmrp_robot_sample& robot : samples.back()) {
      const double reach_m = stream.chance(0.002) ? 10.0 : 0.1;
      robot.pose.x += stream.uniform(-reach_m, reach_m);
      robot.pose.y += stream.uniform(-reach_m, reach_m);
    }
  }
  return samples;
}

TEST_CASE("clearance to robots is that of the nearest of all") {
  for (int i = 0; i < 20; ++i) {
    INFO("random trial " << i);
    Stream stream(1, "metrics.clearance", i);
    const auto samples = wander(stream);
    SyntheticTrial trial(samples[0].size());
    for (std::size_t k = 0; k < samples.size(); ++k) trial.sample(0.1 * static_cast<double>(k), samples[k]);
    trial.end(0.1 * static_cast<double>(samples.size() - 1));
    const Measurement clearance = measure("dmrp.metric.clearance", trial);
    for (std::size_t robot = 0; robot < samples[0].size(); ++robot) {
      double sum = 0.0;
      for (std::size_t k = 1; k < samples.size(); ++k) {
        double nearest = 1e9;
        for (std::size_t other = 0; other < samples[k].size(); ++other) {
          const dmrp_pose &a = samples[k][robot].pose, &b = samples[k][other].pose;
          if (other != robot) nearest = std::min(nearest, distance({a.x, a.y}, {b.x, b.y}) - 0.5);
        }
        sum += nearest;
      }
      CHECK(clearance.robot("clearance_robot_mean", robot) ==
            Approx(sum / static_cast<double>(samples.size() - 1)).margin(1e-12));
    }
  }
}

}  // namespace brute_force_test
