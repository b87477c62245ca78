#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/factor_request.h"
#include "raycast/ray_caster.h"

namespace interflect::apps {

/// A surface whose share of every element's view is asked for.
struct ViewedSurface {
  std::string name;
  std::vector<Index> elements;
};

/// @param name  of a side of a surface ("lamp", "plate/back"), or a group
/// @throws core::InputError  none of that name has view factors: with those that have, if few
ViewedSurface viewed_surface(const std::string& name, const FactorRequest& request);

/// Of every element the view factor to the surface, sum_{s in S} F_js, the share of j's view that S fills, with the sum
/// of its entries' errors, row sums and their errors: F.view.vtu beside F.h5, and where VTK was built in F.view.png,
/// from the scene's first pinhole camera, or from outside.
void write_view_of(const ViewedSurface& surface, const FactorRequest& request, const results::FactorStore& store,
                   const raycast::RayCaster& rays, const std::filesystem::path& out);

}  // namespace interflect::apps
