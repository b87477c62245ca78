#include "fem/form_factor/element_shapes.h"

#include <algorithm>
#include <limits>

#include "core/error.h"
#include "fem/quadrature.h"

namespace interflect::fem {

namespace {

geometry::Box box_of(std::span<const scene::SurfacePatch> patches) {
  geometry::Box box;
  for (const auto& patch : patches)
    for (const Vec3& p : patch.ring()) box.extend(p);
  return box;
}

/// @param growth  of the element's width from the middle to the axis' end, as a part
HalfAxis along(const Vec3& half, double growth = 0) {
  const double length = half.norm();
  if (!(length > 0)) return {};
  return {half / length, length, growth / length};
}

/// A quad is c + u A + v B + u v W, -1 <= u, v <= 1, with a Jacobian in proportion to A x B + u A x W + v W x B.  Where
/// W is rounding, opposite sides are as one.
void add_axes_of_quad(ElementShape& shape) {
  const auto& p = shape.corner;
  const Vec3 A = 0.25 * (p[1] - p[0] + p[2] - p[3]), B = 0.25 * (p[3] - p[0] + p[2] - p[1]),
             W = 0.25 * (p[0] - p[1] + p[2] - p[3]);
  if (W.norm() <= 1e-9 * shape.radius) {
    shape.axis = {along(A), along(B)};
    shape.axis_count = 2;
    return;
  }
  const double jacobian = A.cross(B).norm(), of_u = A.cross(W).norm() / jacobian, of_v = W.cross(B).norm() / jacobian;
  shape.axis = {along(A + W, of_u), along(A - W, of_u), along(B + W, of_v), along(B - W, of_v)};
  shape.axis_count = 4;
}

void add_axes(ElementShape& shape) {
  if (shape.corners == 4) return add_axes_of_quad(shape);
  for (std::size_t k = 0; k < 3; ++k) shape.axis[k] = along(shape.corner[k] - shape.centroid);
  shape.axis_count = 3;
}

}  // namespace

ElementShape shape_of(std::span<const Vec3> ring, const geometry::Plane& plane) {
  ElementShape shape;
  shape.corners = ring.size();
  std::copy(ring.begin(), ring.end(), shape.corner.begin());
  shape.plane = plane;
  Vec3 moment = Vec3::Zero();
  for (std::size_t k = 2; k < ring.size(); ++k) {
    const double area = 0.5 * plane.normal.dot((ring[k - 1] - ring[0]).cross(ring[k] - ring[0]));
    shape.area += area;
    moment += area / 3.0 * ((ring[k - 1] - ring[0]) + (ring[k] - ring[0]));
  }
  shape.centroid = ring[0] + moment / shape.area;
  for (const Vec3& p : ring) shape.radius = std::max(shape.radius, (p - shape.centroid).norm());
  add_axes(shape);
  return shape;
}

NodeBuffer::NodeBuffer(const ElementShape& shape, const RulePair& rules) {
  const Rule& rule = rules.of(shape.corners);
  const double scale = shape.corners == 3 ? 0.5 : 1.0;
  count_ = static_cast<int>(rule.size());
  padded_ = (count_ + 3) / 4 * 4;
  double* const out = data_.data();
  for (int k = 0; k < padded_; ++k) {
    const bool real = k < count_;
    const RuleNode node = real ? rule[static_cast<std::size_t>(k)] : RuleNode{0.0, 0.0, 0.0};
    const Vec3 position = point_on(shape.ring(), node.u, node.v);
    out[k] = position.x();
    out[padded_ + k] = position.y();
    out[2 * padded_ + k] = position.z();
    out[3 * padded_ + k] = real ? scale * jacobian(shape.ring(), node.u, node.v) * node.weight : 0.0;
  }
}

ElementShapes::ElementShapes(std::span<const scene::SurfacePatch> patches)
    : nodes_(patches.size() * static_cast<std::size_t>(stride_)) {
  const geometry::Box box = box_of(patches);
  if (patches.empty()) return;
  origin_ = box.center();
  const double coordinates = std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  corner_rounding_ = 8 * std::numeric_limits<double>::epsilon() * coordinates;
  plane_tolerance_ = 1e-11 * box.diagonal().norm() + corner_rounding_;
  for (int level = 0; level < levels; ++level) rules_[static_cast<std::size_t>(level)] = rules_of(level + 1);
  for (const auto& patch : patches) {
    if (!(patch.area > 0)) throw core::PreconditionError("ElementShapes: an element without area");
    std::array<Vec3, 4> ring;
    for (std::size_t k = 0; k < patch.corners; ++k) ring[k] = patch.corner[k] - origin_;
    const Vec3 normal = patch.normal();
    shapes_.push_back(shape_of({ring.data(), patch.corners}, {normal, normal.dot(ring[0])}));
    double* const of_element = nodes_.data() + static_cast<Index>(shapes_.size() - 1) * stride_;
    for (std::size_t level = 0; level < rules_.size(); ++level) {
      const NodeBuffer buffer(shapes_.back(), rules_[level]);
      std::copy_n(buffer.arrays().x, 4 * buffer.arrays().padded, of_element + first_[level]);
    }
  }
}

NodeArrays ElementShapes::nodes(Index element, int level) const {
  const auto l = static_cast<std::size_t>(level);
  const double* x = nodes_.data() + element * stride_ + first_[l];
  const int count = static_cast<int>(rules_[l].of((*this)[element].corners).size()), padded = (count + 3) / 4 * 4;
  return {x, x + padded, x + 2 * padded, x + 3 * padded, count, padded};
}

}  // namespace interflect::fem
