// SPDX-License-Identifier: MIT
// The MPC's interior point method against IPOPT: the same programs, the same warm starts.
#include <IpIpoptApplication.hpp>
#include <IpTNLP.hpp>
#include <catch2/catch.hpp>
#include <cmath>

#include "controllers/mpc/interior_point.hpp"
#include "tests/unit/controllers/mpc/recorded_problems.hpp"

namespace ipopt_test {

using namespace dmrp::controllers::mpc;
using namespace dmrp::test;
using Ipopt::Index;
using Ipopt::Number;

// A Problem in IPOPT's form. Variables: the states except the first, the controls, dt, an excess for every elastic
// constraint, and over and under for the three terminal components. Constraints: the transitions, the stages'
// constraints, the terminal condition.
class Program final : public Ipopt::TNLP {
 public:
  Program(const Problem& problem, const Trajectory& start) : problem_(problem), trajectory_(start) {
    stages_ = start.size();
    for (std::size_t k = 0; k < stages_; ++k) {
      StageVector w = problem_.stage(trajectory_, k);
      std::vector<Constraint> constraints(problem_.constraint_count(stages_, k));
      problem_.constraints(stages_, k, w, constraints.data());
      for (const Constraint& c : constraints) {
        excess_of_.push_back(c.is_elastic ? excesses_++ : -1);
        stage_of_.push_back(k);
      }
    }
  }

  const Trajectory& solution() const { return trajectory_; }

  bool get_nlp_info(Index& n, Index& m, Index& jacobian, Index& hessian, IndexStyleEnum& style) override {
    n = variables();
    m = rows();
    jacobian = 0, hessian = 0;
    visit_jacobian([&](Index, Index, Number) { ++jacobian; });
    visit_hessian(0.0, nullptr, [&](Index, Index, Number) { ++hessian; });
    style = C_STYLE;
    return true;
  }

  bool get_bounds_info(Index n, Number* lower, Number* upper, Index m, Number* g_lower, Number* g_upper) override {
    for (Index i = 0; i < n; ++i) {
      lower[i] = i > dt_index() ? 0.0 : -2e19;
      upper[i] = 2e19;
    }
    for (Index i = 0; i < m; ++i) {
      const bool is_equation = i < transition_rows() || i >= m - 3;
      g_lower[i] = is_equation ? 0.0 : -2e19;
      g_upper[i] = 0.0;
    }
    return true;
  }

  bool get_starting_point(Index, bool, Number* x, bool, Number*, Number*, Index, bool, Number*) override {
    for (std::size_t k = 1; k < stages_; ++k) {
      x[state_index(k)] = trajectory_.states[k].x;
      x[state_index(k) + 1] = trajectory_.states[k].y;
      x[state_index(k) + 2] = trajectory_.states[k].theta;
    }
    for (std::size_t k = 0; k + 1 < stages_; ++k) {
      x[control_index(k)] = trajectory_.controls[k].v;
      x[control_index(k) + 1] = trajectory_.controls[k].omega;
    }
    x[dt_index()] = trajectory_.dt_s;
    const std::vector<Constraint> constraints = evaluate();
    for (std::size_t i = 0; i < constraints.size(); ++i)
      if (excess_of_[i] >= 0) x[excess_index(excess_of_[i])] = std::max(0.0, constraints[i].value);
    const auto error = problem_.terminal_error(trajectory_.states.back());
    for (std::size_t i = 0; i < 3; ++i) {
      x[terminal_index(i)] = std::max(0.0, error[i]);
      x[terminal_index(i) + 1] = std::max(0.0, -error[i]);
    }
    return true;
  }

  bool eval_f(Index, const Number* x, bool, Number& value) override {
    value = static_cast<double>(stages_ - 1) * x[dt_index()];
    for (Index i = 0; i < excesses_; ++i) value += problem_.obstacle_weight * x[excess_index(i)];
    for (std::size_t i = 0; i < 3; ++i) value += terminal_weight(i) * (x[terminal_index(i)] + x[terminal_index(i) + 1]);
    return true;
  }

  bool eval_grad_f(Index n, const Number*, bool, Number* gradient) override {
    std::fill(gradient, gradient + n, 0.0);
    gradient[dt_index()] = static_cast<double>(stages_ - 1);
    for (Index i = 0; i < excesses_; ++i) gradient[excess_index(i)] = problem_.obstacle_weight;
    for (std::size_t i = 0; i < 3; ++i)
      gradient[terminal_index(i)] = gradient[terminal_index(i) + 1] = terminal_weight(i);
    return true;
  }

  bool eval_g(Index, const Number* x, bool, Index, Number* g) override {
    read(x);
    for (std::size_t k = 0; k + 1 < stages_; ++k) {
      const Transition t = problem_.transition(problem_.stage(trajectory_, k), trajectory_.states[k + 1]);
      for (const double defect : t.defect) *g++ = defect;
    }
    const std::vector<Constraint> constraints = evaluate();
    for (std::size_t i = 0; i < constraints.size(); ++i)
      *g++ = constraints[i].value - (excess_of_[i] >= 0 ? x[excess_index(excess_of_[i])] : 0.0);
    const auto error = problem_.terminal_error(trajectory_.states.back());
    for (std::size_t i = 0; i < 3; ++i) *g++ = error[i] - x[terminal_index(i)] + x[terminal_index(i) + 1];
    return true;
  }

  bool eval_jac_g(Index, const Number* x, bool, Index, Index, Index* row, Index* column, Number* values) override {
    if (x) read(x);
    visit_jacobian([&](Index r, Index c, Number value) {
      if (values)
        *values++ = value;
      else
        *row++ = r, *column++ = c;
    });
    return true;
  }

  bool eval_h(Index, const Number* x, bool, Number objective, Index, const Number* lambda, bool, Index, Index* row,
              Index* column, Number* values) override {
    static_cast<void>(objective);  // linear
    if (x) read(x);
    visit_hessian(1.0, lambda, [&](Index r, Index c, Number value) {
      if (values)
        *values++ = value;
      else
        *row++ = std::max(r, c), *column++ = std::min(r, c);
    });
    return true;
  }

  void finalize_solution(Ipopt::SolverReturn, Index, const Number* x, const Number*, const Number*, Index,
                         const Number*, const Number*, Number, const Ipopt::IpoptData*,
                         Ipopt::IpoptCalculatedQuantities*) override {
    read(x);
  }

 private:
  Index state_index(std::size_t k) const { return 3 * (static_cast<Index>(k) - 1); }
  Index control_index(std::size_t k) const { return transition_rows() + 2 * static_cast<Index>(k); }
  Index transition_rows() const { return 3 * (static_cast<Index>(stages_) - 1); }
  Index dt_index() const { return control_index(stages_ - 1); }
  Index excess_index(Index i) const { return dt_index() + 1 + i; }
  Index terminal_index(std::size_t i) const { return excess_index(excesses_) + 2 * static_cast<Index>(i); }
  Index variables() const { return terminal_index(3); }
  Index rows() const { return transition_rows() + static_cast<Index>(stage_of_.size()) + 3; }
  double terminal_weight(std::size_t i) const { return std::max(problem_.terminal_weights()[i], 1e-3); }

  // The variable of an entry of a stage vector; -1 if the entry is fixed.
  Index index_of(std::size_t k, std::size_t entry) const {
    if (entry == at_dt) return dt_index();
    if (entry == at_v || entry == at_omega)
      return k + 1 < stages_ ? control_index(k) + static_cast<Index>(entry - at_v) : -1;
    if (k == 0) return -1;
    if (entry < 3) return state_index(k) + static_cast<Index>(entry);
    return control_index(k - 1) + static_cast<Index>(entry - at_v_before);
  }

  void read(const Number* x) {
    for (std::size_t k = 1; k < stages_; ++k)
      trajectory_.states[k] = {x[state_index(k)], x[state_index(k) + 1], x[state_index(k) + 2]};
    for (std::size_t k = 0; k + 1 < stages_; ++k)
      trajectory_.controls[k] = {x[control_index(k)], x[control_index(k) + 1]};
    trajectory_.dt_s = x[dt_index()];
  }

  std::vector<Constraint> evaluate() const {
    std::vector<Constraint> all(stage_of_.size());
    Constraint* next = all.data();
    for (std::size_t k = 0; k < stages_; ++k) {
      problem_.constraints(stages_, k, problem_.stage(trajectory_, k), next);
      next += problem_.constraint_count(stages_, k);
    }
    return all;
  }

  // The sparsity pattern, the same at all points: all entries that may be nonzero.
  template <class Visit>
  void visit_jacobian(Visit visit) const {
    for (std::size_t k = 0; k + 1 < stages_; ++k) {
      const Transition t = problem_.transition(problem_.stage(trajectory_, k), trajectory_.states[k + 1]);
      const Index row = 3 * static_cast<Index>(k);
      const auto entry = [&](Index r, std::size_t e, double value) {
        if (index_of(k, e) >= 0) visit(row + r, index_of(k, e), value);
      };
      for (Index d = 0; d < 3; ++d) {
        entry(d, static_cast<std::size_t>(d), 1.0);
        visit(row + d, state_index(k + 1) + d, -1.0);
      }
      entry(0, at_theta, t.x_by_theta), entry(0, at_dt, t.x_by_dt), entry(0, at_v, t.x_by_v);
      entry(1, at_theta, t.y_by_theta), entry(1, at_dt, t.y_by_dt), entry(1, at_v, t.y_by_v);
      entry(2, at_dt, t.theta_by_dt), entry(2, at_omega, t.theta_by_omega);
    }
    const std::vector<Constraint> constraints = evaluate();
    for (std::size_t i = 0; i < constraints.size(); ++i) {
      const Index row = transition_rows() + static_cast<Index>(i);
      for (std::size_t e = 0; e < stage_size; ++e)
        if (index_of(stage_of_[i], e) >= 0) visit(row, index_of(stage_of_[i], e), constraints[i].gradient[e]);
      if (excess_of_[i] >= 0) visit(row, excess_index(excess_of_[i]), -1.0);
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const Index row = rows() - 3 + static_cast<Index>(i);
      const bool counts = i < 2 || problem_.fixes_heading;
      visit(row, state_index(stages_ - 1) + static_cast<Index>(i), counts ? 1.0 : 0.0);
      visit(row, terminal_index(i), -1.0);
      visit(row, terminal_index(i) + 1, 1.0);
    }
  }

  template <class Visit>
  void visit_hessian(double scale, const Number* lambda, Visit visit) const {
    const std::vector<Constraint> constraints = evaluate();
    std::size_t next = 0;
    for (std::size_t k = 0; k < stages_; ++k) {
      StageMatrix hessian = {};
      if (lambda && k + 1 < stages_)
        problem_.add_transition_curvature(problem_.stage(trajectory_, k), lambda + 3 * k, hessian);
      for (; next < stage_of_.size() && stage_of_[next] == k; ++next) {
        const Constraint& c = constraints[next];
        const double bend = lambda ? -lambda[static_cast<std::size_t>(transition_rows()) + next] * c.curvature : 0.0;
        constexpr std::size_t entries[] = {at_x, at_y, at_dt};
        for (std::size_t a = 0; a < 3; ++a)
          for (std::size_t b = a; b < 3; ++b) hessian[entries[a]][entries[b]] += bend * c.tangent[a] * c.tangent[b];
      }
      for (std::size_t i = 0; i < stage_size; ++i)
        for (std::size_t j = i; j < stage_size; ++j)
          if (index_of(k, i) >= 0 && index_of(k, j) >= 0) visit(index_of(k, i), index_of(k, j), scale * hessian[i][j]);
    }
  }

  const Problem& problem_;
  Trajectory trajectory_;
  std::size_t stages_ = 0;
  Index excesses_ = 0;
  std::vector<Index> excess_of_;       // of each constraint; -1 where it is not elastic
  std::vector<std::size_t> stage_of_;  // likewise
};

// The trajectory that IPOPT converges to; empty if it does not converge.
Trajectory solve_by_ipopt(const Problem& problem, const Trajectory& start, bool is_warm) {
  Ipopt::SmartPtr<Ipopt::IpoptApplication> ipopt = new Ipopt::IpoptApplication();
  ipopt->Options()->SetIntegerValue("print_level", 0);
  ipopt->Options()->SetStringValue("sb", "yes");
  ipopt->Options()->SetNumericValue("tol", 1e-6);
  ipopt->Options()->SetIntegerValue("max_iter", 500);
  ipopt->Options()->SetNumericValue("mu_init", is_warm ? 1e-2 : 1e-1);
  if (ipopt->Initialize() != Ipopt::Solve_Succeeded) return {};
  Ipopt::SmartPtr<Program> program = new Program(problem, start);
  const Ipopt::ApplicationReturnStatus status = ipopt->OptimizeTNLP(Ipopt::SmartPtr<Ipopt::TNLP>(GetRawPtr(program)));
  return status == Ipopt::Solve_Succeeded ? program->solution() : Trajectory{};
}

TEST_CASE("At least 95 of 100 recorded problems are solved as well as by IPOPT") {
  int converged = 0;
  int as_good = 0;
  InteriorPoint solver;
  for (const RecordedProblem& recorded : record_problems(1, 100)) {
    const Trajectory reference = solve_by_ipopt(recorded.problem, recorded.start, recorded.is_warm);
    if (reference.states.empty()) continue;
    ++converged;
    Trajectory own = recorded.start;
    SolverSettings settings;
    if (recorded.is_warm) settings.barrier_start = 1e-2;
    solver.solve(recorded.problem, settings, own);
    const double cost = recorded.problem.cost(own);
    const double reference_cost = recorded.problem.cost(reference);
    const bool is_as_good = cost <= 1.01 * reference_cost && recorded.problem.violation(own) < 1e-3;
    if (!is_as_good)
      WARN("own cost " << cost << " s, violation " << recorded.problem.violation(own) << "; IPOPT " << reference_cost);
    as_good += is_as_good;
  }
  INFO(as_good << " of " << converged << " on which IPOPT converges");
  CHECK(converged >= 80);
  CHECK(as_good >= 0.95 * converged);
}

}  // namespace ipopt_test
