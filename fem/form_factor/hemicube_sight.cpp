#include "fem/form_factor/hemicube_sight.h"

#include <algorithm>

namespace interflect::fem {

HemicubeSight::HemicubeSight(const HemicubeGrid& grid)
    : planes_{ViewPlane::top(1 / grid.height), ViewPlane::side(0, grid.height), ViewPlane::side(1, grid.height),
              ViewPlane::side(2, grid.height), ViewPlane::side(3, grid.height)},
      buffers_{ItemBuffer(grid.top), ItemBuffer(grid.side), ItemBuffer(grid.side), ItemBuffer(grid.side),
               ItemBuffer(grid.side)} {}

void HemicubeSight::clear() {
  for (ItemBuffer& buffer : buffers_) buffer.clear();
}

double HemicubeSight::add(std::span<const Vec3> local_ring, const geometry::Plane& local_plane, std::int32_t item) {
  double covered = 0;
  for (std::size_t face = 0; face < faces; ++face)
    covered += buffers_[face].add(planes_[face].project(local_ring, local_plane), item);
  return covered;
}

void HemicubeSight::count(SeenItems& seen) const {
  for (const ItemBuffer& buffer : buffers_) buffer.count(seen);
}

/// The weight of the cell that a polygon without a sample in it lies in; 0 where that cell sees something nearer.
double HemicubeSight::missed_cell(const FrontingPolygon& polygon) const {
  for (std::size_t face = 0; face < faces; ++face) {
    const ProjectedPolygon projected = planes_[face].project(polygon.ring(), polygon.plane);
    if (projected.corners == 0) continue;
    const ItemBuffer& buffer = buffers_[face];
    const FaceGrid& grid = buffer.grid();
    const auto next = [](const CellAxis& axis, double at) { return std::min(axis.first_from(at), axis.cells() - 1); };
    const int i = next(grid.x, projected.x[0]), j = next(grid.y, projected.y[0]);
    const double nearness = projected.q0 + projected.qx * projected.x[0] + projected.qy * projected.y[0];
    if (buffer.nearness(i, j) < nearness * (1 + 1e-9)) return grid.weight_at(i, j);
  }
  return 0;
}

void HemicubeSight::look(const ViewScene& scene, const Eye& eye, Index element, SeenItems& seen) {
  clear();
  seen.clear(static_cast<std::size_t>(scene.elements()));
  uncovered_.clear();
  FrontingPolygon polygon;
  for (Index shape = 0; shape < scene.size(); ++shape) {
    if (shape == element || !scene.fronting(eye, element, shape, polygon)) continue;
    const bool counts = scene.is_element(shape);
    if (!counts) polygon.plane.offset *= 1 + 1e-9;  // a facet that elements cover in part stays behind them
    const double covered =
        add(polygon.ring(), polygon.plane, counts ? static_cast<std::int32_t>(shape) : ItemBuffer::nothing_of_interest);
    if (!counts) continue;
    seen.covered[static_cast<std::size_t>(shape)] = covered;
    if (covered == 0) uncovered_.push_back(shape);
  }
  count(seen);
  for (const Index shape : uncovered_) {
    if (!scene.fronting(eye, element, shape, polygon)) continue;
    const double cell = missed_cell(polygon);
    seen.border[static_cast<std::size_t>(shape)] += cell * cell;
  }
}

}  // namespace interflect::fem
