// SPDX-License-Identifier: MIT
// A learned policy: a network with one hidden layer whose weights lie in a file beside the library. The library reads
// them once, and all robots share them.
#include <algorithm>
#include <array>
#include <cmath>
#include <dmrp/plugin.hpp>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/polyline.hpp>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

namespace toolkit = dmrp::toolkit;

// Two inputs (the bearing of the point ahead, the distance left), three hidden neurons, two outputs (speed and turn
// rate, as parts of the limits, never negative). Each neuron has a weight for each input and a bias.
struct Network {
  std::array<std::array<double, 3>, 3> hidden;
  std::array<std::array<double, 4>, 2> output;

  std::array<double, 2> operator()(double bearing, double left_m) const {
    std::array<double, 4> values = {0.0, 0.0, 0.0, 1.0};
    for (std::size_t i = 0; i < 3; ++i)
      values[i] = std::tanh(hidden[i][0] * bearing + hidden[i][1] * left_m + hidden[i][2]);
    std::array<double, 2> result = {0.0, 0.0};
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t j = 0; j < 4; ++j) result[i] += output[i][j] * values[j];
    return {std::max(0.0, result[0]), std::max(0.0, result[1])};
  }
};

Network read(const std::string& file) {
  std::ifstream in(file);
  Network network{};
  for (auto& neuron : network.hidden)
    for (double& weight : neuron) in >> weight;
  for (auto& neuron : network.output)
    for (double& weight : neuron) in >> weight;
  if (!in) throw std::runtime_error(file + ": 17 weights are expected");
  return network;
}

class LearnedPolicy final : public dmrp::LocalController {
 public:
  static dmrp::Descriptor describe() { return dmrp::Descriptor("org.example.policy", "Learned policy", "0.1.0"); }

  static void load(const dmrp::Host& host) {
    const std::string library = host.library_path();
    network = std::make_unique<Network>(read(library.substr(0, library.rfind('/') + 1) + "learned_policy.weights"));
    host.log(dmrp::LogLevel::info, "weights read");
  }
  static void unload() { network.reset(); }

  void set_path(dmrp::Path path, std::uint64_t) override {
    path_.assign(path.begin(), path.end());
    toolkit::arc_lengths(path_, arcs_);
  }

  dmrp::Status step(const dmrp::Observation& now, dmrp::Command& command) override {
    if (path_.empty()) return dmrp::Status::no_solution;
    const double end_m = arcs_.back();
    const dmrp::Vec2 ahead = toolkit::point_at(path_, arcs_, std::min(now.progress_m + 0.7, end_m));
    const double left_m = toolkit::distance(toolkit::position(now.pose), ahead);
    const double bearing = toolkit::difference(now.pose.theta, toolkit::bearing(now.pose, ahead));
    const auto [speed, turn] = (*network)(std::abs(bearing), left_m);
    command.v_x = speed * now.limits.v_max;
    command.omega = (bearing < 0.0 ? -turn : turn) * now.limits.omega_max;
    return dmrp::Status::ok;
  }

 private:
  static std::unique_ptr<const Network> network;
  std::vector<dmrp::Waypoint> path_;
  std::vector<double> arcs_;
};
std::unique_ptr<const Network> LearnedPolicy::network;

}  // namespace

DMRP_PLUGINS(LearnedPolicy)
