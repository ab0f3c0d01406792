// SPDX-License-Identifier: MIT
#include "metrics/interaction/open_standstill.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/segment.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <limits>
#include <string>

#include "metrics/measure/describe_metric.hpp"
#include "metrics/measure/nearest_wall.hpp"
#include "metrics/measure/per_robot.hpp"
#include "metrics/measure/way_ahead.hpp"

namespace dmrp::metrics {
namespace {

constexpr std::int64_t period_ns = 1'000'000'000;
constexpr double cell_m = 0.1;
constexpr double beside_way_m = 1.0;

double distance_to(const std::vector<Vec2>& way, Vec2 point) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < way.size(); ++i)
    nearest = std::min(nearest, toolkit::distance(dmrp_segment{way[i - 1], way[i]}, point));
  return nearest;
}

// Cells of a square about a way, each free or not; `is_free(centre)`.
class Cells {
 public:
  template <class IsFree>
  Cells(const std::vector<Vec2>& way, const IsFree& is_free) : lower_(way.front()) {
    Vec2 upper = lower_;
    for (const Vec2 point : way) {
      lower_ = {std::min(lower_.x, point.x), std::min(lower_.y, point.y)};
      upper = {std::max(upper.x, point.x), std::max(upper.y, point.y)};
    }
    lower_ = lower_ - Vec2{beside_way_m, beside_way_m};
    width_ = static_cast<int>(std::ceil((upper.x + beside_way_m - lower_.x) / cell_m));
    height_ = static_cast<int>(std::ceil((upper.y + beside_way_m - lower_.y) / cell_m));
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x) free_.push_back(is_free(lower_ + Vec2{(x + 0.5) * cell_m, (y + 0.5) * cell_m}));
  }

  // Whether free cells that share sides lead from one point to the other.
  bool lead(Vec2 from, Vec2 to) const {
    const std::size_t goal = index_of(to);
    std::vector<std::size_t> open = {index_of(from)};
    std::vector<char> seen(free_.size(), false);
    seen[open.front()] = true;
    while (!open.empty()) {
      const std::size_t cell = open.back();
      open.pop_back();
      if (!free_[cell]) continue;
      if (cell == goal) return true;
      const auto x = static_cast<int>(cell) % width_;
      const auto visit = [&](bool exists, std::size_t next) {
        if (!exists || seen[next]) return;
        seen[next] = true;
        open.push_back(next);
      };
      const auto row = static_cast<std::size_t>(width_);
      visit(x > 0, cell - 1);
      visit(x + 1 < width_, cell + 1);
      visit(cell >= row, cell - row);
      visit(cell + row < free_.size(), cell + row);
    }
    return false;
  }

 private:
  std::size_t index_of(Vec2 point) const {
    const int x = std::clamp(static_cast<int>((point.x - lower_.x) / cell_m), 0, width_ - 1);
    const int y = std::clamp(static_cast<int>((point.y - lower_.y) / cell_m), 0, height_ - 1);
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  Vec2 lower_;
  int width_ = 0;
  int height_ = 0;
  std::vector<char> free_;
};

}  // namespace

Descriptor OpenStandstill::describe() {
  return describe_metric("dmrp.metric.open_standstill", "Standstill in the open")
      .summary("robots that stand although they have room and their way is free")
      .source("own definition; waits that the plan or ordered execution demands count too")
      .channels(DMRP_CHANNEL_PEOPLE)
      .value("open_standstills", "1", Direction::lower_is_better, Subjects::system_and_robots,
             "number of times that the active robot stood for lasting_s or more with room_m of free room round it and "
             "a free way along the next way_m of its path; system: sum over robots; undefined if planning failed");
}

void OpenStandstill::begin(const dmrp_plan*) {
  active_.begin(world().robots().size());
  measured_.assign(world().robots().size(), false);
  standing_.assign(world().robots().size(), {});
  counted_.assign(world().robots().size(), {});
  looked_ns_ = -period_ns;
}

void OpenStandstill::observe(const Sample& sample) {
  active_.observe(sample);
  for (std::size_t robot = 0; robot < measured_.size(); ++robot)
    if (active_.in_step(robot)) measured_[robot] = true;
  if (sample.t_ns - looked_ns_ < period_ns) return;
  looked_ns_ = sample.t_ns;
  for (std::size_t robot = 0; robot < standing_.size(); ++robot) {
    Standing& standing = standing_[robot];
    const Vec2 place = toolkit::position(sample.robots[robot].pose);
    const bool stands = active_.at_instant(robot) && sample.plan && toolkit::distance(standing.at, place) <= moved_m;
    if (!stands || !is_in_the_open(sample, robot)) {
      close(robot);
      standing.at = place;
      continue;
    }
    if (!standing.is_open) standing = {true, sample.t_ns, sample.t_ns, standing.at};
    standing.to_ns = sample.t_ns;
  }
}

bool OpenStandstill::is_in_the_open(const Sample& sample, std::size_t robot) const {
  const Disc body = disc_of(world().robots()[robot], sample.robots[robot]);
  std::vector<Disc> others;
  for (std::size_t other = 0; other < standing_.size(); ++other)
    if (other != robot) others.push_back(disc_of(world().robots()[other], sample.robots[other]));
  for (const Person& person : sample.people) others.push_back(disc_of(person));
  for (const Disc& other : others)
    if (surface_distance(body, other) < room_m) return false;
  NearestWall walls;
  walls.begin(world());
  if (walls.find(body.center).distance_m - body.radius_m < room_m) return false;
  return has_free_way(sample, robot, others);
}

bool OpenStandstill::has_free_way(const Sample& sample, std::size_t robot, const std::vector<Disc>& others) const {
  const RobotSample& now = sample.robots[robot];
  const Disc body = disc_of(world().robots()[robot], now);
  const std::vector<Vec2> way = way_ahead(Plan(*sample.plan).path(robot), body.center, now.progress_m, way_m);
  NearestWall walls;
  walls.begin(world());
  const Cells cells(way, [&](Vec2 centre) {
    if (distance_to(way, centre) > beside_way_m) return false;
    for (const Disc& other : others)
      if (toolkit::distance(centre, other.center) < body.radius_m + other.radius_m) return false;
    return walls.find(centre).distance_m >= body.radius_m;
  });
  return cells.lead(body.center, way.back());
}

void OpenStandstill::close(std::size_t robot) {
  Standing& standing = standing_[robot];
  if (standing.is_open && standing.to_ns - standing.from_ns >= std::llround(lasting_s * 1e9))
    counted_[robot].push_back(standing);
  standing.is_open = false;
}

void OpenStandstill::finish(const TrialEnd&, MetricSink& sink) {
  std::vector<double> counts;
  for (std::size_t robot = 0; robot < standing_.size(); ++robot) {
    close(robot);
    for (const Standing& standing : counted_[robot])
      sink.event({"open_standstills",
                  standing.from_ns,
                  standing.to_ns,
                  {robot_subject(robot)},
                  "robot " + std::to_string(robot) + " stands although it has room and its way is free"});
    counts.push_back(measured_[robot] ? static_cast<double>(counted_[robot].size()) : undefined);
  }
  give(sink, "open_standstills", counts, &sum_of_defined);
}

}  // namespace dmrp::metrics
