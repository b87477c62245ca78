#pragma once

#include "scene/io/mtl_file.h"
#include "scene/material.h"

namespace interflect::scene::io {

/// A material of an MTL file as this program has it, and the keys of what it leaves out of it.
struct MtlMaterial {
  Material material;
  std::vector<std::string> left_out;  ///< "Ks", "map_Kd", "illum 6"
};

/// What is unambiguous of an MTL material [FILE FORMATS 4.2, Wavefront 1995; Pr and Pm: Houston 2015]; the rest is left
/// out, and what then remains is diffuse, by Kd.
///
///   Pm 1, Pr, Kd             metal, F0 = Kd, alpha = Pr² [Burley 2012]
///   illum 3, Ks, no Kd       mirror, R = Ks             (its term Ks I_r: one ray, sharp)
///   illum 5, Ks, no Kd       metal, F0 = Ks, alpha = 0  (the same by Fresnel)
///   illum 7, Ni, no Kd, Tf 1, d 1   the boundary of a clear body with the index Ni
///   d                        opacity, of all but the last
///
/// "No" is at most a twentieth of the other part.  What is emitted (Ke) has no unit there.
/// @param channels  colours are linear red, green and blue: of channels r, g, b in any order; in another single channel
///                  their luminance; in others greys alone
/// @throws core::InputError  at the statement: no number, no part of 0 .. 1, a diffuse reflectance of 1, no Kd
MtlMaterial mtl_material(const MtlEntry& entry, const std::vector<std::string>& channels);

}  // namespace interflect::scene::io
