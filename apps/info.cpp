#include <cstdio>

#include "apps/commands.h"
#include "apps/read_scene.h"
#include "apps/table.h"
#include "core/format.h"
#include "results/record.h"
#include "scene/inspection.h"

namespace interflect::apps {
namespace {

/// "0.74" for a value that all channels share, "0.73 0.74 0.71" otherwise.
std::string spectrum_text(const Spectrum& s, int channels) {
  bool equal = true;
  std::string text;
  for (int c = 0; c < channels; ++c) {
    equal = equal && s[c] == s[0];
    text += (c > 0 ? " " : "") + core::format("%.4g", s[c]);
  }
  return equal ? core::format("%.4g", s[0]) : text;
}

const char* sides_text(scene::Sides sides) { return sides == scene::Sides::both ? "both" : "front"; }

std::string closedness_text(const scene::Inspection& inspection) {
  return inspection.closed() ? "closed" : core::format("open: %.4g m of edges without a neighbour", inspection.open_edge_length);
}

std::string surfaces_text(const scene::Scene& scene) {
  Table table({"surface", "area m2", "facets", "sides", "material"});
  for (scene::SurfaceId id : scene.surface_ids())
    table.add({scene.surface(id).name, core::format("%.6g", scene.area(id)), std::to_string(scene.surface(id).facets),
               sides_text(scene.material(id).sides), scene.material(id).name});
  return table.text();
}

std::string materials_text(const scene::Scene& scene) {
  const bool photometric = scene.quantity == scene::Quantity::photometric;
  Table table({"material", "reflectance", photometric ? "exitance lm/m2" : "exitance W/m2", "sides"});
  for (const scene::Material& m : scene.materials)
    table.add({m.name, spectrum_text(m.reflectance, scene.channel_count()), spectrum_text(m.exitance, scene.channel_count()),
               sides_text(m.sides)});
  return table.text();
}

void print_text(const scene::Scene& scene, const scene::Inspection& inspection) {
  std::string channels;
  for (int c = 0; c < scene.channel_count(); ++c)
    channels += core::format("%s%s (weight %.4g)", c > 0 ? ", " : "", scene.channels[static_cast<std::size_t>(c)].c_str(), scene.weights[c]);
  std::printf("%s\n%s\n", surfaces_text(scene).c_str(), materials_text(scene).c_str());
  double area = 0;
  for (scene::SurfaceId id : scene.surface_ids()) area += scene.area(id);
  std::printf("surfaces       %zu, %zu facets, %.6g m2\n", scene.surfaces.size(), scene.facets.size(), area);
  std::printf("bounding box   %s\n", box_text(scene).c_str());
  std::printf("channels       %s\n", channels.c_str());
  std::printf("emitted flux   %.6g %s (%s)\n", scene.weigh(scene.emitted_flux()), scene.flux_unit(),
              spectrum_text(scene.emitted_flux(), scene.channel_count()).c_str());
  std::printf("geometry       %s\n", closedness_text(inspection).c_str());
  std::printf("sensors        %zu\ncameras        %zu\n", scene.sensors.size(), scene.cameras.size());
  for (const scene::Camera& camera : scene.cameras)
    std::printf("               %s, %d x %d pixels\n", camera.name.c_str(), camera.width, camera.height);
  for (const scene::Note& note : scene.repairs) std::printf("repair         %s\n", note.line().c_str());
}

results::Record record_of(const scene::Scene& scene, const scene::Inspection& inspection) {
  const int channels = scene.channel_count();
  results::Record record;
  results::Record::List surfaces, materials;
  for (scene::SurfaceId id : scene.surface_ids())
    surfaces.push_back(results::Record()
                           .add("name", scene.surface(id).name)
                           .add("area", scene.area(id))
                           .add("facets", scene.surface(id).facets)
                           .add("material", scene.material(id).name));
  for (const scene::Material& m : scene.materials)
    materials.push_back(results::Record()
                            .add("name", m.name)
                            .add("reflectance", m.reflectance, channels)
                            .add("exitance", m.exitance, channels)
                            .add("sides", sides_text(m.sides)));
  const Vec3 low = scene.box().min(), high = scene.box().max();
  record.add("scene", scene.file.string())
      .add("channels", scene.channels)
      .add("weights", scene.weights, channels)
      .add("surfaces", std::move(surfaces))
      .add("materials", std::move(materials))
      .add("box_min_m", results::Record::Numbers{low.x(), low.y(), low.z()})
      .add("box_max_m", results::Record::Numbers{high.x(), high.y(), high.z()})
      .add("emitted_flux", scene.emitted_flux(), channels)
      .add("closed", inspection.closed())
      .add("open_edge_length_m", inspection.open_edge_length)
      .add("repairs", lines_of(scene.repairs))
      .add("warnings", lines_of(scene.warnings));
  return record;
}

}  // namespace

ExitStatus info(const InfoOptions& options, const CommonOptions& common, Run&) {
  const scene::Scene scene = read_and_note(options.scene);
  const scene::Inspection inspection = scene::inspect(scene);
  if (common.json)
    std::printf("%s\n", results::json_text(record_of(scene, inspection)).c_str());
  else
    print_text(scene, inspection);
  return success;
}

}  // namespace interflect::apps
