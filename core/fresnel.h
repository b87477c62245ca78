#pragma once

#include <optional>

#include "core/vec.h"

/// What smooth boundaries reflect and let through: parts of a power, by the angle at which light arrives.
namespace interflect::core {

/// Of light polarised across the plane of incidence (s) and in it (p).
struct Polarised {
  double s, p;
  double mean() const { return 0.5 * (s + p); }  ///< of light that is not polarised
};

/// Cosine of the refracted direction to the normal; nothing where all is reflected.
///
///   eta_i sin_i = eta_t sin_t  [Snell]
///
/// @param cosine  >= 0, of the incident direction
/// @param eta     eta_t / eta_i > 0: refractive index behind the boundary over that in front of it
std::optional<double> refracted_cosine(double cosine, double eta);

/// Reflectance of the boundary of a dielectric.
///
///   R_s = ((c_i - eta c_t) / (c_i + eta c_t))²,   R_p = ((eta c_i - c_t) / (eta c_i + c_t))²
///
/// Identities: the same from the other side, at the refracted direction with 1 / eta; R_p = 0 at tan i = eta
/// [Brewster]; 1 where all is reflected.
/// @return in [0, 1]
/// Source: [Fresnel 1823]; [Born, Wolf 1999] 1.5.2.  Test: tests/core/fresnel.cpp
Polarised fresnel(double cosine, double eta);

/// Reflectance of a conductor with the complex index eta + i k over that in front of it.
/// Source: [Born, Wolf 1999] 14.2
Polarised fresnel(double cosine, double eta, double k);

/// Of light that is not polarised and arrives from everywhere alike: int 2 R(c) c dc, to 1e-10.
double diffuse_fresnel(double eta);

/// A thin pane, without the shift that its thickness makes: of all that goes back and forth inside it,
///
///   T = tau (1 - r)² / (1 - r² tau²),   R = r + r tau² (1 - r)² / (1 - r² tau²)
///
/// for each polarisation by itself, and averaged last: light that has passed one face is polarised.
struct Pane {
  double eta;  ///< of the glass over the air
  double
      normal_pass{};  ///< what is left of light that crosses once at right angles, between the faces: 1 absorbs nothing

  struct Parts {
    double reflected, transmitted;
  };
  Parts operator()(double cosine) const;
  /// The one of this index that transmits as much at normal incidence.
  /// @param transmittance  0 .. (1 - r) / (1 + r), which absorbs nothing
  static Pane of(double eta, double transmittance);
};

/// Mirrored about the normal.  Directions lead away from the surface.
inline Vec3 reflected(const Vec3& way, const Vec3& normal) { return 2 * normal.dot(way) * normal - way; }

/// Where light goes that arrives from `way`, on the other side of the normal; nothing where all is reflected.
/// @param eta  index behind the boundary over that on the side of `way`
std::optional<Vec3> refracted(const Vec3& way, const Vec3& normal, double eta);

}  // namespace interflect::core
