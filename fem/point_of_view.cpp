#include "fem/point_of_view.h"

#include "core/error.h"

namespace interflect::fem {

void require_point_of_view(const scene::Camera& camera) {
  scene::require_valid(camera);
  if (camera.has_lens())
    throw core::InputError("camera '" + camera.name + "'", "radiosity knows no thin lens; interflect trace does");
}

}  // namespace interflect::fem
