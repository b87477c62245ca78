#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>

#include "core/spectrum.h"
#include "core/vec.h"
#include "scene/ids.h"

/// The one vocabulary of places: elements, ray hits and measurements all speak it.
namespace interflect::scene {

enum class Side : std::uint8_t { front, back };

/// A point on a side of a surface.
struct SurfacePoint {
  SurfaceId surface;
  Side side = Side::front;
  std::uint32_t facet = 0;  ///< in Scene::facets
  Vec2 uv = Vec2::Zero();   ///< barycentric: position = (1 - u - v) corner_0 + u corner_1 + v corner_2
  Vec3 position;            ///< [m], on the facet's plane to double precision
  Vec3 normal;              ///< unit, out of `side`
};

/// A planar triangle or convex quad on one side of a surface; its corners run counter-clockwise seen from that side.
struct SurfacePatch {
  SurfaceId surface;
  Side side = Side::front;
  std::uint8_t corners = 0;  ///< 3 or 4
  std::array<Vec3, 4> corner;
  double area = 0;  ///< [m²]

  std::span<const Vec3> ring() const { return {corner.data(), corners}; }
  Vec3 normal() const;    ///< unit, out of `side`
  Vec3 centroid() const;  ///< of the area [m]
};

/// A patch from its corners, with the area that they enclose.
SurfacePatch make_patch(SurfaceId surface, Side side, std::span<const Vec3> ring);

/// The four parts that the midpoints of its edges cut a triangle or a convex quad into, by their corners (four of them
/// on a quad, else three).  Corner k of part k is corner k of the whole, for k < 3 (k < 4 of a quad); the fourth part
/// of a triangle is its middle, whose corner k lies opposite to corner k.
std::array<std::array<Vec3, 4>, 4> quarters_of(std::span<const Vec3> ring);
std::array<SurfacePatch, 4> quarters_of(const SurfacePatch& patch);

/// A spectral quantity as a function of place: a radiosity solution as others see it.
using SurfaceField = std::function<Spectrum(const SurfacePoint&)>;

}  // namespace interflect::scene
