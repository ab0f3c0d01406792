// SPDX-License-Identifier: MIT
#include "host/world/walking_grids.hpp"

#include <fmt/format.h>

#include <cmath>

#include "host/plugins/v1_sizes.hpp"

namespace dmrp::host {

namespace {

constexpr double most_cells = 1e8;  // as ext/walking_grid.h states

}  // namespace

WalkingGrids::WalkingGrids(std::shared_ptr<const core::StaticGeometry> geometry) : geometry_(std::move(geometry)) {
  extension_.struct_size = sizeof(extension_);
  extension_.context = this;
  extension_.grid = [](const dmrp_walking_grid* self,
                       const dmrp_walking_grid_request* theirs) noexcept -> const dmrp_grid* {
    if (!theirs || !has_v1_0<dmrp_walking_grid_request>(theirs->struct_size)) return nullptr;
    try {
      WalkingGrids& own = *static_cast<WalkingGrids*>(self->context);
      const dmrp_walking_grid_request request = copy_struct(*theirs);
      if (request.reserved != 0) {
        if (own.guard_)
          own.guard_->refuse(
              fmt::format("asked with {} in dmrp_walking_grid_request.reserved, which must be 0", request.reserved));
        return nullptr;
      }
      const Grid* const found = own.grid(request.resolution_m, request.radius_m);
      return found ? &found->view : nullptr;
    } catch (...) {  // out of memory, or a stored world of shapes that this host does not know
      return nullptr;
    }
  };
}

WalkingGrids::WalkingGrids(const dmrp_world& world) : WalkingGrids(nullptr) {
  world_ = &world;
}

const core::PlanningGrid* WalkingGrids::find(double resolution_m, double radius_m) {
  const Grid* const found = grid(resolution_m, radius_m);
  return found ? &found->grid : nullptr;
}

std::vector<WalkingGrids::Known> WalkingGrids::known() const {
  std::vector<Known> all;
  for (const auto& [request, grid] : grids_)
    if (grid) all.push_back({request.first, request.second, grid->view});
  return all;
}

void WalkingGrids::add(const Known& known) {
  auto& grid = grids_[{known.resolution_m, known.radius_m}];
  grid = std::make_unique<Grid>();
  grid->view = known.view;
}

WalkingGrids::Grid* WalkingGrids::grid(double resolution_m, double radius_m) {
  if (!(resolution_m > 0.0 && std::isfinite(resolution_m) && radius_m >= 0.0 && std::isfinite(radius_m)))
    return nullptr;
  std::unique_ptr<Grid>& known = grids_[{resolution_m, radius_m}];
  if (known) return known.get();
  if (!geometry_) geometry_ = std::make_shared<const core::StaticGeometry>(*world_);
  const dmrp_vec2 size = {geometry_->upper().x - geometry_->lower().x, geometry_->upper().y - geometry_->lower().y};
  if (!(size.x / resolution_m * (size.y / resolution_m) <= most_cells)) return nullptr;
  auto made = std::make_unique<Grid>();
  made->grid = core::build_walking_grid(*geometry_, radius_m, resolution_m);
  if (made->grid.width == 0 || made->grid.height == 0) return nullptr;  // cells that are larger than any world
  made->view = made->grid.view();
  known = std::move(made);
  return known.get();
}

}  // namespace dmrp::host
