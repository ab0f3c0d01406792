// SPDX-License-Identifier: MIT
// The banded solvers against dense ones from Eigen, and least-squares problems with known solutions.
#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/random.hpp>

#include "controllers/motion/levenberg_marquardt.hpp"

namespace banded_ldlt_test {

using namespace dmrp::controllers;

constexpr std::size_t bandwidth = 5;

struct Random {
  dmrp::toolkit::Stream stream;
  double operator()() { return 2.0 * stream.uniform() - 1.0; }
};

// Diagonally dominant with given signs of the diagonal: positive definite, or quasi-definite if the signs differ; then
// only rows of equal sign need to be dominant among themselves.
BandedMatrix<bandwidth> random_matrix(std::size_t size, Random& random, bool quasi_definite) {
  BandedMatrix<bandwidth> a;
  a.resize(size);
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t j = i > bandwidth ? i - bandwidth : 0; j < i; ++j) a.at(i, j) = random();
    const double sign = quasi_definite && i % 3 == 2 ? -1.0 : 1.0;
    a.at(i, i) = sign * (2.0 * bandwidth + 1.0 + random());
  }
  return a;
}

Eigen::MatrixXd dense(const BandedMatrix<bandwidth>& a) {
  const auto size = static_cast<Eigen::Index>(a.size());
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(size, size);
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = i > bandwidth ? i - bandwidth : 0; j <= i; ++j)
      full(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          full(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(i)) = a.at(i, j);
  return full;
}

std::vector<double> random_vector(std::size_t size, Random& random) {
  std::vector<double> v(size);
  for (double& x : v) x = random();
  return v;
}

Eigen::VectorXd eigen(const std::vector<double>& v) {
  return Eigen::Map<const Eigen::VectorXd>(v.data(), static_cast<Eigen::Index>(v.size()));
}

double largest_difference(const std::vector<double>& ours, const Eigen::VectorXd& theirs) {
  return (eigen(ours) - theirs).cwiseAbs().maxCoeff();
}

TEST_CASE("The solution of a banded system agrees with a dense one") {
  const std::size_t size = GENERATE(1, 2, 5, 6, 7, 40, 123);
  const bool quasi_definite = GENERATE(false, true);
  const double shift = GENERATE(0.0, 0.7);
  CAPTURE(size, quasi_definite, shift);
  Random random{dmrp::toolkit::Stream(size, "band")};
  const BandedMatrix<bandwidth> a = random_matrix(size, random, quasi_definite);
  const std::vector<double> b = random_vector(size, random);
  const Eigen::MatrixXd full =
      dense(a) + shift * Eigen::MatrixXd::Identity(static_cast<Eigen::Index>(size), static_cast<Eigen::Index>(size));

  BandedLdlt<bandwidth> ldlt;
  REQUIRE(ldlt.factor(a, shift));
  std::vector<double> x = b;
  ldlt.solve(x);
  CHECK(largest_difference(x, full.fullPivLu().solve(eigen(b))) < 1e-12);

  // Sylvester: as many negative pivots as negative eigenvalues
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigenvalues(full);
  CHECK(static_cast<Eigen::Index>(ldlt.negative_pivots()) == (eigenvalues.eigenvalues().array() < 0.0).count());

  std::vector<double> product;
  a.multiply(x, product);
  CHECK(largest_difference(product, dense(a) * eigen(x)) < 1e-12);
}

TEST_CASE("Singular matrices and matrices that are not finite are refused") {
  BandedMatrix<bandwidth> a;
  a.resize(3);
  BandedLdlt<bandwidth> ldlt;
  CHECK_FALSE(ldlt.factor(a));
  CHECK(ldlt.factor(a, 1.0));
  a.at(1, 1) = std::nan("");
  CHECK_FALSE(ldlt.factor(a, 1.0));
}

// Rosenbrock's valley as a chain: r = 10 (x_{i+1} - x_i^2), 1 - x_i. The minimum is 0 at ones.
struct Valley {
  std::vector<double> x;
  std::vector<double> kept = x;
  int linearised = 0;

  double cost() const {
    double sum = 0.0;
    for (std::size_t i = 0; i + 1 < x.size(); ++i) {
      const double bend = 10.0 * (x[i + 1] - x[i] * x[i]);
      sum += bend * bend + (1.0 - x[i]) * (1.0 - x[i]);
    }
    return 0.5 * sum;
  }
  double linearise(BandedMatrix<1>& h, std::vector<double>& g) {
    ++linearised;
    h.resize(x.size());
    g.assign(x.size(), 0.0);
    for (std::size_t i = 0; i + 1 < x.size(); ++i) {
      const double bend = 10.0 * (x[i + 1] - x[i] * x[i]);
      const double slope = -20.0 * x[i];
      h.at(i, i) += slope * slope + 1.0;
      h.at(i + 1, i) += slope * 10.0;
      h.at(i + 1, i + 1) += 100.0;
      g[i] += slope * bend - (1.0 - x[i]);
      g[i + 1] += 10.0 * bend;
    }
    return cost();
  }
  double try_step(const std::vector<double>& step) {
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = kept[i] + step[i];
    return cost();
  }
  void keep() { kept = x; }
  void restore() { x = kept; }
};

TEST_CASE("Levenberg-Marquardt finds the minimum of a curved valley") {
  Valley valley{{-1.2, 1.0}};
  LevenbergMarquardt<1> solver;
  const LevenbergMarquardtResult result = solver.minimise(valley, {200, 10, 1e-5, 0.0, 1e-12});
  CHECK(result.is_finite);
  CHECK(result.cost < 1e-20);
  CHECK(result.cost == valley.cost());
  for (const double x : valley.x) CHECK(x == Approx(1.0));
}

TEST_CASE("Levenberg-Marquardt never raises the cost and respects the iteration limit") {
  Valley valley{{-1.2, 1.0}};
  LevenbergMarquardt<1> solver;
  double cost = valley.cost();
  for (int round = 0; round < 20; ++round) {
    valley.linearised = 0;
    const LevenbergMarquardtResult result = solver.minimise(valley, {2, 10, 1e-5, 0.0, 1e-12});
    CHECK(result.first_cost == cost);
    CHECK(result.cost <= cost);
    CHECK(result.cost == valley.cost());
    CHECK(valley.linearised <= 2);
    cost = result.cost;
  }
  CHECK(cost < 1e-3);
}

TEST_CASE("Levenberg-Marquardt fits a straight line in at most two iterations") {
  // linear least squares: the first step is nearly exact, the second ends the iteration
  struct Line {
    double x = 5.0, kept = 5.0;
    double linearise(BandedMatrix<1>& h, std::vector<double>& g) {
      h.resize(1);
      h.at(0, 0) = 4.0;
      g.assign(1, 4.0 * (x - 3.0));
      return 2.0 * (x - 3.0) * (x - 3.0);
    }
    double try_step(const std::vector<double>& step) {
      x = kept + step[0];
      return 2.0 * (x - 3.0) * (x - 3.0);
    }
    void keep() { kept = x; }
    void restore() { x = kept; }
  } line;
  LevenbergMarquardt<1> solver;
  const LevenbergMarquardtResult result = solver.minimise(line, {10, 10, 1e-5, 0.0, 1e-3});
  CHECK(line.x == Approx(3.0).epsilon(1e-4));
  CHECK(result.iterations <= 2);
}

}  // namespace banded_ldlt_test
