#include "apps/element_picture.h"

#include "apps/camera_pictures.h"
#include "results/image_file.h"

namespace interflect::apps {

void write_element_picture(const visual::Display& display, const std::filesystem::path& file, const scene::Scene& scene,
                           const mesh::ElementMesh& mesh, std::span<const double> values, visual::FalseColour look) {
  look.camera = drawable_camera(scene);
  results::write_png(file, visual::false_colour(display, scene, mesh, values, look));
}

}  // namespace interflect::apps
