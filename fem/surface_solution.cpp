#include "fem/surface_solution.h"

#include <memory>
#include <vector>

#include "core/estimate.h"
#include "fem/form_factor/element_locator.h"

namespace interflect::fem {
namespace {

using Known = measure::SurfaceSolution::Known;

/// What light of mirrors may vary by inside an element, as its siblings do, and its noise.
Spectrum error_of(const MirroredLight& mirrored, const mesh::ElementMesh& mesh, std::size_t i) {
  const std::size_t first = i / 4 * 4;
  Spectrum sum;
  double area = 0;
  for (std::size_t k = first; k < first + 4; ++k) {
    sum += mesh.patches()[k].area * mirrored.irradiance[k];
    area += mesh.patches()[k].area;
  }
  Spectrum most;
  for (std::size_t k = first; k < first + 4; ++k) most = max(most, abs(mirrored.irradiance[k] - sum / area));
  return most + normal_95 * mirrored.standard_error[i];
}

/// Element by element, and of what has none.
struct Table {
  explicit Table(std::span<const scene::SurfacePatch> patches) : locate(patches) {}

  ElementLocator locate;
  std::vector<Known> of_elements;
  Known nothing{};
};

}  // namespace

measure::SurfaceSolution as_surface_solution(const RadiositySolution& s, const MirroredLight& mirrored) {
  const auto table = std::make_shared<Table>(s.mesh.patches());
  for (std::size_t i = 0; i < s.irradiance.size(); ++i) {
    const Spectrum& rho = s.reflectance[i];
    table->of_elements.push_back({.reflected = rho * s.irradiance[i],
                                  .error_bound = rho * s.irradiance_error[i] + s.field_error[i],
                                  .own_noise = rho * sqrt(max(s.own_variance(i), Spectrum::zero())),
                                  .shared_noise = rho * s.shared_noise,
                                  .mirrored = rho * mirrored.irradiance[i],
                                  .mirrored_error = rho * error_of(mirrored, s.mesh, i),
                                  .cell = static_cast<std::uint32_t>(i)});
  }
  measure::SurfaceSolution solution;
  solution.at = [table](const scene::SurfacePoint& at) -> const Known& {
    const Index element = table->locate(at);
    return element == ElementLocator::none ? table->nothing : table->of_elements[static_cast<std::size_t>(element)];
  };
  return solution;
}

}  // namespace interflect::fem
