#include "apps/validation_files.h"

#include <limits>

#include "apps/solution_files.h"
#include "apps/table.h"
#include "core/format.h"
#include "mesh/bare_patches.h"
#include "results/certificate_record.h"
#include "results/tables.h"
#include "results/vtu.h"

namespace interflect::apps {
namespace {

using validation::Certificate;
using validation::Judged;

constexpr double not_judged = std::numeric_limits<double>::quiet_NaN();

/// The rows of the path tracer in the order of the mesh's parts, which is that of the first judged.
std::vector<results::SurfaceRow> traced_rows(const SolvedScene& solved, std::span<const Judged> judged) {
  std::vector<results::SurfaceRow> rows;
  for (std::size_t k = 0; k < solved.solution.mesh.parts().size(); ++k) {
    const mesh::ElementMesh::Part& part = solved.solution.mesh.parts()[k];
    rows.push_back(results::surface_row(solved.scene, part.surface, part.side, judged[k].mc));
  }
  return rows;
}

/// Per element: both values, the noise of the reference, relative difference and z; NaN where an element was not
/// judged.
void write_field(const SolvedScene& solved, std::span<const Judged> judged, const Certificate& certificate,
                 const std::filesystem::path& file) {
  const auto n = static_cast<std::size_t>(solved.solution.mesh.size());
  const scene::Scene& scene = solved.scene;
  std::vector<double> fem(n), mc(n, not_judged), standard_error(n, not_judged), bound(n), relative(n, not_judged),
      z(n, not_judged);
  for (std::size_t i = 0; i < n; ++i) {
    fem[i] = scene.weigh(solved.solution.irradiance[i]);
    bound[i] = scene.weigh(solved.solution.irradiance_error[i]);
  }
  for (std::size_t k = 0; k < judged.size(); ++k) {
    if (judged[k].kind != Judged::Kind::element) continue;
    const auto i = static_cast<std::size_t>(judged[k].element);
    const validation::Judgement& weighted = certificate.judgements.front();
    const validation::Difference& d = weighted.comparison.differences[k];
    mc[i] = d.mc;
    standard_error[i] = weighted.reading.noise(judged[k].mc).standard_error;
    relative[i] = d.mc != 0 ? d.difference() / d.mc : not_judged;
    z[i] = d.z;
  }
  std::vector<results::CellField> fields{results::scalar_field("irradiance_fem", fem),
                                         results::scalar_field("irradiance_traced", mc),
                                         results::scalar_field("standard_error_traced", standard_error),
                                         results::scalar_field("error_bound_fem", bound),
                                         results::scalar_field("relative_difference", relative),
                                         results::scalar_field("z", z)};
  const std::vector<scene::SurfacePatch> bare = mesh::bare_patches(scene, solved.solution.mesh);
  for (results::CellField& ids : results::id_fields(solved.solution.mesh, bare)) fields.push_back(std::move(ids));
  results::write_vtu(file, solved.solution.mesh, fields, bare);
}

std::string interval_text(const validation::Interval& i) {
  return core::format("%.2f %% (%.2f .. %.2f)", 100 * i.value, 100 * i.low, 100 * i.high);
}

const validation::Norms& dark_norms(const validation::Judgement& j) {
  return j.elements_dark.measurements > 0 ? j.elements_dark : j.surfaces_dark;
}

std::string expected_text(const validation::ExpectedCheck& e) {
  return core::format("expected of %s: %s %.6g +- %s; FEM %.6g, path tracing %.6g: %s\n", e.sensor.c_str(),
                      e.statistic.c_str(), e.expected, core::format_percent(e.tolerance).c_str(), e.fem, e.mc,
                      e.passed() ? "holds" : "does not hold");
}

}  // namespace

void write_traced(const SolvedScene& solved, std::span<const Judged> judged, const Certificate& certificate,
                  const std::filesystem::path& out) {
  write_field(solved, judged, certificate, out / "validation.vtu");
  results::write_surfaces_csv(out / "traced_surfaces.csv", traced_rows(solved, judged), solved.scene);
  std::vector<Estimate> traced_points;
  for (const Judged& j : judged)
    if (j.kind == Judged::Kind::sensor) traced_points.push_back(j.mc);
  results::write_sensors_csv(out / "traced_sensors.csv", solved.points, traced_points, solved.scene);
}

results::Record write_records(const SolvedScene& solved, std::span<const Judged> judged, const Certificate& certificate,
                              const ValidateOptions& options, const CommonOptions& common, const Run& run) {
  results::Record record = results::certificate_record(certificate, judged, solved.scene.channels);
  record.add("run", summary_record(solved, options.solve, common, run))
      .add("accuracy", options.accuracy)
      .add("integrator", options.integrator)
      .add("stopped", run.stop.stop_requested());
  results::write_json(options.solve.out / "validation.json", record);
  write_summary(solved, options.solve, common, run);
  return record;
}

std::string certificate_text(const Certificate& certificate) {
  Table table({"irradiance", "agree", "L2, 95 % interval", "L1", "max, of mean H", "reference"});
  for (const validation::Judgement& j : certificate.judgements)
    for (const auto& [what, norms] : {std::pair{"", &j.norms()}, {", not emitting", &dark_norms(j)}})
      table.add({j.reading.name + what, core::format("%.1f %%", 100 * j.comparison.share), interval_text(norms->l2),
                 core::format_percent(norms->l1.value), core::format_percent(norms->max.value),
                 core::format_percent(norms->reference_error)});
  std::string text = "\n" + table.text() + "\n";
  if (!certificate.worst_surface.empty())
    text += core::format("worst surface: %s, %+.2f %% of its own H\n", certificate.worst_surface.c_str(),
                         100 * certificate.worst_surface_difference);
  for (const validation::ExpectedCheck& e : certificate.expected) text += expected_text(e);
  for (const std::string& reason : certificate.reasons) text += "not validated: " + reason + "\n";
  for (const std::string& remark : certificate.remarks) text += "remark: " + remark + "\n";
  return text + certificate.verdict + "\n";
}

}  // namespace interflect::apps
