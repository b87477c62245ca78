#include "fem/method_comparison.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/format.h"
#include "core/seconds_since.h"
#include "fem/assembly.h"
#include "fem/operator/dense_symmetric.h"
#include "fem/row_errors.h"

namespace interflect::fem {

namespace {

/// One setting of one method.
struct Trial {
  std::string method, setting;
  std::function<void(FormFactorContext&)> set;
};

Trial with_tolerance(const std::string& method, double tolerance) {
  return {method, core::format("tolerance %g", tolerance), [=](FormFactorContext& c) { c.tolerance = tolerance; }};
}
Trial with_rays(const std::string& method, int rays) {
  return {method, core::format("rays %d", rays), [=](FormFactorContext& c) { c.visibility_rays = rays; }};
}
Trial with_resolution(const std::string& method, int resolution) {
  return {method, core::format("resolution %d", resolution), [=](FormFactorContext& c) { c.resolution = resolution; }};
}
Trial with_samples(const std::string& method, std::uint64_t samples) {
  return {method, core::format("samples %llu", static_cast<unsigned long long>(samples)),
          [=](FormFactorContext& c) { c.samples = samples; }};
}

/// How many a method gets: of a pair, of a row, or in all.
std::vector<std::uint64_t> sample_ladder(const std::string& name) {
  if (name == "area-to-area") return {128, 1024};
  if (name == "global-lines") return {10'000, 100'000, 1'000'000};
  return {256, 4096, 65536};
}

/// A ladder of what a method's accuracy depends on, from coarse to fine.
std::vector<Trial> ladder(const std::string& name) {
  std::vector<Trial> out;
  switch (setting_of(name)) {
    case Setting::tolerance:
      for (const double t : name == "hybrid" ? std::vector{0.5, 0.1} : std::vector{0.1, 1e-2, 1e-3})
        out.push_back(with_tolerance(name, t));
      break;
    case Setting::rays:
      for (const int rays : {4, 16, 64, 256}) out.push_back(with_rays(name, rays));
      break;
    case Setting::samples:
      for (const std::uint64_t samples : sample_ladder(name)) out.push_back(with_samples(name, samples));
      break;
    case Setting::resolution:
      for (const int resolution : {32, 128, 512}) out.push_back(with_resolution(name, resolution));
      break;
  }
  return out;
}

std::vector<Trial> trials() {
  std::vector<Trial> out;
  for (const std::string& name : form_factor_names())
    for (Trial& trial : ladder(name)) out.push_back(std::move(trial));
  return out;
}

std::vector<double> areas_of(std::span<const scene::SurfacePatch> patches) {
  std::vector<double> areas;
  for (const scene::SurfacePatch& patch : patches) areas.push_back(patch.area);
  return areas;
}

void judge(const DenseSymmetric& K, const DenseSymmetric& exact, MethodScore& score) {
  const Index n = K.size();
  double area = 0;
  for (Index a = 0; a < n; ++a) {
    double off = 0, sum = 0;
    for (Index b = 0; b < n; ++b) {
      const double difference = K.entry(a, b) - exact.entry(a, b);
      off += std::abs(difference);
      sum += difference;
    }
    const double of_row = K.gram()[static_cast<std::size_t>(a)];
    score.largest_row_error = std::max(score.largest_row_error, off / of_row);
    score.energy_error = std::max(score.energy_error, std::abs(sum) / of_row);
    score.mean_row_error += off;
    area += of_row;
  }
  score.mean_row_error /= area;
}

/// What a method says that its rows are off by, at most.
double largest_of(std::span<const double> row_errors) {
  return *std::max_element(row_errors.begin(), row_errors.end());
}

/// Makes what all are held against.
MethodScore score_of_reference(const FormFactorContext& context, double tolerance, DenseSymmetric& exact, Run& run) {
  const auto start = std::chrono::steady_clock::now();
  const auto analytic = [&](double relative) {
    FormFactorContext fine = context;
    fine.tolerance = relative;
    return make_form_factor_method("analytic", fine);
  };
  const ToleranceReport reference = assemble_to_tolerance(analytic, tolerance, context.patches, exact, run);
  MethodScore score;
  score.method = "analytic";
  score.setting = core::format("rows to %g: the reference", tolerance);
  score.seconds = core::seconds_since(start);
  score.stated_row_error = largest_of(reference.row_errors);
  score.pairs = reference.pairs;
  return score;
}

MethodScore score_of(const Trial& trial, const FormFactorContext& context, const DenseSymmetric& exact, Run& run) {
  FormFactorContext settings = context;
  trial.set(settings);
  const std::vector<double> areas = areas_of(context.patches);
  DenseSymmetric K(areas);
  RowErrors errors(K, areas);
  MethodScore score;
  score.method = trial.method;
  score.setting = trial.setting;
  const auto start = std::chrono::steady_clock::now();
  const auto method = make_form_factor_method(trial.method, settings);
  score.pairs = assemble(*method, context.patches, errors, run);
  score.seconds = core::seconds_since(start);
  score.stated_row_error = largest_of(errors.all());
  judge(K, exact, score);
  return score;
}

}  // namespace

std::vector<MethodScore> compare_methods(const FormFactorContext& context, double reference_tolerance, Run& run,
                                         const std::function<void(const MethodScore&)>& scored) {
  DenseSymmetric exact(areas_of(context.patches));
  MethodScore reference = score_of_reference(context, reference_tolerance, exact, run);
  std::vector<MethodScore> scores;
  const auto add = [&](MethodScore score) {
    scored(score);
    scores.push_back(std::move(score));
  };
  for (const Trial& trial : trials()) {
    run.throw_if_stopped("comparison");
    add(score_of(trial, context, exact, run));
  }
  add(std::move(reference));
  return scores;
}

}  // namespace interflect::fem
