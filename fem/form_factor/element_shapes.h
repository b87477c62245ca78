#pragma once

#include <array>
#include <span>
#include <vector>

#include "fem/quadrature.h"
#include "geometry/box.h"
#include "geometry/polygon.h"
#include "scene/place.h"

namespace interflect::fem {

/// A direction in which an element extends, and how far.
struct HalfAxis {
  Vec3 direction = Vec3::Zero();
  double length = 0;    ///< [m]
  double widening = 0;  ///< by what part the element grows wider along it [1/m]; 0 for parallelograms
};

/// What a pair of elements is integrated from, computed once per element; positions relative to
/// `ElementShapes::origin`.
struct ElementShape {
  std::array<Vec3, 4> corner;
  std::size_t corners = 0;
  geometry::Plane plane;  ///< normal out of the side that exchanges light
  Vec3 centroid;
  double radius = 0;  ///< of the ball about the centroid that holds the element [m]
  double area = 0;    ///< [m²]
  /// Of a parallelogram half of two sides, of another quad half of all four, of a triangle from the centroid to its
  /// corners.
  std::array<HalfAxis, 4> axis{};
  std::size_t axis_count = 0;

  std::span<const Vec3> ring() const { return {corner.data(), corners}; }
};

ElementShape shape_of(std::span<const Vec3> ring, const geometry::Plane& plane);

/// Nodes of a product rule, as arrays: `count` of them, padded to a multiple of 4 by nodes of weight 0.
struct NodeArrays {
  const double *x, *y, *z, *weight;  ///< [m], [m²]
  int count, padded;
};

/// Nodes of one element by one rule, padded.
class NodeBuffer {
 public:
  /// @param rules  rules_of(level + 1) with at most 16 nodes
  NodeBuffer(const ElementShape& shape, const RulePair& rules);
  NodeArrays arrays() const {
    return {data_.data(), data_.data() + padded_, data_.data() + 2 * padded_, data_.data() + 3 * padded_, count_,
            padded_};
  }

 private:
  std::array<double, 64> data_;
  int count_, padded_;
};

/// Shapes and far-field nodes of all elements.
class ElementShapes {
 public:
  static constexpr int levels = 4;  ///< level l: rules_of(l + 1)

  /// @throws core::PreconditionError  where an element has no area
  explicit ElementShapes(std::span<const scene::SurfacePatch> patches);

  const ElementShape& operator[](Index element) const { return shapes_[static_cast<std::size_t>(element)]; }
  Index size() const { return static_cast<Index>(shapes_.size()); }
  NodeArrays nodes(Index element, int level) const;
  const Vec3& origin() const { return origin_; }
  /// Distances from planes below this are rounding, near the elements that the planes are taken from [m].
  double plane_tolerance() const { return plane_tolerance_; }
  /// Heights over an element's plane below this are rounding, at a point that may be far from it [m]: the plane goes
  /// through rounded corners, and so it is tilted by their rounding over the element's width, area / radius or more.
  double height_tolerance(const ElementShape& of, const Vec3& at) const {
    return plane_tolerance_ + corner_rounding_ * (at - of.centroid).norm() * of.radius / of.area;
  }
  const RulePair& rules(int level) const { return rules_[static_cast<std::size_t>(level)]; }

 private:
  static constexpr std::array<int, levels> first_ = {0, 16, 48, 96};  ///< room for 4, 8, 12 and 16 nodes
  static constexpr int stride_ = 160;

  Vec3 origin_ = Vec3::Zero();
  double plane_tolerance_ = 0, corner_rounding_ = 0;
  std::array<RulePair, levels> rules_;
  std::vector<ElementShape> shapes_;
  std::vector<double> nodes_;  ///< per element and level: x[], y[], z[], weight[]
};

}  // namespace interflect::fem
