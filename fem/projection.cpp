#include "fem/projection.h"

#include <array>
#include <utility>

#include "core/error.h"

namespace interflect::fem {
namespace {

/// In the order of the enumeration.
constexpr std::array<std::pair<const char*, Projection>, 5> projections{{{"galerkin", Projection::galerkin},
                                                                         {"continuous", Projection::continuous},
                                                                         {"gauss-points", Projection::gauss_points},
                                                                         {"vertices", Projection::vertices},
                                                                         {"centroids", Projection::centroids}}};

}  // namespace

std::vector<std::string> projection_names() {
  std::vector<std::string> names;
  for (const auto& [name, projection] : projections) names.emplace_back(name);
  return names;
}

std::string name_of(Projection projection) { return projection_names()[static_cast<std::size_t>(projection)]; }

Projection projection_named(const std::string& name) {
  std::string known;
  for (const auto& [candidate, projection] : projections) {
    if (name == candidate) return projection;
    known += (known.empty() ? "" : ", ") + std::string(candidate);
  }
  throw core::InputError("projection '" + name + "'", "one of " + known + " expected");
}

bool at_corners(Projection projection) {
  return projection == Projection::continuous || projection == Projection::vertices;
}

}  // namespace interflect::fem
