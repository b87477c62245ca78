#pragma once

#include <string>
#include <vector>

#include "apps/options.h"
#include "fem/tiled_assembly.h"
#include "measure/sensor_points.h"
#include "mesh/exchange_elements.h"
#include "results/factor_store.h"

namespace interflect::apps {

/// What view factors are asked of: a geometry, its elements, and its sensors' points.
struct FactorRequest {
  scene::ExchangeScene geometry;
  mesh::ExchangeElements elements;
  std::vector<measure::SensorPoint> points;
  results::FactorElements about;          ///< the elements as files have them
  std::vector<fem::CoveredPair> covered;  ///< what masks cover

  std::size_t size() const { return elements.patches.size(); }
  std::vector<measure::PointIrradiance> places() const;
  /// What the factors depend on beside settings.
  std::string digest() const { return results::geometry_digest(geometry.scene, elements.patches); }
};

/// Reads the file, says what was noted, and cuts.
/// @throws core::InputError
FactorRequest factor_request(const ViewFactorOptions& options);

/// What each element's factors are summed by.
/// @param by  "surface", "group" or "material"
std::vector<std::string> groups_of(const FactorRequest& request, const std::string& by);

}  // namespace interflect::apps
