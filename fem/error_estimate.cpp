#include "fem/error_estimate.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fem/columns.h"
#include "fem/dropped_irradiance.h"
#include "fem/neighbour_error.h"

namespace interflect::fem {

namespace {

/// Area-weighted root mean square of some of the elements' values.
Spectrum root_mean_square(const mesh::ElementMesh& mesh, std::span<const Spectrum> values, std::size_t first,
                          std::size_t count) {
  Spectrum sum;
  double area = 0.0;
  for (std::size_t i = first; i < first + count; ++i) {
    sum += mesh.patches()[i].area * (values[i] * values[i]);
    area += mesh.patches()[i].area;
  }
  return sqrt(sum / area);
}

/// |G^-1 K (B_h - P B_2h)|.
std::vector<Spectrum> halving_differences(const RadiositySolution& s, const SymmetricOperator& K, int channels,
                                          Run& run) {
  const solvers::ColumnMatrix difference = to_columns(s.radiosity, channels) - to_columns(s.coarse_radiosity, channels);
  solvers::ColumnMatrix arriving(difference.rows(), difference.cols());
  K.apply(difference, arriving, run);
  divide_by(arriving, K.gram());
  return to_spectra(arriving.cwiseAbs());
}

/// @param in_fours  elements are the quarters of others, four after four
void add_discretisation(RadiositySolution& s, std::span<const Spectrum> difference, bool in_fours) {
  s.irradiance_error.assign(difference.begin(), difference.end());
  for (const mesh::ElementMesh::Part& part : s.mesh.parts()) {
    const Spectrum of_part = 0.5 * root_mean_square(s.mesh, difference, part.first, part.count);
    for (std::size_t i = part.first; i < part.first + part.count; ++i) {
      s.irradiance_error[i] = max(s.irradiance_error[i], of_part);
      if (in_fours)
        s.irradiance_error[i] = max(s.irradiance_error[i], root_mean_square(s.mesh, difference, i / 4 * 4, 4));
    }
  }
}

/// What the sampled visibility of K does to irradiance and to row sums.
struct SampledNoise {
  std::vector<Spectrum> variance;  ///< of each element's irradiance, one bounce
  Spectrum variance_of_mean;       ///< of the mean irradiance, one bounce
  std::vector<double> row_sum;     ///< standard errors
  double mean_row_sum = 0;         ///< standard error
};

SampledNoise sampled_noise(const RadiositySolution& s, const SymmetricOperator& K, int channels, Run& run) {
  const Index n = K.size();
  const auto elements = static_cast<std::size_t>(n);
  SampledNoise noise{std::vector<Spectrum>(elements), {}, std::vector<double>(elements), 0};
  if (!K.has_errors()) return noise;
  const solvers::ColumnMatrix B = to_columns(s.radiosity, channels);
  solvers::ColumnMatrix asked(n, 2 * channels + 1),
      found(n, 2 * channels + 1);  // B², B and 1: one pass over the errors
  asked << B.array().square().matrix(), B, solvers::ColumnMatrix::Ones(n, 1);
  K.apply_variances(asked, found, run);
  double area = 0, row_sums = 0;
  for (Index i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double A = K.gram()[k];
    for (int c = 0; c < channels; ++c) {
      noise.variance[k][c] = found(i, c) / (A * A);
      noise.variance_of_mean[c] += found(i, c) + B(i, c) * found(i, channels + c);
    }
    noise.row_sum[k] = std::sqrt(found(i, 2 * channels)) / A;
    row_sums += 2 * found(i, 2 * channels);
    area += A;
  }
  noise.variance_of_mean /= area * area;
  noise.mean_row_sum = std::sqrt(row_sums) / area;
  return noise;
}

/// v_i + sum_j ((F_ij rho_j)² v_j + 2 e_ij² B_j F_ij rho_j B_i / (A_i A_j)): one bounce more, by way of j, of noise
/// that is independent but for that of K_ij = K_ji, which both bounces have.
/// @param variance  of irradiance, and coefficients of radiosity: unknowns x channels
solvers::ColumnMatrix with_next_bounce(const SymmetricOperator& K, const solvers::ColumnMatrix& variance,
                                       const solvers::ColumnMatrix& reflectance, const solvers::ColumnMatrix& B,
                                       const Run& run) {
  const Eigen::Map<const Eigen::VectorXd> G(K.gram().data(), K.size());
  const solvers::ColumnMatrix reflected = reflectance.array().square() * variance.array();
  solvers::ColumnMatrix next =
      K.sums_by_row(run, variance.cols(), [&](const StoredPair& p, solvers::ColumnMatrix& sums) {
        const Eigen::RowVectorXd both =
            2 * p.standard_error * p.standard_error * p.K * B.row(p.a).cwiseProduct(B.row(p.b));
        sums.row(p.a) += p.K * p.K * reflected.row(p.b) + both.cwiseProduct(reflectance.row(p.b)) / G[p.b];
        if (p.a == p.b) return;
        sums.row(p.b) += p.K * p.K * reflected.row(p.a) + both.cwiseProduct(reflectance.row(p.a)) / G[p.a];
      });
  next.array().colwise() /= G.array().square();
  return (variance + next).cwiseMax(0.0);
}

/// Of constants: one bounce is known.
void add_next_bounce(const RadiositySolution& s, const SymmetricOperator& K, int channels, SampledNoise& noise,
                     const Run& run) {
  noise.variance =
      to_spectra(with_next_bounce(K, to_columns(noise.variance, channels), to_columns(s.reflectance, channels),
                                  to_columns(s.radiosity, channels), run));
}

/// Of polynomials: what all functions of other elements bring to an element's mean.
void set_noise_of_functions(const RadiositySolution& s, const SymmetricOperator& blocks, int channels,
                            SampledNoise& noise, Run& run) {
  const Index functions = s.field->functions;
  const Eigen::Map<const Eigen::VectorXd> G(blocks.gram().data(), blocks.size());
  const solvers::ColumnMatrix squares = s.field->radiosity.array().square().matrix();
  solvers::ColumnMatrix variance(squares.rows(), channels), rho(squares.rows(), channels);
  blocks.apply_variances(squares, variance, run);
  variance.array().colwise() /= G.array().square();
  for (Index u = 0; u < rho.rows(); ++u)
    for (int c = 0; c < channels; ++c) rho(u, c) = s.reflectance[static_cast<std::size_t>(u / functions)][c];
  variance = with_next_bounce(blocks, variance, rho, s.field->radiosity, run);
  for (std::size_t i = 0; i < noise.variance.size(); ++i)
    for (int c = 0; c < channels; ++c) noise.variance[i][c] = variance(static_cast<Index>(i) * functions, c);
}

void set_noise(RadiositySolution& s, const SampledNoise& noise) {
  s.shared_noise = later_bounces(s) * sqrt(noise.variance_of_mean);
  s.irradiance_noise.clear();
  for (const Spectrum& variance : noise.variance)
    s.irradiance_noise.push_back(sqrt(variance + s.shared_noise * s.shared_noise));
}

/// What rows lack that are known to add up to 1, with the environment's part, beside what was dropped.
struct Lacking {
  std::vector<double> row, standard_error;
  double mean = 0, mean_standard_error = 0;  ///< by area
};

Lacking lacking(const RadiositySolution& s, const ErrorSources& from, const SampledNoise& noise) {
  Lacking lack{std::vector<double>(from.row_sum_before.size()), noise.row_sum, 0, 0};
  double area = 0, variance = 0;
  for (std::size_t i = 0; i < lack.row.size(); ++i) {
    const double A = s.mesh.patches()[i].area;
    lack.row[i] = 1.0 - from.row_sum_before[i] - (from.K.dropped().empty() ? 0.0 : from.K.dropped()[i]);
    if (from.environment != nullptr) {
      const double error = from.environment->standard_error[i];
      lack.row[i] -= from.environment->factor[i];
      lack.standard_error[i] = std::hypot(lack.standard_error[i], error);
      variance += A * A * error * error;
    }
    lack.mean += A * lack.row[i];
    area += A;
  }
  lack.mean /= area;
  lack.mean_standard_error = std::hypot(noise.mean_row_sum, std::sqrt(variance) / area);
  return lack;
}

/// What rows that do not add up to 1 do, beyond their noise.
void add_closure(RadiositySolution& s, const Lacking& lack) {
  const auto beyond = [](double lacking, double standard_error) {
    return std::max(0.0, std::abs(lacking) - 2 * standard_error);
  };
  const Spectrum B = area_mean(s.mesh, s.radiosity);
  const Spectrum of_mean = beyond(lack.mean, lack.mean_standard_error) * (later_bounces(s) * B);
  for (std::size_t i = 0; i < lack.row.size(); ++i)
    s.irradiance_error[i] += beyond(lack.row[i], lack.standard_error[i]) * B + of_mean;
}

Spectrum largest(std::span<const Spectrum> values) {
  Spectrum most;
  for (const Spectrum& value : values) most = max(most, value);
  return most;
}

/// What entries that were left out do, at first and in later bounces.
void add_dropped(RadiositySolution& s, const SymmetricOperator& K, int channels, const Run& run) {
  if (K.dropped().empty()) return;
  const std::vector<Spectrum> first = to_spectra(dropped_irradiance(K, to_columns(s.radiosity, channels), run));
  const Spectrum later = later_bounces(s) * area_mean(s.mesh, first);
  for (std::size_t i = 0; i < first.size(); ++i) s.irradiance_error[i] += first[i] + later;
}

void add_quadrature(RadiositySolution& s, const ErrorSources& from) {
  const Spectrum bounces = area_mean(s.mesh, s.reflectance).map([](double rho) { return 1.0 / (1.0 - rho); });
  const Spectrum B = area_mean(s.mesh, s.radiosity);
  const bool counted = !from.row_bound.empty();
  const double tolerance = counted ? 0 : from.quadrature_tolerance;
  const std::span<const double> of_rows = counted ? from.row_bound : from.beyond_tolerance;
  for (std::size_t i = 0; i < s.irradiance.size(); ++i) {
    const double of_row = of_rows.empty() ? 0 : of_rows[i];
    s.irradiance_error[i] += bounces * (tolerance * s.irradiance[i] + of_row * max(s.irradiance[i], B));
  }
}

void add_solver(RadiositySolution& s) {
  double largest_reflectance = 0.0;
  for (const Spectrum& rho : s.reflectance) largest_reflectance = std::max(largest_reflectance, rho.max());
  // What only passes on has no such bound of its own: the mean, which is below 1, stands for it.
  const double rho = largest_reflectance < 1 ? largest_reflectance : area_mean(s.mesh, s.reflectance).max();
  const Spectrum error = s.solver.residual() / (1.0 - rho) * largest(s.radiosity);
  for (Spectrum& e : s.irradiance_error) e += error;
}

/// What irradiance does inside elements, and what that does to their neighbours.
void add_field(RadiositySolution& s, const ErrorSources& from, Run& run) {
  const auto neighbours =
      from.polynomials != nullptr ? std::vector<Spectrum>(s.radiosity.size()) : neighbour_errors(s, from.K, run);
  s.field_error.resize(s.radiosity.size());
  for (std::size_t i = 0; i < s.radiosity.size(); ++i) {
    s.irradiance_error[i] += neighbours[i];
    s.field_error[i] =
        s.reflectance[i] * (from.polynomials != nullptr ? from.polynomials->variation[i] : irradiance_variation(s, i));
  }
}

}  // namespace

Spectrum area_mean(const mesh::ElementMesh& mesh, std::span<const Spectrum> values) {
  Spectrum sum;
  double area = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    sum += mesh.patches()[i].area * values[i];
    area += mesh.patches()[i].area;
  }
  return sum / area;
}

Spectrum later_bounces(const RadiositySolution& s) {
  return area_mean(s.mesh, s.reflectance).map([](double rho) { return rho / (1.0 - rho); });
}

Spectrum irradiance_variation(const RadiositySolution& s, std::size_t element) {
  if (s.field) return s.field->irradiance_variation(element);
  const std::size_t first = element / 4 * 4;
  Spectrum mean;
  double area = 0.0;
  for (std::size_t k = first; k < first + 4; ++k) {
    mean += s.mesh.patches()[k].area * s.irradiance[k];
    area += s.mesh.patches()[k].area;
  }
  mean /= area;
  std::array<Spectrum, 4> deviation;
  Spectrum sum;
  for (std::size_t k = 0; k < 4; ++k) {
    deviation[k] = s.irradiance[first + k] - mean;
    sum += s.mesh.patches()[first + k].area / area * (deviation[k] * deviation[k]);
  }
  return sqrt(sum / 3.0);
}

/// sqrt(size² - variance), or 0.
static Spectrum without_noise(const Spectrum& size, const Spectrum& variance) {
  return (size * size - variance).map([](double square) { return std::sqrt(std::max(0.0, square)); });
}

/// The variation of irradiance inside an element, less what independent noise of siblings makes of it: (1 - 1/4) / 3 of
/// its variance.
static Spectrum variation_without_noise(const RadiositySolution& s, std::size_t i) {
  return without_noise(irradiance_variation(s, i), .25 * s.own_variance(i));
}

void estimate_errors_of_polynomials_alone(RadiositySolution& s, std::span<const Spectrum> added) {
  const PolynomialField& field = *s.field;
  add_discretisation(s, added, false);
  const Spectrum later = later_bounces(s) * area_mean(s.mesh, added);
  for (std::size_t i = 0; i < added.size(); ++i) {
    const Index first = static_cast<Index>(i) * field.functions;
    const Spectrum size = PolynomialField::of_degree(field.order, field.irradiance, first),
                   noise = PolynomialField::of_degree(field.order, field.irradiance_noise, first);
    s.irradiance_error[i] += later;
    s.field_error.push_back(s.reflectance[i] * without_noise(size, noise * noise));
  }
}

void estimate_errors_alone(RadiositySolution& s, std::span<const Spectrum> bound, const Spectrum& missing,
                           const Arriving& arriving) {
  std::vector<Spectrum> variation;
  for (std::size_t i = 0; i < s.irradiance.size(); ++i) {
    variation.push_back(variation_without_noise(s, i));
    s.field_error.push_back(s.reflectance[i] * variation[i]);
  }
  const Spectrum of_all = area_mean(s.mesh, s.field_error), later = later_bounces(s);
  const std::vector<Spectrum> seen = arriving ? arriving(s.field_error) : std::vector<Spectrum>();
  for (std::size_t i = 0; i < s.irradiance.size(); ++i) {
    const Spectrum of_factors = bound.empty() ? Spectrum::zero() : bound[i];
    const Spectrum first = of_factors + (seen.empty() ? of_all : max(of_all, seen[i]));
    s.irradiance_error.push_back(missing + variation[i] + first + later * (of_all + of_factors));
  }
}

std::vector<Spectrum> means_of_fours(const mesh::ElementMesh& mesh, std::span<const Spectrum> values) {
  std::vector<Spectrum> means;
  for (std::size_t first = 0; first < values.size(); first += 4) {
    Spectrum sum;
    double area = 0;
    for (std::size_t k = first; k < first + 4; ++k) {
      sum += mesh.patches()[k].area * values[k];
      area += mesh.patches()[k].area;
    }
    means.insert(means.end(), 4, sum / area);
  }
  return means;
}

void estimate_errors(RadiositySolution& s, const ErrorSources& from, int channels, Run& run) {
  SampledNoise noise = sampled_noise(s, from.K, channels, run);
  if (from.K.has_errors()) {
    if (s.field && from.blocks != nullptr)
      set_noise_of_functions(s, *from.blocks, channels, noise, run);
    else
      add_next_bounce(s, from.K, channels, noise, run);
  }
  set_noise(s, noise);
  if (from.both_converged)
    add_discretisation(
        s,
        from.polynomials != nullptr ? from.polynomials->mean_irradiance : halving_differences(s, from.K, channels, run),
        from.polynomials == nullptr);
  else
    s.irradiance_error.assign(s.radiosity.size(), Spectrum(std::numeric_limits<double>::infinity()));
  add_quadrature(s, from);
  add_solver(s);
  add_dropped(s, from.K, channels, run);
  add_field(s, from, run);
  if (s.closed || from.environment != nullptr) add_closure(s, lacking(s, from, noise));
}

}  // namespace interflect::fem
