#include "fem/form_factor/single_plane.h"

#include <algorithm>

#include "core/error.h"
#include "fem/form_factor/point_to_polygon.h"
#include "fem/form_factor/warnock.h"

namespace interflect::fem {

namespace {

/// Form factor of the part of a polygon that the plane does not show, if nothing hid it.
double factor_beyond(const FrontingPolygon& polygon, const ProjectedPolygon& shown, double half_side) {
  bool inside = true;
  for (const Vec3& corner : polygon.ring())
    inside &= std::max(std::abs(corner.x()), std::abs(corner.y())) <= half_side * corner.z();
  if (inside) return 0;
  std::array<Vec3, ProjectedPolygon::capacity> ring;
  for (std::size_t k = 0; k < static_cast<std::size_t>(shown.corners); ++k) ring[k] = Vec3(shown.x[k], shown.y[k], 1);
  const double part = point_to_polygon_above_horizon(Vec3::Zero(), Vec3::UnitZ(),
                                                     {ring.data(), static_cast<std::size_t>(shown.corners)});
  return std::max(0.0, point_to_polygon(Vec3::Zero(), Vec3::UnitZ(), polygon.ring()) - part);
}

}  // namespace

class SinglePlane::View final : public Sight {
 public:
  View(double half_side, double small)
      : half_side_(half_side), plane_(ViewPlane::top(half_side)), cells_(half_side, small) {}

  void look(const ViewScene& scene, const Eye& eye, Index element, SeenItems& seen) override {
    cells_.clear();
    seen.clear(static_cast<std::size_t>(scene.elements()));
    FrontingPolygon polygon;
    for (Index shape = 0; shape < scene.size(); ++shape) {
      if (shape == element || !scene.fronting(eye, element, shape, polygon)) continue;
      const bool counts = scene.is_element(shape);
      if (!counts) polygon.plane.offset *= 1 + 1e-9;  // a facet that elements cover in part stays behind them
      const ProjectedPolygon projected = plane_.project(polygon.ring(), polygon.plane);
      cells_.add(projected, counts ? static_cast<std::int32_t>(shape) : ItemBuffer::nothing_of_interest);
      if (counts) seen.beyond[static_cast<std::size_t>(shape)] = factor_beyond(polygon, projected, half_side_);
    }
    cells_.count(seen);
  }

 private:
  double half_side_;
  ViewPlane plane_;
  Warnock cells_;
};

SinglePlane::SinglePlane(const FormFactorContext& context, double half_side)
    : RowMethod(context), half_side_(half_side), resolution_(even_resolution(context.resolution)) {
  if (!(half_side > 0)) throw core::PreconditionError("SinglePlane: a half side above 0 expected");
}

double SinglePlane::lost() const { return 1 - 4 * factor_across(half_side_, half_side_); }

std::unique_ptr<Sight> SinglePlane::sight() const {
  return std::make_unique<View>(half_side_, 4 * inv_pi / (static_cast<double>(resolution_) * resolution_));
}

}  // namespace interflect::fem
