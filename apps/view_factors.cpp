#include <algorithm>
#include <cstdio>
#include <limits>
#include <memory>
#include <optional>

#include "apps/commands.h"
#include "apps/read_scene.h"
#include "core/error.h"
#include "core/format.h"
#include "core/log.h"
#include "fem/tiled_assembly.h"
#include "mesh/uniform.h"
#include "results/factor_export.h"
#include "results/factor_store.h"
#include "results/factors.h"
#include "results/output_directory.h"
#include "results/record.h"
#include "scene/geometry_file.h"

namespace interflect::apps {
namespace {

using results::FactorStore;
using results::FactorStoreWriter;

/// One element a face, where no size is asked for.
constexpr double no_limit = 1e12;  // [m]

/// Those of a solve, where a size is asked for.
mesh::ElementMesh mesh_of(const scene::Scene& scene, const ViewFactorOptions& options) {
  if (!(options.element_size > 0)) return mesh::uniform(scene, no_limit);
  fem::RadiositySettings settings;
  settings.element_size = options.element_size;
  settings.max_memory = std::numeric_limits<double>::infinity();
  return fem::elements_of(scene, settings);
}

/// Elements with view factors, in the order of the scene.
std::vector<scene::SurfacePatch> elements_of(const scene::ExchangeScene& geometry, const ViewFactorOptions& options) {
  const mesh::ElementMesh mesh = mesh_of(geometry.scene, options);
  std::vector<scene::SurfacePatch> elements;
  for (const scene::SurfacePatch& patch : mesh.patches())
    if (geometry.surfaces.empty() || geometry.surfaces[patch.surface.value].role == scene::ExchangeRole::radiates) elements.push_back(patch);
  if (elements.empty()) throw core::InputError(options.input.string(), "no surface that view factors could be of");
  return elements;
}

/// Tiles that go to a file at once.
class StoredTiles final : public fem::TileStore {
 public:
  explicit StoredTiles(FactorStoreWriter& writer) : writer_(writer) {}
  Index tile_size() const override { return writer_.tile(); }
  bool is_done(Index I, Index J) const override { return writer_.is_done(I, J); }
  void write(Index I, Index J, std::span<const double> K, std::span<const double> error) override { writer_.write(I, J, K, error); }
  void read(Index I, Index J, std::span<double> K, std::span<double> error) const override { writer_.read(I, J, K, error); }

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

/// "group" of every element: what its factors are summed by.
std::vector<std::string> groups_of(const scene::ExchangeScene& geometry, std::span<const scene::SurfacePatch> elements, const std::string& by) {
  std::vector<std::string> groups;
  for (const scene::SurfacePatch& element : elements) {
    const scene::SurfaceId id = element.surface;
    if (by == "material")
      groups.push_back(geometry.scene.material(id).name);
    else if (by == "group" && id.value < geometry.surfaces.size())
      groups.push_back(geometry.surfaces[id.value].group);
    else
      groups.push_back(geometry.scene.side_name(id, element.side));
  }
  return groups;
}

void export_factors(const ViewFactorOptions& options, const scene::ExchangeScene& geometry, std::span<const scene::SurfacePatch> elements,
                    const FactorStore& store) {
  const std::string extension = options.out.extension().string();
  if (extension == ".npz") results::write_factors_npz(options.out, store.elements(), store.rows());
  if (extension == ".mtx") results::write_factors_mtx(options.out, store.elements(), store.rows());
  if (extension != ".csv") return;
  if (options.groups.empty())
    results::write_factors_csv(options.out, store.elements(), store.rows());
  else
    results::write_grouped_factors_csv(options.out, store.elements(), store.rows(), groups_of(geometry, elements, options.groups));
}

void require_known_format(const ViewFactorOptions& options) {
  const std::string extension = options.out.extension().string();
  const std::vector<std::string> known{".h5", ".npz", ".mtx", ".csv"};
  if (std::find(known.begin(), known.end(), extension) == known.end())
    throw core::InputError(options.out.string(), "one of .h5, .npz, .mtx, .csv expected");
  if (!options.groups.empty() && extension != ".csv") throw core::InputError(options.out.string(), "--groups writes .csv");
}

/// Of a finished store of the same geometry and settings.
std::optional<std::vector<double>> row_errors_if_there(const std::filesystem::path& file, const results::FactorStoreKey& key) try {
  if (!std::filesystem::exists(file)) return std::nullopt;
  const FactorStore store(file);
  if (store.key().digest != key.digest || store.key().settings != key.settings) return std::nullopt;
  return store.row_error();
} catch (const core::InputError&) {  // not a store: it will be replaced
  return std::nullopt;
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

results::Record record_of(const ViewFactorOptions& options, const FactorStore& store, const Summary& s, const fem::ToleranceReport& report) {
  results::Record record;
  record.add("input", options.input.string())
      .add("elements", static_cast<std::int64_t>(store.size()))
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

void print_summary(const ViewFactorOptions& options, const FactorStore& store, const Summary& s, const fem::ToleranceReport& report) {
  std::printf("elements    %s\n", core::format_count(static_cast<unsigned long long>(store.size())).c_str());
  std::printf("rows        sum_j F_ij: mean %.6f, from %.6f to %.6f\n", s.mean, s.low, s.high);
  std::printf("error       sum_j |dF_ij| at most %.1e, %.1e asked for (estimated)\n", s.largest_error, options.tolerance);
  if (report.pairs.lost > 0) std::printf("lost        up to %.2f %% of a row, beyond what the method sees\n", 100 * report.pairs.lost);
  if (report.pairs.clamped > 0) std::printf("clamped     %llu entries\n", static_cast<unsigned long long>(report.pairs.clamped));
  std::printf("written to  %s\n", options.out.string().c_str());
}

}  // namespace

ExitStatus view_factors(const ViewFactorOptions& options, const CommonOptions& common, Run& run) {
  require_known_format(options);
  const scene::ExchangeScene geometry = scene::read_geometry_as_scene(options.input, options.geometry);
  for (const scene::Note& note : geometry.scene.repairs) core::log::info(note.line());
  for (const scene::Note& note : geometry.scene.warnings) core::log::warning(note.line());
  if (!geometry.masks.empty())
    core::log::warning(core::format("%zu masks see their bases alone: they are left out, and so is what bases see of them", geometry.masks.size()));
  const std::vector<scene::SurfacePatch> elements = elements_of(geometry, options);
  const bool talk = !common.json && !common.quiet;
  if (talk) std::printf("%s elements, bounding box %s\n", core::format_count(elements.size()).c_str(), box_text(geometry.scene).c_str());
  std::fflush(stdout);

  const auto rays = raycast::make_ray_caster("embree", geometry.scene);
  const auto make = [&](double relative) {
    fem::FormFactorContext context{geometry.scene, elements, *rays, run.seed, relative, options.visibility_rays};
    context.samples = options.samples;
    context.resolution = options.resolution;
    return fem::make_form_factor_method(options.form_factors, context);
  };
  make(options.tolerance);  // an unknown name is told before a file is begun
  const results::FactorStoreKey key{results::geometry_digest(geometry.scene, elements), results::json_text(settings_of(options, run.seed))};
  const std::filesystem::path file = store_of(options), folder = options.out.parent_path();
  const results::OutputDirectory made(folder.empty() ? "." : folder);
  fem::ToleranceReport report;
  if (const auto errors = row_errors_if_there(file, key)) {
    if (talk) std::printf("%s has them already\n", file.string().c_str());
    report.row_errors = *errors;
    report.met = *std::max_element(errors->begin(), errors->end()) <= options.tolerance;
  } else {
    FactorStoreWriter writer(file, results::factor_elements(geometry.scene, elements), key);
    if (writer.done() > 0 && talk)
      std::printf("going on with %s: %td of %td tiles are there\n", file.string().c_str(), writer.done(), writer.tiles());
    StoredTiles tiles(writer);
    report = fem::assemble_tiles(make, options.tolerance, elements, tiles, run);
    writer.finish();
  }
  const FactorStore store(file);
  export_factors(options, geometry, elements, store);
  const Summary summary = summary_of(store);
  if (common.json)
    std::printf("%s\n", results::json_text(record_of(options, store, summary, report)).c_str());
  else if (talk)
    print_summary(options, store, summary, report);
  if (!report.met) core::log::warning("some rows are less accurate than asked: see row_error");
  return report.met ? success : not_met;
}

}  // namespace interflect::apps
