#include <cstdio>

#include "apps/commands.h"
#include "apps/optics_texts.h"
#include "apps/read_scene.h"
#include "apps/table.h"
#include "core/format.h"
#include "results/record.h"
#include "scene/inspection.h"

namespace interflect::apps {
namespace {

const char* sides_text(scene::Sides sides) { return sides == scene::Sides::both ? "both" : "front"; }

std::string closedness_text(const scene::Inspection& inspection) {
  if (inspection.closed()) return "closed";
  const bool gaps = inspection.has(scene::Inspection::Finding::Kind::gap);
  return core::format("%s: %.4g m of edges without a neighbour",
                      gaps ? "open" : "no gaps, but rims of two-sided surfaces", inspection.open_edge_length);
}

std::string surfaces_text(const scene::Scene& scene) {
  Table table({"surface", "area m2", "facets", "sides", "material"});
  for (scene::SurfaceId id : scene.surface_ids())
    table.add({scene.surface(id).name, core::format("%.6g", scene.area(id)), std::to_string(scene.surface(id).facets),
               sides_text(scene.material(id).sides), scene.material(id).name});
  return table.text();
}

/// What shines, and where: "lamp  0.36 m2, 1200 lm, faces (0, 0, -1)"; a side that is not flat faces its mean normal.
std::string emitters_text(const scene::Scene& scene) {
  constexpr std::size_t most = 20;  // lines; the rest is counted
  std::string text;
  std::size_t count = 0;
  for (scene::SurfaceId id : scene.surface_ids())
    for (scene::Side side : {scene::Side::front, scene::Side::back}) {
      const Spectrum exitance = scene.material(id).exitance_of(side);
      if (exitance.is_zero() || !scene.material(id).active(side) || ++count > most) continue;
      Vec3 facing = Vec3::Zero();
      for (const scene::Facet& facet : scene.facets_of(id)) facing += facet.area * facet.normal;
      facing = (side == scene::Side::front ? 1 : -1) / scene.area(id) * facing;
      facing = (1e3 * facing).array().round() / 1e3 + 0.0;  // no "-0"
      text += core::format("emitter        %s: %.4g m2, %.6g %s, faces (%.3g, %.3g, %.3g)\n",
                           scene.side_name(id, side).c_str(), scene.area(id), scene.weigh(exitance) * scene.area(id),
                           scene.flux_unit(), facing.x(), facing.y(), facing.z());
    }
  if (count > most) text += core::format("               and %zu more emitters\n", count - most);
  return text;
}

/// What is diffuse of it.
std::string diffuse_text(const scene::Material& material, int channels) {
  return material.is_diffuse() || !material.reflectance.is_zero() ? spectrum_text(material.reflectance, channels) : "-";
}

std::string materials_text(const scene::Scene& scene) {
  const bool photometric = scene.quantity == scene::Quantity::photometric;
  Table table({"material", "reflectance", photometric ? "exitance lm/m2" : "exitance W/m2", "sides", "type"});
  for (const scene::Material& m : scene.materials)
    table.add({m.name, diffuse_text(m, scene.channel_count()), spectrum_text(m.exitance, scene.channel_count()),
               sides_text(m.sides), finish_text(m, scene.channel_count())});
  return table.text();
}

void print_text(const scene::Scene& scene, const scene::Inspection& inspection) {
  std::string channels;
  for (int c = 0; c < scene.channel_count(); ++c)
    channels += core::format("%s%s (weight %.4g)", c > 0 ? ", " : "",
                             scene.channels[static_cast<std::size_t>(c)].c_str(), scene.weights[c]);
  std::printf("%s\n%s\n", surfaces_text(scene).c_str(), materials_text(scene).c_str());
  double area = 0;
  for (scene::SurfaceId id : scene.surface_ids()) area += scene.area(id);
  std::printf("surfaces       %zu, %zu facets, %.6g m2\n", scene.surfaces.size(), scene.facets.size(), area);
  std::printf("bounding box   %s\n", box_text(scene).c_str());
  std::printf("channels       %s\n", channels.c_str());
  std::printf("emitted flux   %.6g %s (%s)%s\n", scene.weigh(scene.emitted_flux()), scene.flux_unit(),
              spectrum_text(scene.emitted_flux(), scene.channel_count()).c_str(),
              scene.lights.empty() ? "" : ", of surfaces");
  std::printf("%s%s", emitters_text(scene).c_str(), lights_text(scene).c_str());
  std::printf("geometry       %s\n", closedness_text(inspection).c_str());
  std::printf("sensors        %zu\ncameras        %zu\n", scene.sensors.size(), scene.cameras.size());
  for (const scene::Camera& camera : scene.cameras)
    std::printf("               %s, %s%d x %d pixels\n", camera.name.c_str(),
                camera.is_pinhole() ? "" : (camera.projection_name() + ", ").c_str(), camera.width, camera.height);
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
                            .add("type", type_of(m.finish))
                            .add("finish", finish_record(m, channels))
                            .add("reflectance", m.reflectance, channels)
                            .add("exitance", m.exitance, channels)
                            .add("sides", sides_text(m.sides)));
  const Vec3 low = scene.box().min(), high = scene.box().max();
  record.add("scene", scene.file.string())
      .add("channels", scene.channels)
      .add("weights", scene.weights, channels)
      .add("surfaces", std::move(surfaces))
      .add("materials", std::move(materials))
      .add("lights", light_records(scene))
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
