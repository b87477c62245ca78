#include "scene/inspection.h"

#include <algorithm>
#include <utility>

#include "core/error.h"
#include "core/format.h"
#include "scene/inspection_parts.h"

namespace interflect::scene {

using Kind = Inspection::Finding::Kind;

bool Inspection::has(Kind kind) const {
  return std::any_of(findings.begin(), findings.end(), [kind](const Finding& f) { return f.kind == kind; });
}

bool Inspection::closed() const { return !has(Kind::gap) && !has(Kind::rim); }

std::string describe(Kind kind) {
  switch (kind) {
    case Kind::gap:
      return "gap (open edge)";
    case Kind::rim:
      return "rim of a two-sided surface";
    case Kind::inconsistent_normals:
      return "neighbours face opposite ways";
    case Kind::duplicate_faces:
      return "duplicate faces";
    case Kind::coplanar_overlap:
      return "coplanar faces overlap";
  }
  return "";
}

std::string overlap_text(const Inspection::Finding& overlap) {
  const std::string which = overlap.other.empty() ? "faces of '" + overlap.surface + "'"
                                                  : "'" + overlap.surface + "' and '" + overlap.other + "'";
  return core::format("%s lie in one plane and overlap in %.3g m2 at (%.6g, %.6g, %.6g)", which.c_str(), overlap.twice,
                      overlap.where.x(), overlap.where.y(), overlap.where.z());
}

std::vector<Inspection::Finding> require_each_place_once(const Scene& scene, Twice may_be) {
  std::vector<Inspection::Finding> allowed;
  for (Inspection::Finding& found : overlaps(scene)) {
    if (!(found.twice > 0)) continue;
    if (may_be == Twice::nothing || !found.other.empty())
      throw core::InputError(scene.file.empty() ? "scene" : scene.file.string(),
                             overlap_text(found) + ": what is seen there is not defined; cut them, or leave one out");
    allowed.push_back(std::move(found));
  }
  return allowed;
}

Inspection inspect(const Scene& scene) {
  Inspection inspection;
  if (scene.facets.empty()) return inspection;
  const double tolerance = 1e-6 * scene.box().diagonal().norm();
  find_edge_faults(scene, tolerance, inspection);
  find_coplanar_faces(scene, tolerance, inspection);
  std::stable_sort(inspection.findings.begin(), inspection.findings.end(),
                   [](const auto& a, const auto& b) { return a.kind != b.kind ? a.kind < b.kind : a.size > b.size; });
  return inspection;
}

}  // namespace interflect::scene
