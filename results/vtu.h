#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/spectrum.h"
#include "mesh/element_mesh.h"
#include "mesh/smooth_mesh.h"

namespace interflect::results {

/// Values of the elements of a mesh, or of a smooth one's points, under one name.
struct CellField {
  using Values = std::variant<std::vector<double>, std::vector<std::int32_t>, std::vector<std::int64_t>>;

  std::string name;
  Values values;  ///< [element or point * components + component]
  int components = 1;
  std::vector<std::string> component_names;  ///< empty, or one a component
};

CellField scalar_field(std::string name, std::vector<double> values);
/// One component per channel, under the channels' names; a plain scalar where there is one channel.
CellField spectrum_field(std::string name, std::span<const Spectrum> values, const std::vector<std::string>& channels);
/// What has no elements and is written behind them (mesh/bare_patches.h).
using BarePatches = std::span<const scene::SurfacePatch>;
/// element (0 .., and -1 of what has none), surface (position in the scene) and side (0 front, 1 back).
std::vector<CellField> id_fields(const mesh::ElementMesh& mesh, BarePatches bare = {});

/// A mesh of triangles and quads with cell data as VTK's XML UnstructuredGrid (version 1.0, little-endian, base64), for
/// ParaView and everything else that reads VTK.  Corners that elements of one side of a surface share are written once.
/// @param bare  cells behind those of the elements.  A field of elements alone is NaN there, which ParaView shows in its
///              NaN colour, and one of integers -1
/// @throws core::PreconditionError  if a field's size is neither elements nor cells, times components
std::string vtu_text(const mesh::ElementMesh& mesh, std::span<const CellField> fields, BarePatches bare = {});
void write_vtu(const std::filesystem::path& file, const mesh::ElementMesh& mesh, std::span<const CellField> fields,
               BarePatches bare = {});

/// A smooth mesh as VTK's quadratic triangles with data at points, and the element of each.
std::string vtu_text(const mesh::SmoothMesh& mesh, std::span<const CellField> of_points);
void write_vtu(const std::filesystem::path& file, const mesh::SmoothMesh& mesh, std::span<const CellField> of_points);

/// Base64 of RFC 4648, with padding.
std::string base64(std::string_view bytes);

}  // namespace interflect::results
