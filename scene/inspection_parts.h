#pragma once

#include "scene/inspection.h"

namespace interflect::scene {

/// The halves of `inspect`, one a file.
/// @param tolerance  lengths below it do not count [m]
void find_edge_faults(const Scene& scene, double tolerance, Inspection& inspection);
void find_coplanar_faces(const Scene& scene, double tolerance, Inspection& inspection);

}  // namespace interflect::scene
