#include <algorithm>
#include <cstdio>

#include "apps/commands.h"
#include "apps/read_scene.h"
#include "core/format.h"
#include "raycast/exposure.h"
#include "results/record.h"
#include "scene/inspection.h"

namespace interflect::apps {
namespace {

constexpr int rays_per_side = 1024;
constexpr double noticeable = 1e-3;       ///< part of a side's hemisphere
constexpr std::size_t most_printed = 20;  ///< lines of a kind; the rest is counted

using Kind = scene::Inspection::Finding::Kind;

struct Line {
  std::string kind, text;
};

std::string where_text(const Vec3& x) { return core::format("near (%.4g, %.4g, %.4g)", x.x(), x.y(), x.z()); }

Line line_of(const scene::Inspection::Finding& finding) {
  const bool is_area = finding.kind == Kind::duplicate_faces || finding.kind == Kind::coplanar_overlap;
  const std::string names = finding.other.empty() ? finding.surface : finding.surface + " and " + finding.other;
  return {scene::describe(finding.kind), core::format("%s: %.4g %s, %s", names.c_str(), finding.size,
                                                      is_area ? "m2" : "m", where_text(finding.where).c_str())};
}

/// What rays see that the geometry alone does not tell: flipped walls, and openings.
void add_exposures(const scene::Scene& scene, Run& run, std::vector<Line>& lines) {
  const auto caster = raycast::make_ray_caster("embree", scene);
  const std::vector<raycast::Exposure> exposures = raycast::exposures(scene, *caster, rays_per_side, run);
  for (const raycast::Exposure& e : exposures)
    if (e.backs > noticeable)
      lines.push_back(
          {"backs in sight", core::format("%s sees black backs in %.1f %% of its hemisphere: is it, or what surrounds "
                                          "it, flipped?",
                                          scene.side_name(e.surface, e.side).c_str(), 100 * e.backs)});
  const auto open =
      std::count_if(exposures.begin(), exposures.end(), [](const auto& e) { return e.nothing > noticeable; });
  if (open == 0) return;
  const raycast::Exposure& widest = *std::max_element(
      exposures.begin(), exposures.end(), [](const auto& a, const auto& b) { return a.nothing < b.nothing; });
  lines.push_back(
      {"opening in sight",
       core::format("%td of %zu sides of surfaces see out of the scene, %s in %.1f %% of its hemisphere", open,
                    exposures.size(), scene.side_name(widest.surface, widest.side).c_str(), 100 * widest.nothing)});
}

std::vector<Line> findings(const scene::Scene& scene, Run& run) {
  std::vector<Line> lines;
  for (const auto& finding : scene::inspect(scene).findings) lines.push_back(line_of(finding));
  add_exposures(scene, run, lines);
  return lines;
}

bool only_rims(const std::vector<Line>& lines) {
  return std::all_of(lines.begin(), lines.end(),
                     [](const Line& line) { return line.kind == scene::describe(Kind::rim); });
}

void print_text(const std::vector<Line>& lines) {
  for (std::size_t i = 0; i < lines.size();) {
    std::size_t end = i;
    while (end < lines.size() && lines[end].kind == lines[i].kind) ++end;
    std::printf("%s: %zu\n", lines[i].kind.c_str(), end - i);
    for (std::size_t k = i; k < std::min(end, i + most_printed); ++k) std::printf("  %s\n", lines[k].text.c_str());
    if (end - i > most_printed) std::printf("  and %zu more\n", end - i - most_printed);
    i = end;
  }
  if (std::any_of(lines.begin(), lines.end(), [](const Line& line) { return line.kind == scene::describe(Kind::gap); }))
    std::printf("gaps are no error in a scene that is open on purpose (docs/checks.md)\n");
  if (only_rims(lines))
    std::printf("no gaps, flipped normals, duplicate or coplanar faces, and no ray leaves the scene\n");
}

results::Record record_of(const scene::Scene& scene, const std::vector<Line>& lines) {
  results::Record::List list;
  for (const Line& line : lines) list.push_back(results::Record().add("kind", line.kind).add("text", line.text));
  results::Record record;
  record.add("scene", scene.file.string()).add("findings", std::move(list));
  return record;
}

}  // namespace

ExitStatus check(const CheckOptions& options, const CommonOptions& common, Run& run) {
  const scene::Scene scene = read_and_note(options.scene);
  const std::vector<Line> lines = findings(scene, run);
  if (common.json)
    std::printf("%s\n", results::json_text(record_of(scene, lines)).c_str());
  else
    print_text(lines);
  return only_rims(lines) ? success : not_met;  // a sheet that stands free has a rim
}

}  // namespace interflect::apps
