#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "fem/radiosity.h"
#include "mesh/smooth_mesh.h"
#include "scene/scene.h"

namespace interflect::apps {

/// A solution of polynomials made continuous for looking: at points of elements the means of what they say.
struct SmoothField {
  mesh::SmoothMesh mesh;
  std::vector<Spectrum> radiosity, irradiance;  ///< of points
};

/// Nothing of constants.
std::optional<SmoothField> smooth_field(const fem::RadiositySolution& solution);

void write_smooth_field(const std::filesystem::path& file, const SmoothField& field, const scene::Scene& scene);

}  // namespace interflect::apps
