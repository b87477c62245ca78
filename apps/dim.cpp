#include <cstdio>

#include "apps/commands.h"
#include "apps/light_group_files.h"
#include "apps/read_scene.h"
#include "apps/solution_files.h"
#include "apps/table.h"
#include "core/build_info.h"
#include "core/error.h"
#include "core/format.h"
#include "fem/error_summary.h"
#include "results/factors.h"
#ifdef INTERFLECT_WITH_VTK
#include "apps/field_pictures.h"
#endif

namespace interflect::apps {
namespace {

/// The scene that the groups are of, as it is now: surfaces and sensors must not have changed.
scene::Scene scene_of(const results::LightGroups& all, const std::filesystem::path& file) {
  scene::Scene scene = read_and_note(all.scene_file);
  if (results::geometry_digest(scene, all.patches) != all.digest)
    throw core::InputError(file.string(), all.scene_file + " has changed since: solve it again");
  return scene;
}

std::string table_of(const results::LightGroups& all, const std::vector<double>& factors, const scene::Scene& scene) {
  Table table({"light group", "output", std::string("flux ") + scene.flux_unit()});
  for (std::size_t g = 0; g < all.groups.size(); ++g) {
    Spectrum flux;
    for (std::size_t i = 0; i < all.patches.size(); ++i) flux += all.patches[i].area * all.groups[g].exitance[i];
    table.add({all.groups[g].name, core::format("%.4g %%", 100 * factors[g]),
               core::format("%.5g", factors[g] * scene.weigh(flux))});
  }
  return table.text();
}

results::Record record_of(const SolvedScene& solved, const results::LightGroups& all,
                          const std::vector<double>& factors, const DimOptions& options, const CommonOptions& common) {
  const fem::ErrorSummary error = fem::summarise_error(solved.solution, solved.scene);
  results::Record outputs, record;
  for (std::size_t g = 0; g < all.groups.size(); ++g) outputs.add(all.groups[g].name, factors[g]);
  return record.add("version", core::build_info().version)
      .add("command", common.command_line)
      .add("scene", all.scene_file)
      .add("solution", options.solution.string())
      .add("outputs", std::move(outputs))
      .add("elements", solved.solution.mesh.size())
      .add("mean_irradiance", error.mean_irradiance)
      .add("mean_irradiance_error", error.mean_error)
      .add("relative_error_l2", error.relative_l2)
      .add("relative_noise_l2", error.relative_noise_l2);
}

#ifdef INTERFLECT_WITH_VTK
/// In the colours of full output, so that what is dimmed is darker.
void write_pictures(const SolvedScene& solved, const results::LightGroups& all, const std::vector<double>& factors,
                    const std::filesystem::path& folder) {
  PictureScale scale = scale_of(dimmed(all, std::vector<double>(all.groups.size(), 1.0)));
  scale.note = dimming_text(all, factors);
  write_field_pictures(solved, nullptr, folder, scale);
}
#endif

}  // namespace

ExitStatus dim(const DimOptions& options, const CommonOptions& common, Run&) {
  const std::filesystem::path file = light_group_file(options.solution);
  std::error_code error;
  if (!std::filesystem::exists(file, error))
    throw core::InputError(options.solution.string(), "no light groups are here: solve with --light-groups");
  const results::LightGroups all = results::read_light_groups(file);
  const std::vector<double> factors = dimming_of(options.groups, all);
  SolvedScene solved(scene_of(all, file), {}, dimmed(all, factors));
  solved.points = measure::sensor_points(solved.scene);
  solved.at_points = dimmed_points(all, factors);
  if (solved.points.size() != solved.at_points.size())
    throw core::InputError(file.string(), "the sensors of " + all.scene_file + " have changed since: solve it again");
  solved.rays = raycast::make_ray_caster("embree", solved.scene);  // of what is in view
  const std::filesystem::path out = options.out.empty() ? options.solution / "dimmed" : options.out;
  solved.folder = std::make_unique<results::OutputDirectory>(out);
  write_tables_and_field(solved, out, false);
#ifdef INTERFLECT_WITH_VTK
  if (options.pictures) write_pictures(solved, all, factors, out);
#endif
  const results::Record record = record_of(solved, all, factors, options, common);
  results::write_json(out / "summary.json", record);
  if (common.json)
    std::printf("%s\n", results::json_text(record).c_str());
  else if (!common.quiet)
    std::printf("%s%s\nwritten to %s\n", table_of(all, factors, solved.scene).c_str(), means_text(solved).c_str(),
                out.string().c_str());
  return success;
}

}  // namespace interflect::apps
