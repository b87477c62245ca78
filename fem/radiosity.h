#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/estimate.h"
#include "fem/form_factor/method.h"
#include "fem/goal/adaptation.h"
#include "fem/polynomial_field.h"
#include "fem/projection.h"
#include "mesh/uniform.h"
#include "scene/diffuse_sides.h"
#include "solvers/solver.h"

namespace interflect::fem {

/// Where nothing is said, and no mirror is there to be seen in (specular/specular_settings.h).
inline constexpr const char* default_form_factors = "gauss-lambert";

struct RadiositySettings {
  double element_size = 0;  ///< longest edge [m]; 0: see element_size_of
  std::string form_factors = default_form_factors;
  bool form_factors_chosen = false;  ///< by name: then no others are taken, whatever there is to be seen
  int order = 0;  ///< of the polynomials on an element, 0 .. 3; from 1 on by `analytic`, `gauss-lambert` or `duffy`
  Projection projection = Projection::galerkin;
  std::string solver = "automatic";
  solvers::SolverSettings solver_settings;
  std::string intersector = "embree";
  solvers::StoppingRule stopping;
  double quadrature_tolerance = 1e-3;  ///< relative, of an entry
  double row_tolerance = 0;  ///< on the largest row's sum of errors, max_i sum_j |dF_ij|; 0: none but the entries'
  int visibility_rays = 16;
  double visibility_error = 0;  ///< standard error of the visible part of a pair that rays are added up to; 0: none are
  std::uint64_t samples = 0;    ///< of Monte Carlo methods: a pair, a row, or in all; 0: as tolerances ask
  int resolution = 256;         ///< cells across a hemicube or a plane
  double drop_below = 0;  ///< entries with F_ij and F_ji below it are left out, and accounted for; 0: all are stored
  std::string closure = "none";           ///< or a repair of row sums by its name in closure.h
  std::uint64_t environment_rays = 1296;  ///< an element: what of it sees no other, where an open scene's closure asks
  double max_memory = 4e9;                ///< [bytes]
  bool light_groups = false;              ///< solutions of each group alone too (measure/light_groups.h)
  bool rough_is_black =
      false;  ///< rough metals and glass absorb instead of being refused: what two passes leave to paths
  std::optional<AdaptiveSettings>
      adaptive;  ///< elements are made for a goal, with polynomials; `element_size` is a start
  /// Where K comes from instead of `form_factors`, if there is such a source: entries of all pairs of these elements,
  /// each once.
  std::function<void(const scene::Scene&, std::span<const scene::SurfacePatch>, ExchangeSink&)> stored_factors;
};

/// The element size asked for, or the default one [m]: that of about 2 500 elements, or, where a mesh of more facets
/// brings its own, the one that resolves the scene's area into as many.
double element_size_of(const scene::Scene& scene, const RadiositySettings& settings);

/// The scene cut into elements of that size, each four the quarters of one of twice the size.
/// @param has_elements  sides of surfaces that are cut: those that reflect diffusely, of which solutions are
/// @throws core::InputError  where they need more memory than `max_memory`, saying which element size would fit
mesh::ElementMesh elements_of(const scene::Scene& scene, const RadiositySettings& settings,
                              mesh::HasElements has_elements = scene::is_diffuse_side);

/// What an element carries beside K [bytes].
constexpr double bytes_of_an_element = 4000;

/// The same where no matrix is stored: by what elements carry themselves.
mesh::ElementMesh elements_alone(const scene::Scene& scene, const RadiositySettings& settings,
                                 double bytes_of_each = bytes_of_an_element);

/// Of the polynomials that K is made for; between the corners of quads one that holds what is bilinear.
int order_of_blocks(const RadiositySettings& settings, std::span<const scene::SurfacePatch> patches);

/// The solver asked for.  @throws core::InputError  no such name, or settings out of its range
std::unique_ptr<solvers::RadiositySolver> solver_of(const RadiositySettings& settings);

/// @throws core::InputError  where settings do not go together: what polynomials of order 1 and more cannot have, yet, or
///                           a solver that samples
void require_compatible(const RadiositySettings& settings);

/// What a solve will need, said before it starts; where elements are made for a goal, its first pass.
struct Forecast {
  double elements, bytes, seconds;
};
/// @throws core::InputError  as `require_compatible` and `elements_of`
Forecast forecast(const scene::Scene& scene, const RadiositySettings& settings, const Run& run);

/// @throws core::InputError  where these elements, by such a method, need more than `max_memory`, saying what would fit
void require_memory(const scene::Scene& scene, double elements, const RadiositySettings& settings,
                    FormFactorMethod::Granularity granularity);

bool fits_memory(double elements, const RadiositySettings& settings, FormFactorMethod::Granularity granularity);

struct StageCost {
  std::string stage;
  double seconds;
  double peak_bytes;  ///< most memory that the process ever had, when the stage ended
};

/// Where the flux goes [W | lm], per channel:
///   emitted = absorbed + escaped + on_backs + in_mirrors + form_factor_error + residual.
struct EnergyBalance {
  Spectrum emitted, absorbed;
  /// What leaves the elements and reaches none, by rays: through openings, on black backs, in mirrors and glass.
  Spectrum escaped, on_backs, in_mirrors;
  Spectrum split_error, on_backs_error;  ///< standard errors of all three together, and of on_backs alone
  /// sum_i (1 - row sum_i) A_i B_i - those three: what row sums and rays disagree about.
  Spectrum form_factor_error;
  /// emitted - absorbed - sum_i (1 - row sum_i) A_i B_i: solver error alone.
  Spectrum residual;
};

struct RowSums {
  double mean = 0, lowest = 0, highest = 0;  ///< of sum_j F_ij; 1 in a closed scene
};

/// A solved scene: constants on elements, or means of polynomials on them (`field`), all per element in the order of
/// the mesh.
struct RadiositySolution {
  RadiositySolution(mesh::ElementMesh elements, double longest_edge)
      : mesh(std::move(elements)), element_size(longest_edge) {}

  mesh::ElementMesh mesh;
  double element_size;
  std::vector<Spectrum> exitance, reflectance, radiosity, irradiance;
  /// Estimated bound on |bias| of the element's mean H: discretisation, quadrature, solver, closure.
  std::vector<Spectrum> irradiance_error;
  std::vector<Spectrum> irradiance_noise;  ///< standard error of H from sampled visibility, all in all
  Spectrum
      shared_noise;  ///< the part of it that is one and the same deviation in all elements; the rest is independent
  /// |B_1 - B_h|: root mean square over the element of the iterated radiosity less B_h.
  std::vector<Spectrum> field_error;
  std::vector<Spectrum> coarse_radiosity;  ///< the solution at twice the element size: its parent's value; with
                                           ///< polynomials the mean of that of the order below (by rays: its own)
  std::optional<PolynomialField> field;    ///< none of constants
  std::optional<Adaptation> adaptation;    ///< of elements that were made for a goal
  std::vector<double> row_sum;             ///< sum_j F_ij
  bool closed = false;                     ///< no ray that left an element was lost
  solvers::SolverReport solver;
  std::string form_factors;  ///< the method; empty where there were none
  PairCounts pairs;
  RowSums rows;
  double closure_correction = 0;  ///< ||K' - K|| / ||K||, Frobenius; 0 where none was asked for
  /// F_i,env of an open scene whose closure was repaired: sum_j F_ij + F_i,env = 1; else empty.
  std::vector<double> environment;
  double largest_row_error = 0;                  ///< stated: max_i sum_j |dF_ij|; 0 where it was not counted
  bool tolerance_met = true;                     ///< the rows', where one was asked for
  double kept_share = 1;                         ///< of the pairs of elements, stored in K
  double largest_dropped = 0, mean_dropped = 0;  ///< sum_j F_ij over what is not; the mean is by area
  EnergyBalance energy;
  std::vector<StageCost> stages;
  double bytes = 0;  ///< memory of the operator
  /// By the same form factors what each light group does alone, where that was asked for: without energy and stages.
  std::vector<RadiositySolution> of_groups;

  /// Variance of an element's H that is its own, independent of the other elements'.
  Spectrum own_variance(std::size_t element) const {
    return irradiance_noise[element] * irradiance_noise[element] - shared_noise * shared_noise;
  }
};

/// Mean of F_i,env by area; 0 where it is not known.
double mean_environment(const RadiositySolution& solution);

/// Cuts, computes form factors, solves on the elements and on elements of twice the size (whose K is the sum of their
/// children's, so that visibility is sampled once), and estimates the error from the difference (error_estimate.h); or
/// without any matrix, by a solver that samples (sampled_radiosity.h).  Where nothing emits there is nothing to compute
/// (dark_solution.h).  Beside mirrors and smooth glass elements also
/// exchange light by way of these (specular/specular_chains.h), where they are coloured channel by channel.
/// @throws core::InputError   no elements, too little memory, unknown names, a closure that cannot be (closure.h)
/// @throws core::Interrupted
RadiositySolution solve_radiosity(const scene::Scene& scene, const RadiositySettings& settings, Run& run);

}  // namespace interflect::fem
