#include <algorithm>
#include <cstdio>
#include <optional>

#include "apps/commands.h"
#include "apps/contacts.h"
#include "apps/kept_factors.h"
#include "apps/read_scene.h"
#include "apps/view_of.h"
#include "core/error.h"
#include "core/format.h"
#include "core/log.h"
#include "fem/method_trial.h"
#include "fem/tolerance_trial.h"
#include "results/factor_export.h"
#include "results/output_directory.h"
#include "results/record.h"

namespace interflect::apps {
namespace {

using results::FactorStore;

/// F.csv -> F.sensors.csv: where formats of one matrix put the points'.
std::filesystem::path of_sensors(std::filesystem::path file) {
  const std::string extension = file.extension().string();
  return file.replace_extension(".sensors" + extension);
}

void export_csv(const ViewFactorOptions& options, const FactorRequest& request, const FactorStore& store) {
  const bool any_points = !store.points().empty();
  if (options.groups.empty()) {
    results::write_factors_csv(options.out, store.elements(), store.rows());
    if (any_points) results::write_point_factors_csv(of_sensors(options.out), store.point_factors(), store.size());
    return;
  }
  const std::vector<std::string> groups = groups_of(request, options.groups);
  results::write_grouped_factors_csv(options.out, store.elements(), store.rows(), groups);
  if (any_points) results::write_grouped_point_factors_csv(of_sensors(options.out), store.point_factors(), groups);
}

void export_factors(const ViewFactorOptions& options, const FactorRequest& request, const FactorStore& store) {
  const std::string extension = options.out.extension().string();
  if (extension == ".npz")
    results::write_factors_npz(options.out, store.elements(), store.rows(), store.point_factors());
  if (extension == ".csv") export_csv(options, request, store);
  if (extension != ".mtx") return;
  results::write_factors_mtx(options.out, store.elements(), store.rows());
  if (!store.points().empty())
    results::write_point_factors_mtx(of_sensors(options.out), store.point_factors(), store.size());
}

void require_known_format(const ViewFactorOptions& options) {
  const std::string extension = options.out.extension().string();
  const std::vector<std::string> known{".h5", ".npz", ".mtx", ".csv"};
  if (std::find(known.begin(), known.end(), extension) == known.end())
    throw core::InputError(options.out.string(), "one of .h5, .npz, .mtx, .csv expected");
  if (!options.groups.empty() && extension != ".csv")
    throw core::InputError(options.out.string(), "--groups writes .csv");
}

/// "F.csv, F.sensors.csv, F.h5": everything that a run has written.
std::string written_files(const ViewFactorOptions& options, const FactorStore& store,
                          const std::filesystem::path& store_file) {
  std::string names = options.out.string();
  const std::string extension = options.out.extension().string();
  if (!store.points().empty() && (extension == ".csv" || extension == ".mtx"))
    names += ", " + of_sensors(options.out).string();
  if (store_file != options.out) names += ", " + store_file.string();
  return names + (options.view_of.empty() ? "" : ", .view.vtu and .view.png beside it");
}

struct Summary {
  double low = 0, mean = 0, high = 0;  ///< of row sums
  double environment = 0;              ///< mean of F_i,env
  double largest_error = 0;
};
Summary summary_of(const FactorStore& store) {
  Summary s;
  const auto [low, high] = std::minmax_element(store.row_sum().begin(), store.row_sum().end());
  s.low = *low;
  s.high = *high;
  double area = 0;
  for (std::size_t i = 0; i < store.row_sum().size(); ++i) {
    s.mean += store.elements().area[i] * store.row_sum()[i];
    if (!store.elements().environment.empty())
      s.environment += store.elements().area[i] * store.elements().environment[i];
    area += store.elements().area[i];
  }
  s.mean /= area;
  s.environment /= area;
  s.largest_error = *std::max_element(store.row_error().begin(), store.row_error().end());
  return s;
}

results::Record record_of(const ViewFactorOptions& options, const FactorStore& store, const Summary& s,
                          const fem::ToleranceReport& report) {
  results::Record record;
  record.add("input", options.input.string())
      .add("elements", static_cast<std::int64_t>(store.size()))
      .add("sensor_points", static_cast<std::int64_t>(store.points().size()))
      .add("form_factors", options.form_factors)
      .add("tolerance", options.tolerance)
      .add("tolerance_met", report.met)
      .add("largest_row_error", s.largest_error)
      .add("row_sum_mean", s.mean)
      .add("row_sum_lowest", s.low)
      .add("row_sum_highest", s.high)
      .add("closure", options.closure)
      .add("environment_mean", s.environment)
      .add("passes", report.passes)
      .add("clamped", report.pairs.clamped)
      .add("digest", store.key().digest);
  return record;
}

void print_summary(const ViewFactorOptions& options, const FactorStore& store, const Summary& s,
                   const KeptFactors& kept) {
  const fem::ToleranceReport& report = kept.report;
  std::printf("elements    %s\n", core::format_count(static_cast<unsigned long long>(store.size())).c_str());
  std::printf("rows        sum_j F_ij: mean %.6f, from %.6f to %.6f\n", s.mean, s.low, s.high);
  if (options.closure != "none")
    std::printf("closure     by %s; %.6f of what leaves reaches no element\n", options.closure.c_str(), s.environment);
  std::printf("error       sum_j |dF_ij| at most %.1e, %.1e asked for (estimated)\n", s.largest_error,
              options.tolerance);
  if (report.pairs.lost > 0)
    std::printf("lost        up to %.2f %% of a row, beyond what the method sees\n", 100 * report.pairs.lost);
  if (report.pairs.clamped > 0)
    std::printf("clamped     %llu entries\n", static_cast<unsigned long long>(report.pairs.clamped));
  std::printf("written to  %s\n", written_files(options, store, kept.file).c_str());
}

/// What a run will need, said before it starts.
struct FactorForecast {
  double elements, pairs, points, bytes, seconds;
};

FactorForecast forecast_of(const ViewFactorOptions& options, const FactorRequest& request, const fem::MethodMaker& make,
                           const fem::PointViewFactors& points, const Run& run) {
  const auto n = static_cast<double>(request.elements.open), count = static_cast<double>(request.points.size());
  FactorForecast forecast{static_cast<double>(request.size()), 0.5 * n * (n - 1), count, bytes_of(options, request), 0};
  const auto method = make(fem::entry_tolerance(options.tolerance));
  const auto elements = request.elements.seeing();
  const double work = forecast.pairs * fem::seconds_per_pair(*method, elements, run) +
                      fem::seconds_of_later_passes(make, options.tolerance, elements, fem::AgainPart::entries, run) +
                      count * fem::seconds_per_point(points, request.places());
  forecast.seconds = work / run.threads.count();
  return forecast;
}

std::string text_of(const FactorForecast& forecast) {
  const auto counted = [](double count, const char* what) {
    return core::format_count(static_cast<unsigned long long>(count)) + ' ' + what + (count == 1 ? "" : "s");
  };
  std::string text = counted(forecast.elements, "element") + ", " + counted(forecast.pairs, "pair") + ", ";
  if (forecast.points > 0) text += counted(forecast.points, "sensor point") + ", ";
  return text + core::format("up to %s on the disk, about %s", core::format_bytes(forecast.bytes).c_str(),
                             core::format_duration(forecast.seconds).c_str());
}

results::Record record_of(const FactorForecast& forecast) {
  results::Record record;
  record.add("elements", static_cast<std::int64_t>(forecast.elements))
      .add("pairs", static_cast<std::int64_t>(forecast.pairs))
      .add("sensor_points", static_cast<std::int64_t>(forecast.points))
      .add("bytes", forecast.bytes)
      .add("seconds", forecast.seconds);
  return record;
}

ExitStatus print_forecast(const FactorForecast& forecast, bool json) {
  std::printf("%s\n", json ? results::json_text(record_of(forecast)).c_str() : text_of(forecast).c_str());
  return success;
}

/// Of the method that was asked for, to any tolerance.  All of it outlives the maker.
fem::MethodMaker method_maker(const ViewFactorOptions& options, const FactorRequest& request,
                              const raycast::RayCaster& rays, std::uint64_t seed) {
  return [&, seed](double relative) {
    fem::FormFactorContext context{request.geometry.scene, request.elements.seeing(), rays, seed, relative,
                                   options.visibility_rays};
    context.samples = options.samples;
    context.visibility_error = options.visibility_error;
    context.resolution = options.resolution;
    return fem::make_form_factor_method(options.form_factors, context);
  };
}

}  // namespace

ExitStatus view_factors(const ViewFactorOptions& options, const CommonOptions& common, Run& run) {
  if (!options.forecast_only) require_known_format(options);
  const FactorRequest request = factor_request(options);
  std::optional<ViewedSurface> viewed;
  if (!options.view_of.empty()) viewed = viewed_surface(options.view_of, request);
  const bool talk = !common.json && !common.quiet;
  if (talk) std::printf("bounding box %s\n", box_text(request.geometry.scene).c_str());
  const auto rays = raycast::make_ray_caster("embree", request.geometry.scene);
  warn_of_contacts(request.geometry.scene, *rays);
  const fem::MethodMaker make = method_maker(options, request, *rays, run.seed);
  const fem::PointViewFactors points(request.geometry.scene, request.elements.seeing());
  if (talk || options.forecast_only) {
    const FactorForecast forecast = forecast_of(options, request, make, points, run);
    if (options.forecast_only) return print_forecast(forecast, common.json);
    std::printf("%s\n", text_of(forecast).c_str());
    std::fflush(stdout);
    run.progress.expect(std::min(forecast.seconds, 1e8));  // all passes of rows, not the one that is on
  }
  const std::filesystem::path folder = options.out.parent_path();
  const results::OutputDirectory made(folder.empty() ? "." : folder);
  const KeptFactors kept = keep_factors(options, request, {make, points, *rays, talk}, run);
  const FactorStore store(kept.file);
  export_factors(options, request, store);
  if (viewed) write_view_of(*viewed, request, store, *rays, options.out);
  const Summary summary = summary_of(store);
  if (common.json)
    std::printf("%s\n", results::json_text(record_of(options, store, summary, kept.report)).c_str());
  else if (talk)
    print_summary(options, store, summary, kept);
  if (!kept.report.met)
    core::log::shortfall(
        core::format("some rows are less accurate than asked: sum_j |dF_ij| is up to %.1e, %.1e asked "
                     "for (row_error in %s has each)",
                     summary.largest_error, options.tolerance, kept.file.string().c_str()));
  return kept.report.met ? success : not_met;
}

}  // namespace interflect::apps
