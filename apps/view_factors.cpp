#include <algorithm>
#include <cstdio>
#include <optional>

#include "apps/commands.h"
#include "apps/factor_request.h"
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
using results::FactorStoreWriter;

/// Tiles that go to a file at once.
class StoredTiles final : public fem::TileStore {
 public:
  explicit StoredTiles(FactorStoreWriter& writer) : writer_(writer) {}
  Index tile_size() const override { return writer_.tile(); }
  bool is_done(Index I, Index J) const override { return writer_.is_done(I, J); }
  void write(Index I, Index J, std::span<const double> K, std::span<const double> error) override {
    writer_.write(I, J, K, error);
  }
  void read(Index I, Index J, std::span<double> K, std::span<double> error) const override {
    writer_.read(I, J, K, error);
  }

 private:
  FactorStoreWriter& writer_;
};

/// Rows of points, likewise.
class StoredPoints final : public fem::PointStore {
 public:
  explicit StoredPoints(FactorStoreWriter& writer) : writer_(writer) {}
  bool is_done(Index s) const override { return writer_.is_point_done(s); }
  void write(Index s, std::span<const double> F, std::span<const double> error) override {
    writer_.write_point(s, F, error);
  }

 private:
  FactorStoreWriter& writer_;
};

/// What the numbers depend on beside the geometry.
results::Record settings_of(const ViewFactorOptions& options, std::uint64_t seed) {
  return results::Record()
      .add("form_factors", options.form_factors)
      .add("tolerance", options.tolerance)
      .add("samples", options.samples)
      .add("resolution", options.resolution)
      .add("visibility_rays", options.visibility_rays)
      .add("seed", seed);
}

std::filesystem::path store_of(const ViewFactorOptions& options) {
  std::filesystem::path store = options.out;
  return store.extension() == ".h5" ? store : store.replace_extension(".h5");
}

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

/// A finished store of the same geometry and settings.
std::optional<FactorStore> store_if_there(const std::filesystem::path& file, const results::FactorStoreKey& key) try {
  if (!std::filesystem::exists(file)) return std::nullopt;
  FactorStore store(file);
  if (store.key().digest != key.digest || store.key().settings != key.settings) return std::nullopt;
  return store;
} catch (const core::InputError&) {  // not a store: it will be replaced
  return std::nullopt;
}

/// Of a store that differs in its sensors alone.
void take_tiles(const FactorStore& store, FactorStoreWriter& writer) {
  const Index n = writer.size();
  std::vector<double> K, error, tile, tile_error;
  for (Index I = 0; I < writer.tiles_across(); ++I) {
    const Index rows = writer.count(I);
    K.resize(static_cast<std::size_t>(rows * n));
    error.resize(K.size());
    store.read_rows(writer.first(I), rows, K, error);
    for (Index J = I; J < writer.tiles_across(); ++J) {
      tile.clear();
      tile_error.clear();
      for (Index a = 0; a < rows; ++a) {
        const Index from = a * n + writer.first(J), to = from + writer.count(J);
        tile.insert(tile.end(), K.begin() + from, K.begin() + to);
        tile_error.insert(tile_error.end(), error.begin() + from, error.begin() + to);
      }
      writer.write(I, J, tile, tile_error);
    }
  }
}

struct Summary {
  double low = 0, mean = 0, high = 0;  ///< of row sums
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
    area += store.elements().area[i];
  }
  s.mean /= area;
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
      .add("passes", report.passes)
      .add("clamped", report.pairs.clamped)
      .add("digest", store.key().digest);
  return record;
}

void print_summary(const ViewFactorOptions& options, const FactorStore& store, const Summary& s,
                   const fem::ToleranceReport& report) {
  std::printf("elements    %s\n", core::format_count(static_cast<unsigned long long>(store.size())).c_str());
  std::printf("rows        sum_j F_ij: mean %.6f, from %.6f to %.6f\n", s.mean, s.low, s.high);
  std::printf("error       sum_j |dF_ij| at most %.1e, %.1e asked for (estimated)\n", s.largest_error,
              options.tolerance);
  if (report.pairs.lost > 0)
    std::printf("lost        up to %.2f %% of a row, beyond what the method sees\n", 100 * report.pairs.lost);
  if (report.pairs.clamped > 0)
    std::printf("clamped     %llu entries\n", static_cast<unsigned long long>(report.pairs.clamped));
  std::printf("written to  %s%s\n", options.out.string().c_str(),
              options.view_of.empty() ? "" : ", .view.vtu and .view.png beside it");
}

/// What a run will need, said before it starts.
struct FactorForecast {
  double elements, pairs, points, bytes, seconds;
};

/// Most of them: the store and what is made of it.
double bytes_of(const ViewFactorOptions& options, const FactorRequest& request) {
  const bool summed = !options.groups.empty();  // a line for each pair of groups
  return results::factor_store_bytes(request.size(), request.points.size()) +
         (summed ? 0 : results::most_export_bytes(options.out, request.size(), request.points.size()));
}

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

/// Everything that the store does not have yet.
fem::ToleranceReport fill(FactorStoreWriter& writer, const fem::MethodMaker& make, double tolerance,
                          const FactorRequest& request, const fem::PointViewFactors& points, Run& run) {
  StoredPoints rows(writer);
  fem::assemble_points(points, request.places(), rows, run);
  StoredTiles tiles(writer);
  fem::ToleranceReport report =
      fem::assemble_tiles(make, tolerance, request.elements.seeing(), tiles, run, request.covered);
  writer.finish();
  return report;
}

/// Reads, or computes and keeps.
fem::ToleranceReport factors_into(const std::filesystem::path& file, const results::FactorStoreKey& key,
                                  const fem::MethodMaker& make, const ViewFactorOptions& options,
                                  const FactorRequest& request, const fem::PointViewFactors& points, bool talk,
                                  Run& run) {
  std::optional<FactorStore> known = store_if_there(file, key);
  if (known && results::same_points(known->points(), request.points)) {
    if (talk) std::printf("%s has them already\n", file.string().c_str());
    fem::ToleranceReport report;
    report.row_errors = known->row_error();
    report.met = *std::max_element(report.row_errors.begin(), report.row_errors.end()) <= options.tolerance;
    return report;
  }
  const std::filesystem::path folder = file.parent_path().empty() ? "." : file.parent_path();
  results::require_disk_room(folder, bytes_of(options, request) - results::begun_bytes(file));
  FactorStoreWriter writer(file, request.about, key, 0, request.points);
  if (known && writer.done() == 0) {
    if (talk) std::printf("%s has those between elements already\n", file.string().c_str());
    take_tiles(*known, writer);
  } else if (writer.done() > 0 && talk) {
    std::printf("going on with %s: %td of %td tiles are there\n", file.string().c_str(), writer.done(), writer.tiles());
  }
  known.reset();  // the file that it reads is about to be replaced
  return fill(writer, make, options.tolerance, request, points, run);
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
  const auto make = [&](double relative) {
    fem::FormFactorContext context{request.geometry.scene, request.elements.seeing(), *rays, run.seed, relative,
                                   options.visibility_rays};
    context.samples = options.samples;
    context.resolution = options.resolution;
    return fem::make_form_factor_method(options.form_factors, context);
  };
  const fem::PointViewFactors points(request.geometry.scene, request.elements.seeing());
  if (talk || options.forecast_only) {
    const FactorForecast forecast = forecast_of(options, request, make, points, run);
    if (options.forecast_only) return print_forecast(forecast, common.json);
    std::printf("%s\n", text_of(forecast).c_str());
    std::fflush(stdout);
  }
  const std::filesystem::path file = store_of(options), folder = options.out.parent_path();
  const results::OutputDirectory made(folder.empty() ? "." : folder);
  const results::FactorStoreKey key{request.digest(), results::json_text(settings_of(options, run.seed))};
  const fem::ToleranceReport report = factors_into(file, key, make, options, request, points, talk, run);
  const FactorStore store(file);
  export_factors(options, request, store);
  if (viewed) write_view_of(*viewed, request, store, *rays, options.out);
  const Summary summary = summary_of(store);
  if (common.json)
    std::printf("%s\n", results::json_text(record_of(options, store, summary, report)).c_str());
  else if (talk)
    print_summary(options, store, summary, report);
  if (!report.met) core::log::warning("some rows are less accurate than asked: see row_error");
  return report.met ? success : not_met;
}

}  // namespace interflect::apps
