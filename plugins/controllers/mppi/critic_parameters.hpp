// SPDX-License-Identifier: MIT
// critic_parameters.hpp: how a critic declares its parameters, and what its weight and power do.
#pragma once

#include <string>

#include "controllers/mppi/critics.hpp"

namespace dmrp::controllers::mppi {

// A parameter that is read as a float.
struct Number {
  Param<double> value;

  operator float() const { return static_cast<float>(*value); }
};

// Adds costs, raised to a power, to the samples of a block.
inline void add_raised(CriticData& data, int block, const Lanes& costs, int power) {
  Lanes product = costs;
  for (int i = 1; i < power; ++i) product *= costs;
  Eigen::Map<Lanes>(data.costs.data() + block * lanes) += product;
}

// How much a critic counts, and the power to which its weighted cost is raised.
struct Weight {
  Param<int> power;
  Number factor;

  void add(CriticData& data, int block, const Lanes& values) const {
    add_raised(data, block, static_cast<float>(factor) * values, power);
  }

  // Adds the sum of term(block, step) over the steps.
  template <class Term>
  void add_sums(CriticData& data, const Term& term) const {
    for (int block = 0; block < data.batch.blocks; ++block) {
      Lanes sums = Lanes::Zero();
      for (int i = 0; i < data.batch.steps; ++i) sums += term(block, i);
      add(data, block, sums);
    }
  }
};

// Declares the parameters of one critic.
struct Declare {
  ParameterTable& table;
  std::string critic;

  ParamBuilder<bool> flag(const char* key, bool value, const char* doc) const {
    return ParamBuilder<bool>(table, full(key).c_str(), value).doc(doc);
  }
  ParamBuilder<std::int64_t> count(const char* key, std::int64_t value, int least, int most, const char* doc) const {
    return ParamBuilder<std::int64_t>(table, full(key).c_str(), value).unit("1").range(least, most).doc(doc);
  }
  Number number(const char* key, double value, double most, const char* doc, const char* unit = "1") const {
    return {ParamBuilder<double>(table, full(key).c_str(), value).unit(unit).range(0.0, most).doc(doc)};
  }
  Number goal_distance(const char* key, double value_m, const char* doc) const {
    return number(key, value_m, 20.0, doc, "m");
  }
  Number nearer_than(double value_m) const {
    return goal_distance("threshold_to_consider", value_m, "it counts nearer to the goal than this");
  }
  Number farther_than(double value_m) const {
    return goal_distance("threshold_to_consider", value_m, "it counts farther from the goal than this");
  }
  ParamBuilder<std::int64_t> power(const std::string& what) const {
    return count("cost_power", 1, 1, 10, ("power of the cost of " + what).c_str());
  }
  Weight weight(double value, const std::string& what) const {
    return {power(what), number("cost_weight", value, 10000.0, "weight of it")};
  }
  std::string full(const char* key) const { return critic + '_' + key; }
};

}  // namespace dmrp::controllers::mppi
