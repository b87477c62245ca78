#pragma once

#include <string>

#include "results/record.h"
#include "scene/scene.h"

/// What `info` says of materials and of lights beside surfaces.
namespace interflect::apps {

/// "0.74" for a value that all channels share, "0.73 0.74 0.71" otherwise.
std::string spectrum_text(const Spectrum& s, int channels);

/// "diffuse", "dielectric: index 1.5, roughness 0.25", "diffuse: opacity 0.5".
std::string finish_text(const scene::Material& material, int channels);
/// The same numbers under the keys of scene files; empty of a diffuse material that is all there.
results::Record finish_record(const scene::Material& material, int channels);

/// How many of each kind with their flux, and a line each; nothing for a scene that has none.
std::string lights_text(const scene::Scene& scene);
/// "name", "type", "flux" [W | lm] where it is finite, and what places it; the sky last.
results::Record::List light_records(const scene::Scene& scene);

}  // namespace interflect::apps
