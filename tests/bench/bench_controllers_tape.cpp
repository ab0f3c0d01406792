// SPDX-License-Identifier: MIT
#include "tests/bench/bench_controllers_tape.hpp"

#include <cstdio>

namespace dmrp::bench {

Perception::Perception() {
  lidar_ = {sizeof(dmrp_lidar), 0, this, [](const dmrp_lidar* self, std::uint32_t robot) {
              return static_cast<Perception*>(self->context)->scan(robot);
            }};
  local_costmap_ = {sizeof(dmrp_local_costmap), 0, this, [](const dmrp_local_costmap* self, std::uint32_t robot) {
                      return static_cast<Perception*>(self->context)->costmap(robot);
                    }};
  distance_field_ = {sizeof(dmrp_distance_field), 0, this, [](const dmrp_distance_field* self, std::uint32_t robot) {
                       return static_cast<Perception*>(self->context)->field(robot);
                     }};
  obstacle_clusters_ = {sizeof(dmrp_obstacle_clusters), 0, this,
                        [](const dmrp_obstacle_clusters* self, std::uint32_t robot) {
                          return static_cast<Perception*>(self->context)->clusters(robot);
                        }};
}

const void* Perception::own(const std::string& id) const {
  if (id == DMRP_EXT_LIDAR) return &lidar_;
  if (id == DMRP_EXT_LOCAL_COSTMAP) return &local_costmap_;
  if (id == DMRP_EXT_DISTANCE_FIELD) return &distance_field_;
  if (id == DMRP_EXT_OBSTACLE_CLUSTERS) return &obstacle_clusters_;
  return nullptr;
}

const void* Recorder::extension(const std::string& id) {
  return source_(id) ? own(id) : nullptr;
}

void Recorder::read_all(std::uint32_t robot) {
  if (source_(DMRP_EXT_LIDAR)) scan(robot);
  if (source_(DMRP_EXT_LOCAL_COSTMAP)) costmap(robot);
  if (source_(DMRP_EXT_DISTANCE_FIELD)) field(robot);
  if (source_(DMRP_EXT_OBSTACLE_CLUSTERS)) clusters(robot);
}

const dmrp_scan* Recorder::scan(std::uint32_t robot) {
  const auto* lidar = static_cast<const dmrp_lidar*>(source_(DMRP_EXT_LIDAR));
  const dmrp_scan* scan = lidar->scan(lidar, robot);
  frame_->scan = *scan;
  frame_->ranges.assign(scan->ranges, scan->ranges + scan->count);
  return scan;
}

const dmrp_costmap* Recorder::costmap(std::uint32_t robot) {
  const auto* source = static_cast<const dmrp_local_costmap*>(source_(DMRP_EXT_LOCAL_COSTMAP));
  const dmrp_costmap* map = source->costmap(source, robot);
  frame_->costmap = *map;
  frame_->costs.assign(map->costs, map->costs + std::size_t{map->width} * map->height);
  return map;
}

const dmrp_field* Recorder::field(std::uint32_t robot) {
  const auto* source = static_cast<const dmrp_distance_field*>(source_(DMRP_EXT_DISTANCE_FIELD));
  const dmrp_field* field = source->field(source, robot);
  frame_->field = *field;
  frame_->distances_m.assign(field->distances_m, field->distances_m + std::size_t{field->width} * field->height);
  return field;
}

const dmrp_obstacle_cluster_list* Recorder::clusters(std::uint32_t robot) {
  const auto* source = static_cast<const dmrp_obstacle_clusters*>(source_(DMRP_EXT_OBSTACLE_CLUSTERS));
  const dmrp_obstacle_cluster_list* list = source->clusters(source, robot);
  frame_->clusters = *list;
  frame_->vertex_counts.clear();
  frame_->vertices.clear();
  for (std::uint32_t i = 0; i < list->count; ++i) {
    const dmrp_obstacle_cluster& cluster = *DMRP_AT(dmrp_obstacle_cluster, list->clusters, list->stride, i);
    frame_->vertex_counts.push_back(cluster.vertex_count);
    frame_->vertices.insert(frame_->vertices.end(), cluster.vertices, cluster.vertices + cluster.vertex_count);
  }
  return list;
}

Player::Player(bool listens) : listens_(listens) {
  cluster_array_.reserve(1024);  // its allocations would count as the controller's
  annotate_.struct_size = sizeof(annotate_);
  annotate_.context = this;
  annotate_.wanted = [](const dmrp_annotate*) -> std::int32_t { return 1; };
  annotate_.trajectory = [](const dmrp_annotate*, const dmrp_trajectory*) {};
  annotate_.note = [](const dmrp_annotate* self, const dmrp_note* note) {
    std::sscanf(note->text, "iterations %lf", &static_cast<Player*>(self->context)->iterations_);
  };
}

const void* Player::extension(const std::string& id) {
  if (id == DMRP_EXT_ANNOTATE) return listens_ ? &annotate_ : nullptr;
  return own(id);
}

double Player::take_iterations() {
  const double iterations = iterations_;
  iterations_ = -1.0;
  return iterations;
}

const dmrp_scan* Player::scan(std::uint32_t) {
  scan_ = frame_->scan;
  scan_.ranges = frame_->ranges.data();
  return &scan_;
}

const dmrp_costmap* Player::costmap(std::uint32_t) {
  costmap_ = frame_->costmap;
  costmap_.costs = frame_->costs.data();
  return &costmap_;
}

const dmrp_field* Player::field(std::uint32_t) {
  field_ = frame_->field;
  field_.distances_m = frame_->distances_m.data();
  return &field_;
}

const dmrp_obstacle_cluster_list* Player::clusters(std::uint32_t) {
  cluster_array_.clear();
  const dmrp_vec2* vertices = frame_->vertices.data();
  for (const std::uint32_t count : frame_->vertex_counts) {
    cluster_array_.push_back({count, 0, vertices});
    vertices += count;
  }
  clusters_ = frame_->clusters;
  clusters_.stride = sizeof(dmrp_obstacle_cluster);
  clusters_.clusters = cluster_array_.data();
  return &clusters_;
}

}  // namespace dmrp::bench
