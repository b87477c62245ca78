#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"

/// Files of geometry, read for the exchange of radiation alone.
namespace interflect::scene {

/// What a surface does in an exchange.
enum class ExchangeRole : std::uint8_t {
  radiates,      ///< has view factors, and hides what is behind it
  only_occludes  ///< has none, and hides all the same
};

/// What a file says of a surface beside its shape.
struct ExchangeSurface {
  /// What its factors may be summed by: the mesh file's group and material ("GROUP/MATERIAL"), the .vs3 surface that it
  /// is combined with, or its own name.
  std::string group;
  ExchangeRole role = ExchangeRole::radiates;
  std::optional<double> emittance;  ///< of a .vs3 file, in (0, 1]
};

/// A surface that lies on another and faces it (a mask of View3D): the two see each other and nothing else.  The base
/// lacks that part in the scene; in the exchange its area is larger by `area`, and K between the mask and the base is
/// `area`.
struct ExchangeMask {
  std::string name;
  SurfaceId base;
  double area;           ///< [m²]
  double emittance;      ///< in (0, 1]
  geometry::Ring ring;   ///< counter-clockwise seen from the base [m]
  std::string material;  ///< as of surfaces with that emittance
};

struct ExchangeScene {
  Scene scene;
  std::vector<ExchangeSurface> surfaces;  ///< beside scene.surfaces
  std::vector<ExchangeMask> masks;
};

/// The masks alone: surface k is mask k, facing its base.  Such a scene is cut into elements as others are; what lies
/// opposite to an element of it is the part of the base that it covers.
Scene scene_of_masks(const ExchangeScene& geometry);

struct GeometryOptions {
  /// m (where nothing is said), cm, mm, ft, in.  A scene file says its own: it is refused there.
  std::optional<std::string> unit;
  bool two_sided = false;     ///< backs see too: thin plates.  A scene file says so itself: it is refused there
  bool whole_groups = false;  ///< of mesh files: a surface for each group and material, not for each face
  std::vector<std::string> only_occlude;  ///< surfaces or groups that have no view factors
  std::vector<std::string> left_out;      ///< surfaces or groups that neither radiate nor occlude
};

/// Reads a mesh (OBJ, PLY, STL, glTF, GLB, VTU, VTP), View3D's .vs3, or a scene file (.json), as its extension says.
///
/// A mesh becomes a surface a face, named GROUP/MATERIAL/NUMBER (the face's number in the file, from 1; left out where
/// the group has one face), of a neutral material: reflectance 0.5, no exitance.  A .vs3 surface keeps its name, and
/// the reflectance is what its emittance leaves; parts that subsurfaces, masks and null surfaces cover are cut out of
/// it.  A scene file stays as it is.
/// @throws core::InputError  "FILE: .." or "FILE:LINE: ..": anything that is not such a file, or a name that it does
/// not have
ExchangeScene read_geometry_as_scene(const std::filesystem::path& file, const GeometryOptions& options = {});

}  // namespace interflect::scene
