#include "apps/picture_checkpoint.h"

#include "core/build_info.h"
#include "core/error.h"
#include "core/log.h"
#include "results/digest.h"
#include "results/record.h"
#include "scene/io/text_file.h"

namespace interflect::apps {
namespace {

/// What an MTL file says of a surface; other materials are in the scene file.
void add_material(const scene::Material& m, int channels, results::Digest& digest) {
  const auto add = [&](const Spectrum& s) {
    for (int c = 0; c < channels; ++c) digest.add(s[c]);
  };
  add(m.reflectance);
  digest.add(m.opacity);
  digest.add(std::uint64_t{m.finish.index()});
  if (const auto* mirror = std::get_if<scene::Mirror>(&m.finish)) add(mirror->reflectance);
  if (const auto* glass = std::get_if<scene::Glass>(&m.finish)) digest.add(glass->index);
  if (const auto* metal = std::get_if<scene::Metal>(&m.finish)) {
    digest.add(metal->roughness);
    if (const auto* reflectance = std::get_if<Spectrum>(&metal->reflects)) add(*reflectance);
  }
}

/// Of all that a path can meet: the file as it is written, and of what it names facets and materials of meshes and a
/// picture of the sky.
std::string picture_digest(const scene::Scene& scene) {
  results::Digest digest;
  for (const char c : scene::io::read_bytes(scene.file, scene.file.string())) digest.add(static_cast<std::uint64_t>(c));
  for (const scene::Facet& facet : scene.facets) {
    digest.add(std::uint64_t{facet.surface.value});
    for (const Vec3& corner : facet.corner) digest.add(corner);
  }
  for (const scene::Material& material : scene.materials) add_material(material, scene.channel_count(), digest);
  if (const auto* sky = std::get_if<scene::EnvironmentMap>(&scene.lights.sky))
    for (int row = 0; row < sky->rows(); ++row)
      for (int column = 0; column < sky->columns(); ++column)
        for (int c = 0; c < scene.channel_count(); ++c) digest.add(sky->texel(row, column)[c]);
  return digest.text();
}

}  // namespace

montecarlo::RenderSettings render_settings(const TraceOptions& options) {
  return {static_cast<std::uint64_t>(options.samples), options.filter,     options.sequence,
          measure::PathClasses::of(options.paths),     options.integrator, options.target};
}

PictureCheckpoint::PictureCheckpoint(const scene::Scene& scene, scene::CameraId camera, const TraceOptions& options,
                                     const CommonOptions& common)
    : file_(options.image), size_(montecarlo::render_state_size(scene, camera, render_settings(options))) {
  file_.replace_extension(".checkpoint.h5");
  of_.digest = picture_digest(scene);
  results::Record settings;  // not how many samples: more may be asked for
  of_.settings = results::json_text(settings.add("version", core::build_info().version)
                                        .add("camera", scene.camera(camera).name)
                                        .add("seed", common.seed)
                                        .add("filter", options.filter)
                                        .add("sequence", options.sequence)
                                        .add("integrator", options.integrator)
                                        .add("paths", options.paths)
                                        .add("group", options.group)
                                        .add("intersector", options.intersector));
}

void PictureCheckpoint::write(const montecarlo::FilmState& state) {
  results::Checkpoint now = of_;
  now.matrices.push_back({"film", state});
  results::write_checkpoint(file_, now);
  own_ = true;
}

void PictureCheckpoint::remove() {
  if (!own_) return;
  std::error_code error;
  std::filesystem::remove(file_, error);
  if (error) core::log::warning(file_.string() + ": the checkpoint is not removed: " + error.message());
  own_ = false;
}

montecarlo::FilmState PictureCheckpoint::read() {
  if (!std::filesystem::exists(file_))
    throw core::InputError(file_.string(),
                           "there is no such checkpoint: one of a finished picture is left by "
                           "--keep-checkpoint alone");
  results::Checkpoint expected = of_;
  expected.matrices.push_back({"film", solvers::ColumnMatrix(size_.first, size_.second)});
  montecarlo::FilmState state = results::read_checkpoint(file_, expected).matrix("film");
  own_ = true;
  return state;
}

}  // namespace interflect::apps
