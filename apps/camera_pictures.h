#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/image.h"
#include "measure/method.h"
#include "montecarlo/render.h"
#include "scene/scene.h"

namespace interflect::apps {

/// The camera of that name, the first where there is none.  @throws core::InputError  with the names known
scene::CameraId camera_named(const scene::Scene& scene, const std::string& name);

/// Those that VTK draws pictures by, pinholes; the others are told of by name in a warning.
std::vector<scene::CameraId> drawable_cameras(const scene::Scene& scene);
/// The first of them.
std::optional<scene::Camera> drawable_camera(const scene::Scene& scene);

/// What a method sees through a camera, and how wrong it may be [W/(m² sr) | cd/m²]: the scene's channels.
struct CameraPicture {
  core::Image radiance, error;  ///< error: 95 %, noise and bound
};
CameraPicture picture_of(const measure::Method& method, const scene::Scene& scene, scene::CameraId camera, Run& run);

/// The channels of a picture, then their errors under NAME.error: one EXR that says how sure it is.
core::Image with_errors(const core::Image& radiance, const core::Image& error);
/// The same of a traced one, its standard errors and how many samples each pixel has.
core::Image with_errors_and_samples(const montecarlo::Rendering& rendering);
/// The channels of both, of one size.
core::Image with_channels(const core::Image& image, const core::Image& more);

}  // namespace interflect::apps
