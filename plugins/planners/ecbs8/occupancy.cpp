// SPDX-License-Identifier: MIT
#include "planners/ecbs8/occupancy.hpp"

#include <new>

namespace dmrp::planners::ecbs8 {

namespace {

constexpr std::int32_t nobody_rests = INT32_MAX;

}  // namespace

Occupancy::Occupancy(const Graph& graph, std::size_t agent_count)
    : graph_(graph),
      location_count_(static_cast<std::size_t>(graph.location_count())),
      links_(agent_count),
      rest_time_(location_count_, nobody_rests),
      rest_agent_(location_count_, -1),
      paths_(agent_count),
      met_at_(agent_count, -1) {
  add_rows(1);
}

Occupancy::Step Occupancy::step_of(Location from, Location to, Direction d) const {
  if (!Graph::is_diagonal(d)) return {from, to, false, {nowhere, nowhere}};
  return {from, to, true, graph_.beside(from, d)};
}

Occupancy::Step Occupancy::step_of(PathView path, std::int32_t t) const {
  const Location from = location_at(path, t - 1);
  const Location to = location_at(path, t);
  const std::int32_t from_column = graph_.column(from);
  const std::int32_t to_column = graph_.column(to);
  const std::int32_t from_row = graph_.row(from);
  const std::int32_t to_row = graph_.row(to);
  if (from_column == to_column || from_row == to_row) return {from, to, false, {nowhere, nowhere}};
  return {from, to, true, {graph_.at(to_column, from_row), graph_.at(from_column, to_row)}};
}

void Occupancy::set(std::int32_t agent, PathView path) {
  PathView& known = paths_[static_cast<std::size_t>(agent)];
  if (known.data() == path.data() && known.size() == path.size()) return;
  if (!known.empty()) take_out(agent);
  known = path;
  if (!path.empty()) put_in(agent, path);
}

// Uses calloc(), with which the system clears large blocks page by page on first use. Most cells are never used.
void Occupancy::add_rows(std::int32_t count) {
  const std::size_t cells = static_cast<std::size_t>(count) * location_count_;
  blocks_.emplace_back(static_cast<Cell*>(std::calloc(std::max<std::size_t>(cells, 1), sizeof(Cell))));
  if (!blocks_.back()) throw std::bad_alloc();
  for (std::int32_t i = 0; i < count; ++i)
    rows_.push_back(blocks_.back().get() + static_cast<std::size_t>(i) * location_count_);
  row_count_ += count;
}

void Occupancy::put_in(std::int32_t agent, PathView path) {
  const auto size = static_cast<std::int32_t>(path.size());
  if (size > row_count_) add_rows(size - row_count_);
  std::vector<Links>& links = links_[static_cast<std::size_t>(agent)];
  if (links.size() < path.size()) links.resize(path.size());
  const auto link = static_cast<Link>(agent + 1);
  for (std::int32_t t = 0; t < size; ++t) {
    Links& now = links[static_cast<std::size_t>(t)];
    if (t + 1 < size) {
      Link& first = cell(path[static_cast<std::size_t>(t)], t).here;
      now.here = first;
      first = link;
    }
    if (t == 0) continue;
    const Step step = step_of(path, t);
    if (!step.is_diagonal) continue;
    for (std::size_t side = 0; side < 2; ++side) {
      Link& first = cell(step.beside[side], t).passing;
      now.passing[side] = first;
      first = link;
    }
  }
  rest_time_[static_cast<std::size_t>(path.back())] = size - 1;
  rest_agent_[static_cast<std::size_t>(path.back())] = agent;
}

void Occupancy::take_out(std::int32_t agent) {
  const PathView path = paths_[static_cast<std::size_t>(agent)];
  const auto size = static_cast<std::int32_t>(path.size());
  for (std::int32_t t = 0; t < size; ++t) {
    if (t + 1 < size) unlink_here(agent, path[static_cast<std::size_t>(t)], t);
    if (t == 0) continue;
    const Step step = step_of(path, t);
    if (!step.is_diagonal) continue;
    for (std::size_t side = 0; side < 2; ++side) unlink_passing(agent, step.beside[side], t, side);
  }
  rest_time_[static_cast<std::size_t>(path.back())] = nobody_rests;
}

void Occupancy::unlink_here(std::int32_t agent, Location location, std::int32_t t) {
  Link* link = &cell(location, t).here;
  while (*link != agent + 1) link = &links(*link - 1, t).here;
  *link = links(agent, t).here;
}

void Occupancy::unlink_passing(std::int32_t agent, Location location, std::int32_t t, std::size_t side) {
  Link* link = &cell(location, t).passing;
  while (*link != agent + 1) {
    const std::int32_t other = *link - 1;
    const bool is_second = step_of(path(other), t).beside[1] == location;
    link = &links(other, t).passing[is_second ? 1 : 0];
  }
  *link = links(agent, t).passing[side];
}

template <class Visit>
void Occupancy::visit_here(Location location, std::int32_t t, Visit visit) const {
  if (rests_at(location, t)) visit(rest_agent_[static_cast<std::size_t>(location)]);
  if (t >= row_count_) return;
  for (Link link = cell(location, t).here; link != 0; link = links(link - 1, t).here) visit(link - 1);
}

template <class Visit>
void Occupancy::visit_passing(Location location, std::int32_t t, Visit visit) const {
  if (t >= row_count_) return;
  for (Link link = cell(location, t).passing; link != 0;) {
    const std::int32_t agent = link - 1;
    visit(agent);
    const bool is_second = step_of(path(agent), t).beside[1] == location;
    link = links(agent, t).passing[is_second ? 1 : 0];
  }
}

bool Occupancy::is_quiet(const Step& step, std::int32_t t) const {
  if (rests_at(step.to, t)) return false;
  if (step.is_diagonal && (rests_at(step.beside[0], t) || rests_at(step.beside[1], t))) return false;
  if (t >= row_count_) return true;
  const Cell& to = cell(step.to, t);
  const Cell& from = cell(step.from, t);
  if (to.here != 0 || to.passing != 0 || from.passing != 0) return false;
  if (step.from == step.to) return true;
  if ((from.here != 0 || rests_at(step.from, t)) && cell(step.to, t - 1).here != 0) return false;
  if (!step.is_diagonal) return true;
  for (const Location beside : step.beside)
    if (cell(beside, t - 1).here != 0 || cell(beside, t).here != 0) return false;
  return true;
}

template <class Visit>
void Occupancy::visit_met(const Step& step, std::int32_t t, Visit visit) const {
  visit_here(step.to, t, visit);
  visit_passing(step.to, t, visit);
  if (step.from == step.to) return;
  visit_passing(step.from, t, visit);
  visit_here(step.to, t - 1, [&](std::int32_t other) {
    if (location_at(path(other), t) == step.from) visit(other);
  });
  if (!step.is_diagonal) return;
  for (const Location beside : step.beside) {
    visit_here(beside, t - 1, visit);
    visit_here(beside, t, visit);
  }
}

std::int32_t Occupancy::count(Location from, Location to, Direction d, std::int32_t t) const {
  const Step step = step_of(from, to, d);
  if (is_quiet(step, t)) return 0;
  std::array<std::int32_t, 8> met;  // the first few agents, each once
  std::size_t met_count = 0;
  std::int32_t count = 0;
  visit_met(step, t, [&](std::int32_t other) {
    if (std::find(met.begin(), met.begin() + met_count, other) != met.begin() + met_count) return;
    if (met_count < met.size()) met[met_count++] = other;
    ++count;
  });
  return count;
}

// False if there is no conflict.
bool Occupancy::classify(std::int32_t agent, const Step& step, std::int32_t other, std::int32_t t,
                         Conflict& out) const {
  const Step its = step_of(path(other), t);
  const auto beside_mine = [&](Location location) { return step.is_beside(location); };
  const auto beside_its = [&](Location location) { return its.is_beside(location); };
  if (step.to == its.to) {
    out = {Conflict::Kind::vertex, agent, other, step.to, nowhere, t, false};
  } else if (step.is_diagonal && its.is_diagonal &&
             ((beside_mine(its.from) && beside_mine(its.to)) || (step.from == its.to && step.to == its.from))) {
    const Location corner = std::min({step.from, step.to, step.beside[0], step.beside[1]});
    out = {Conflict::Kind::corner, agent, other, corner, nowhere, t, false};
  } else if (step.from == its.to && step.to == its.from && step.from != step.to) {
    out = {Conflict::Kind::edge, agent, other, std::min(step.from, step.to), std::max(step.from, step.to), t, false};
  } else if (beside_mine(its.to)) {
    out = {Conflict::Kind::pass, other, agent, its.to, nowhere, t, false};
  } else if (beside_mine(its.from)) {
    out = {Conflict::Kind::pass, other, agent, its.from, nowhere, t - 1, false};
  } else if (beside_its(step.to)) {
    out = {Conflict::Kind::pass, agent, other, step.to, nowhere, t, false};
  } else if (beside_its(step.from)) {
    out = {Conflict::Kind::pass, agent, other, step.from, nowhere, t - 1, false};
  } else {
    return false;
  }
  return true;
}

void Occupancy::list(std::int32_t agent, PathView path, std::vector<Conflict>& out) {
  std::fill(met_at_.begin(), met_at_.end(), -1);
  const std::int32_t end = std::max(static_cast<std::int32_t>(path.size()), row_count_);
  for (std::int32_t t = 1; t < end; ++t) {
    const Step step = step_of(path, t);
    if (is_quiet(step, t)) continue;
    visit_met(step, t, [&](std::int32_t other) {
      std::int32_t& met_at = met_at_[static_cast<std::size_t>(other)];
      if (met_at == t) return;
      Conflict conflict;
      if (!classify(agent, step, other, t, conflict)) return;
      conflict.is_first = met_at < 0;
      met_at = t;
      out.push_back(conflict);
    });
  }
}

}  // namespace dmrp::planners::ecbs8
