#include "fem/error_estimate.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fem/columns.h"
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

Spectrum area_mean(const mesh::ElementMesh& mesh, std::span<const Spectrum> values) {
  Spectrum sum;
  double area = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    sum += mesh.patches()[i].area * values[i];
    area += mesh.patches()[i].area;
  }
  return sum / area;
}

/// |G^-1 K (B_h - P B_2h)|.
std::vector<Spectrum> halving_differences(const RadiositySolution& s, const DenseSymmetric& K, int channels, Run& run) {
  const solvers::ColumnMatrix difference = to_columns(s.radiosity, channels) - to_columns(s.coarse_radiosity, channels);
  solvers::ColumnMatrix arriving(difference.rows(), difference.cols());
  K.apply(difference, arriving, run);
  divide_by(arriving, K.gram());
  return to_spectra(arriving.cwiseAbs());
}

void add_discretisation(RadiositySolution& s, std::span<const Spectrum> difference) {
  s.irradiance_error.assign(difference.begin(), difference.end());
  for (const mesh::ElementMesh::Part& part : s.mesh.parts()) {
    const Spectrum of_part = 0.5 * root_mean_square(s.mesh, difference, part.first, part.count);
    for (std::size_t i = part.first; i < part.first + part.count; ++i) {
      const Spectrum of_siblings = root_mean_square(s.mesh, difference, i / 4 * 4, 4);
      s.irradiance_error[i] = max(max(s.irradiance_error[i], of_siblings), of_part);
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

SampledNoise sampled_noise(const RadiositySolution& s, const DenseSymmetric& K, int channels, Run& run) {
  const Index n = K.size();
  const auto elements = static_cast<std::size_t>(n);
  SampledNoise noise{std::vector<Spectrum>(elements), {}, std::vector<double>(elements), 0};
  if (!K.has_errors()) return noise;
  const solvers::ColumnMatrix B = to_columns(s.radiosity, channels);
  solvers::ColumnMatrix asked(n, 2 * channels + 1), found(n, 2 * channels + 1);  // B², B and 1: one pass over the errors
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

void set_noise(RadiositySolution& s, const SampledNoise& noise) {
  const Spectrum bounces = area_mean(s.mesh, s.reflectance).map([](double rho) { return rho / (1.0 - rho); });
  s.shared_noise = bounces * sqrt(noise.variance_of_mean);
  s.irradiance_noise.clear();
  for (const Spectrum& variance : noise.variance)
    s.irradiance_noise.push_back(sqrt(variance + s.shared_noise * s.shared_noise));
}

/// What rows that do not sum to 1 do to a closed scene, beyond their noise.
void add_closure(RadiositySolution& s, std::span<const double> row_sum, const SampledNoise& noise) {
  const auto beyond = [](double lacking, double standard_error) {
    return std::max(0.0, std::abs(lacking) - 2 * standard_error);
  };
  double lacking = 0, area = 0;
  for (std::size_t i = 0; i < row_sum.size(); ++i) {
    lacking += s.mesh.patches()[i].area * (1.0 - row_sum[i]);
    area += s.mesh.patches()[i].area;
  }
  const Spectrum B = area_mean(s.mesh, s.radiosity);
  const Spectrum later = area_mean(s.mesh, s.reflectance).map([](double rho) { return rho / (1.0 - rho); });
  const Spectrum of_mean = beyond(lacking / area, noise.mean_row_sum) * (later * B);
  for (std::size_t i = 0; i < row_sum.size(); ++i)
    s.irradiance_error[i] += beyond(1.0 - row_sum[i], noise.row_sum[i]) * B + of_mean;
}

}  // namespace

Spectrum irradiance_variation(const RadiositySolution& s, std::size_t element) {
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

void estimate_errors(RadiositySolution& s, const ErrorSources& from, int channels, Run& run) {
  const SampledNoise noise = sampled_noise(s, from.K, channels, run);
  set_noise(s, noise);
  if (from.both_converged)
    add_discretisation(s, halving_differences(s, from.K, channels, run));
  else
    s.irradiance_error.assign(s.radiosity.size(), Spectrum(std::numeric_limits<double>::infinity()));
  const Spectrum bounces = area_mean(s.mesh, s.reflectance).map([](double rho) { return 1.0 / (1.0 - rho); });
  double largest_reflectance = 0.0;
  Spectrum largest_radiosity;
  for (std::size_t i = 0; i < s.radiosity.size(); ++i) {
    largest_reflectance = std::max(largest_reflectance, s.reflectance[i].max());
    largest_radiosity = max(largest_radiosity, s.radiosity[i]);
  }
  // What only passes on has no such bound of its own: the mean, which is below 1, stands for it.
  const double largest = largest_reflectance < 1 ? largest_reflectance : area_mean(s.mesh, s.reflectance).max();
  const Spectrum solver = s.solver.residual() / (1.0 - largest) * largest_radiosity;
  const std::vector<Spectrum> neighbours = neighbour_errors(s, from.K, run);
  s.field_error.resize(s.radiosity.size());
  for (std::size_t i = 0; i < s.radiosity.size(); ++i) {
    s.irradiance_error[i] += neighbours[i] + from.quadrature_tolerance * (bounces * s.irradiance[i]) + solver;
    s.field_error[i] = s.reflectance[i] * irradiance_variation(s, i);
  }
  if (s.closed) add_closure(s, from.row_sum_before, noise);
}

}  // namespace interflect::fem
