#include "fem/error_estimate.h"

#include <algorithm>
#include <cmath>

#include "fem/columns.h"
#include "fem/neighbour_error.h"

namespace interflect::fem {

namespace {

Spectrum root(const Spectrum& s) {
  return s.map([](double v) { return std::sqrt(v); });
}
Spectrum larger(const Spectrum& a, const Spectrum& b) {
  Spectrum out;
  for (int c = 0; c < Spectrum::capacity; ++c) out[c] = std::max(a[c], b[c]);
  return out;
}

/// Area-weighted root mean square of some of the elements' values.
Spectrum root_mean_square(const mesh::ElementMesh& mesh, std::span<const Spectrum> values, std::size_t first,
                          std::size_t count) {
  Spectrum sum;
  double area = 0.0;
  for (std::size_t i = first; i < first + count; ++i) {
    sum += mesh.patches()[i].area * (values[i] * values[i]);
    area += mesh.patches()[i].area;
  }
  return root(sum / area);
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
      s.irradiance_error[i] = larger(larger(s.irradiance_error[i], of_siblings), of_part);
    }
  }
}

/// Variance of one bounce, and then the share of later ones.
void estimate_noise(RadiositySolution& s, const DenseSymmetric& K, int channels, Run& run) {
  const solvers::ColumnMatrix B = to_columns(s.radiosity, channels);
  solvers::ColumnMatrix variance = solvers::ColumnMatrix::Zero(B.rows(), B.cols());
  if (K.has_errors()) K.variance(B, variance, run);
  divide_by(variance, K.gram());
  divide_by(variance, K.gram());
  s.irradiance_noise = to_spectra(variance);
  Spectrum of_mean;
  double area = 0.0;
  for (const auto& patch : s.mesh.patches()) area += patch.area;
  for (std::size_t i = 0; i < s.irradiance_noise.size(); ++i) {
    const double share = s.mesh.patches()[i].area / area;
    of_mean += share * share * s.irradiance_noise[i];
  }
  const Spectrum bounces = area_mean(s.mesh, s.reflectance).map([](double rho) { return rho / (1.0 - rho); });
  for (Spectrum& noise : s.irradiance_noise) noise = root(noise + bounces * bounces * of_mean);
}

/// Standard errors of the row sums.
std::vector<double> row_sum_noise(const DenseSymmetric& K, Run& run) {
  solvers::ColumnMatrix variance = solvers::ColumnMatrix::Zero(K.size(), 1);
  if (K.has_errors()) K.variance(solvers::ColumnMatrix::Ones(K.size(), 1), variance, run);
  std::vector<double> noise(static_cast<std::size_t>(K.size()));
  for (std::size_t i = 0; i < noise.size(); ++i) noise[i] = std::sqrt(variance(static_cast<Index>(i), 0)) / K.gram()[i];
  return noise;
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
  return root(sum / 3.0);
}

void estimate_errors(RadiositySolution& s, const ErrorSources& from, int channels, Run& run) {
  add_discretisation(s, halving_differences(s, from.K, channels, run));
  estimate_noise(s, from.K, channels, run);
  const std::vector<double> row_noise = row_sum_noise(from.K, run);
  const Spectrum mean_radiosity = area_mean(s.mesh, s.radiosity);
  const Spectrum bounces = area_mean(s.mesh, s.reflectance).map([](double rho) { return 1.0 / (1.0 - rho); });
  double largest_reflectance = 0.0;
  Spectrum largest_radiosity;
  for (std::size_t i = 0; i < s.radiosity.size(); ++i) {
    largest_reflectance = std::max(largest_reflectance, s.reflectance[i].max());
    largest_radiosity = larger(largest_radiosity, s.radiosity[i]);
  }
  const Spectrum solver = s.solver.residual() / (1.0 - largest_reflectance) * largest_radiosity;
  const std::vector<Spectrum> neighbours = neighbour_errors(s, from.K, run);
  s.field_error.resize(s.radiosity.size());
  for (std::size_t i = 0; i < s.radiosity.size(); ++i) {
    s.irradiance_error[i] += neighbours[i] + from.quadrature_tolerance * (bounces * s.irradiance[i]) + solver;
    if (s.closed)
      s.irradiance_error[i] +=
          std::max(0.0, std::abs(1.0 - from.row_sum_before[i]) - 2 * row_noise[i]) * mean_radiosity;
    s.field_error[i] = s.reflectance[i] * irradiance_variation(s, i);
  }
}

}  // namespace interflect::fem
