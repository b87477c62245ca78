#pragma once

#include <array>
#include <optional>

#include "core/spectrum.h"
#include "core/vec.h"

namespace interflect::montecarlo {

/// Which way a path is walked: it matters where light passes into another medium, since radiance changes there as the
/// square of the index, and flux does not [Veach 1997, 5.2].
enum class Walk : std::uint8_t { from_eye, from_light };

/// A direction drawn by a Bsdf.
struct Scattered {
  Vec3 way;
  Spectrum weight;             ///< f |cos| / p of it: what a path's throughput is multiplied by
  double pdf_solid_angle = 0;  ///< of `way` by all that is not delta [1/sr]; 0 where this is
  bool delta = false;          ///< to a direction of its own: no other way of drawing would have found it
  bool straight = false;       ///< through, and on as it came
  double squeezed = 1;         ///< of the weight, by how much radiance changes as the square of the index does
};

/// The delta parts of a place, each whole: what a tree of rays follows where a path draws one of them.
class DeltaParts {
 public:
  void add(const Scattered& part) { parts_[count_++] = part; }
  const Scattered* begin() const { return parts_.data(); }
  const Scattered* end() const { return parts_.data() + count_; }
  Scattered* begin() { return parts_.data(); }
  Scattered* end() { return parts_.data() + count_; }

 private:
  std::array<Scattered, 4> parts_{};
  std::size_t count_ = 0;
};

/// How a place of a surface scatters light.  Directions are unit, lead away from the surface, and are in a frame whose z
/// is the normal of the surface's front.
///
///   f(from -> to)   [1/sr]: of the radiance that arrives from `from`, per projected solid angle, what leaves to `to`.
///
/// Delta parts (mirrors, smooth glass, panes) are in `sample` alone, never in f or the pdf.
/// Identities:  f(a -> b) eta_a² = f(b -> a) eta_b² with the indices on their sides;  int f(a -> b) |cos_b| d sigma_b
/// and what is delta are 1 together at most.
/// The direction that is drawn does not depend on the walk, its weight does.
/// Tests of all: tests/montecarlo/bsdf.cpp
class Bsdf {
 public:
  virtual ~Bsdf() = default;

  virtual Spectrum f(const Vec3& from, const Vec3& to) const = 0;
  /// Of `drawn`, by `sample` from `known`, over what is not delta [1/sr].
  virtual double pdf_solid_angle(const Vec3& known, const Vec3& drawn) const = 0;
  /// @param known  where a path from the eye goes to, or one from the light comes from
  /// @param u      uniform in [0, 1): which part, and the direction in it
  /// @return       nothing: the path ends, with nothing lost but what is absorbed
  virtual std::optional<Scattered> sample(const Vec3& known, const Vec3& u, Walk walk) const = 0;
  /// What `sample` draws of delta parts, on average.
  virtual void delta_parts(const Vec3& /*known*/, Walk, DeltaParts&) const {}
  /// Whether some of what it does is delta, but for going straight on: light that takes that way cannot be joined here.
  virtual bool mirrors() const { return only_delta(); }
  /// What goes straight through of light that arrives from there.
  virtual Spectrum straight(const Vec3&) const { return Spectrum::zero(); }
  /// Whether any light may.
  virtual bool lets_pass() const { return false; }
  /// Whether f(a -> b) may be other than 0 where a and b are on different sides.
  virtual bool transmits() const { return false; }
  /// Whether what is not delta favours directions (measure::PathLetter).
  virtual bool glossy() const { return false; }
  /// Whether f is 0 everywhere: a path cannot be joined here with another.
  virtual bool only_delta() const { return false; }
};

/// Whether both are on one side of the surface.
inline bool same_side(const Vec3& a, const Vec3& b) { return a.z() * b.z() > 0; }

/// f of a walk whose known direction it is.
inline Spectrum f_of(const Bsdf& bsdf, const Vec3& known, const Vec3& drawn, Walk walk) {
  return walk == Walk::from_eye ? bsdf.f(drawn, known) : bsdf.f(known, drawn);
}

/// Drawn by what is not delta: weight = f |cos| / p.
inline std::optional<Scattered> scattered(const Bsdf& bsdf, const Vec3& known, const Vec3& way, Walk walk) {
  const double p = bsdf.pdf_solid_angle(known, way);
  if (!(p > 0)) return std::nullopt;
  return Scattered{way, f_of(bsdf, known, way, walk) * (std::abs(way.z()) / p), p, false};
}

}  // namespace interflect::montecarlo
