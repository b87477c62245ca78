#include "apps/kept_factors.h"

#include <algorithm>
#include <cstdio>
#include <optional>

#include "apps/factor_closure.h"
#include "core/error.h"
#include "core/log.h"
#include "results/factor_export.h"
#include "results/output_directory.h"
#include "results/record.h"

namespace interflect::apps {
namespace {

using results::FactorStore;
using results::FactorStoreKey;
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
FactorStoreKey key_of(const ViewFactorOptions& options, const FactorRequest& request, std::uint64_t seed,
                      bool repaired) {
  results::Record settings;
  settings.add("form_factors", options.form_factors)
      .add("tolerance", options.tolerance)
      .add("samples", options.samples)
      .add("resolution", options.resolution)
      .add("visibility_rays", options.visibility_rays)
      .add("visibility_error", options.visibility_error)
      .add("seed", seed);
  if (repaired) settings.add("closure", options.closure);
  return {request.digest(), results::json_text(settings)};
}

std::filesystem::path store_of(const ViewFactorOptions& options) {
  std::filesystem::path store = options.out;
  return store.extension() == ".h5" ? store : store.replace_extension(".h5");
}

/// A finished store of the same geometry and settings.
std::optional<FactorStore> store_if_there(const std::filesystem::path& file, const FactorStoreKey& key) try {
  if (!std::filesystem::exists(file)) return std::nullopt;
  FactorStore store(file);
  if (store.key().digest != key.digest || store.key().settings != key.settings) return std::nullopt;
  return store;
} catch (const core::InputError&) {  // not a store: it will be replaced
  return std::nullopt;
}

/// The tolerance is asked of what was computed, before a repair's changes are added to its errors.
fem::ToleranceReport report_of(const FactorStore& store, double tolerance) {
  fem::ToleranceReport report;
  report.row_errors = store.row_error();
  const std::vector<double>& change = store.elements().closure_change;
  constexpr double rounding = 1e-6;  // of errors in single precision
  report.met = true;
  for (std::size_t i = 0; i < report.row_errors.size(); ++i)
    report.met = report.met && report.row_errors[i] - (change.empty() ? 0 : change[i]) <= (1 + rounding) * tolerance;
  return report;
}

/// What one computation needs.
struct Job {
  std::filesystem::path file;
  const ViewFactorOptions& options;
  const FactorRequest& request;
  const FactorWork& work;
  Run& run;

  FactorStoreKey key(bool repaired) const { return key_of(options, request, run.seed, repaired); }
  void require_disk_room() const {
    const std::filesystem::path folder = file.parent_path().empty() ? "." : file.parent_path();
    results::require_disk_room(folder, bytes_of(options, request) - results::begun_bytes(file));
  }
};

/// Everything that the store does not have yet.
fem::ToleranceReport fill(FactorStoreWriter& writer, const Job& job) {
  StoredPoints rows(writer);
  fem::assemble_points(job.work.points, job.request.places(), rows, job.run);
  StoredTiles tiles(writer);
  fem::ToleranceReport report = fem::assemble_tiles(job.work.make, job.options.tolerance, job.request.elements.seeing(),
                                                    tiles, job.run, job.request.covered);
  writer.finish();
  return report;
}

/// As they are computed: reads, or computes and keeps.
fem::ToleranceReport computed_factors(const Job& job) {
  const FactorStoreKey key = job.key(false);
  std::optional<FactorStore> known = store_if_there(job.file, key);
  if (known && results::same_points(known->points(), job.request.points)) {
    if (job.work.talk) std::printf("%s has them already\n", job.file.string().c_str());
    return report_of(*known, job.options.tolerance);
  }
  job.require_disk_room();
  FactorStoreWriter writer(job.file, job.request.about, key, 0, job.request.points);
  if (known && writer.done() == 0) {
    if (job.work.talk) std::printf("%s has those between elements already\n", job.file.string().c_str());
    copy_tiles(*known, writer, as_they_are);
  } else if (writer.done() > 0 && job.work.talk) {
    std::printf("going on with %s: %td of %td tiles are there\n", job.file.string().c_str(), writer.done(),
                writer.tiles());
  }
  known.reset();  // the file that it reads is about to be replaced
  return fill(writer, job);
}

fem::ToleranceReport repaired_factors(const Job& job) {
  const FactorStoreKey key = job.key(true);
  if (const auto known = store_if_there(job.file, key);
      known && results::same_points(known->points(), job.request.points)) {
    if (job.work.talk) std::printf("%s has them already\n", job.file.string().c_str());
    return report_of(*known, job.options.tolerance);
  }
  fem::ToleranceReport report = computed_factors(job);
  write_repaired(job.file, key, {job.options.closure, job.request, job.work.rays}, job.run);
  report.row_errors = FactorStore(job.file).row_error();
  return report;
}

/// Of a run that was stopped.
void say_what_is_kept(const std::filesystem::path& file) {
  if (results::begun_bytes(file) > 0)
    core::log::shortfall("what was computed is in " + file.string() + ".partial: the same command goes on from there");
}

}  // namespace

double bytes_of(const ViewFactorOptions& options, const FactorRequest& request) {
  const bool summed = !options.groups.empty();  // a line for each pair of groups
  const int stores = options.closure == "none" ? 1 : 2;
  return stores * results::factor_store_bytes(request.size(), request.points.size()) +
         (summed ? 0 : results::most_export_bytes(options.out, request.size(), request.points.size()));
}

KeptFactors keep_factors(const ViewFactorOptions& options, const FactorRequest& request, const FactorWork& work,
                         Run& run) try {
  const Job job{store_of(options), options, request, work, run};
  return {job.file, options.closure == "none" ? computed_factors(job) : repaired_factors(job)};
} catch (const core::Interrupted&) {
  say_what_is_kept(store_of(options));
  throw;
}

}  // namespace interflect::apps
