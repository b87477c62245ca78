#include <cstdio>
#include <limits>

#include "apps/commands.h"
#include "apps/pictures.h"
#include "apps/questions.h"
#include "apps/solution_files.h"
#include "apps/table.h"
#include "core/format.h"
#include "montecarlo/path_tracer.h"
#include "montecarlo/render.h"
#include "results/certificate_record.h"
#include "results/image_file.h"
#include "results/vtu.h"
#include "validation/certificate.h"

namespace interflect::apps {
namespace {

using validation::Certificate;
using validation::Judged;

constexpr double difference_scale = 0.1;      ///< relative difference at full colour in the picture
constexpr double accuracy_of_norms = 3;       ///< the reference's 95 % error may be this many times the accuracy asked of a value
constexpr double not_judged = std::numeric_limits<double>::quiet_NaN();

/// Both methods' answers, as mean irradiances, in the order of the questions.
std::vector<Judged> judge(const SolvedScene& solved, const Questions& questions, const montecarlo::PathTracer& tracer, Run& run) {
  const std::vector<Estimate> fem = solved.method().answer(solved.scene, questions.asked, run);
  const std::vector<Estimate> mc = tracer.answer(solved.scene, questions.asked, run);
  std::vector<Judged> judged = questions.judged;
  for (std::size_t k = 0; k < judged.size(); ++k) {
    const double per_area = std::holds_alternative<measure::Flux>(questions.asked[k]) ? 1 / judged[k].area : 1;
    judged[k].fem = scaled(fem[k], per_area);
    judged[k].mc = scaled(mc[k], per_area);
  }
  return judged;
}

validation::EnergyBalance fem_energy(const fem::EnergyBalance& e) {
  validation::EnergyBalance out;
  out.emitted = e.emitted;
  out.absorbed = e.absorbed;
  out.lost = e.emitted - e.absorbed - e.residual;
  out.on_backs = e.on_backs;
  out.residual = e.residual;
  out.standard_error = e.split_error;
  return out;
}

/// The rows of the path tracer in the order of the mesh's parts, which is that of the first judged.
std::vector<results::SurfaceRow> traced_rows(const SolvedScene& solved, std::span<const Judged> judged) {
  std::vector<results::SurfaceRow> rows;
  for (std::size_t k = 0; k < solved.solution.mesh.parts().size(); ++k) {
    const mesh::ElementMesh::Part& part = solved.solution.mesh.parts()[k];
    rows.push_back(results::surface_row(solved.scene, part.surface, part.side, judged[k].mc));
  }
  return rows;
}

validation::EnergyBalance traced_energy(const SolvedScene& solved, std::span<const Judged> judged) {
  std::vector<double> areas;
  std::vector<Spectrum> reflectances;
  std::vector<Estimate> irradiance;
  for (std::size_t k = 0; k < solved.solution.mesh.parts().size(); ++k) {
    const mesh::ElementMesh::Part& part = solved.solution.mesh.parts()[k];
    areas.push_back(judged[k].area);
    reflectances.push_back(solved.scene.material(part.surface).reflectance_of(part.side));
    irradiance.push_back(judged[k].mc);
  }
  return validation::sampled_energy(solved.scene.emitted_flux(), areas, reflectances, irradiance);
}

/// Per element: both values, the noise of the reference, relative difference and z; NaN where an element was not judged.
void write_field(const SolvedScene& solved, std::span<const Judged> judged, const Certificate& certificate,
                 const std::filesystem::path& file) {
  const auto n = static_cast<std::size_t>(solved.solution.mesh.size());
  const scene::Scene& scene = solved.scene;
  std::vector<double> fem(n), mc(n, not_judged), standard_error(n, not_judged), bound(n), relative(n, not_judged), z(n, not_judged);
  for (std::size_t i = 0; i < n; ++i) {
    fem[i] = scene.weigh(solved.solution.irradiance[i]);
    bound[i] = scene.weigh(solved.solution.irradiance_error[i]);
  }
  for (std::size_t k = 0; k < judged.size(); ++k) {
    if (judged[k].kind != Judged::Kind::element) continue;
    const auto i = static_cast<std::size_t>(judged[k].element);
    const validation::Difference& d = certificate.judgements.front().comparison.differences[k];
    mc[i] = d.mc;
    standard_error[i] = scene.weigh(judged[k].mc.standard_error);
    relative[i] = d.mc != 0 ? d.difference() / d.mc : not_judged;
    z[i] = d.z;
  }
  std::vector<results::CellField> fields{results::scalar_field("irradiance_fem", fem),
                                         results::scalar_field("irradiance_traced", mc),
                                         results::scalar_field("standard_error_traced", standard_error),
                                         results::scalar_field("error_bound_fem", bound),
                                         results::scalar_field("relative_difference", relative),
                                         results::scalar_field("z", z)};
  for (results::CellField& ids : results::id_fields(solved.solution.mesh)) fields.push_back(std::move(ids));
  results::write_vtu(file, solved.solution.mesh, fields);
}

void write_pictures(const SolvedScene& solved, const ValidateOptions& options, Run& run) {
  for (std::uint32_t c = 0; c < solved.scene.cameras.size(); ++c) {
    const core::Image fem = picture_of(solved.method(), solved.scene, {c}, run);
    const auto samples = static_cast<std::uint64_t>(options.picture_samples);
    const core::Image traced = montecarlo::render(solved.scene, {c}, samples, run, options.solve.settings.intersector).radiance;
    const std::string name = c == 0 ? "validation.png" : "validation_" + solved.scene.cameras[c].name + ".png";
    results::write_png(options.solve.out / name, comparison_picture(solved.scene, fem, traced, difference_scale));
  }
}

std::string interval_text(const validation::Interval& i) {
  return core::format("%.2f %% (%.2f .. %.2f)", 100 * i.value, 100 * i.low, 100 * i.high);
}

std::string certificate_text(const Certificate& certificate) {
  Table table({"irradiance", "agree", "L2, 95 % interval", "L1", "max", "reference"});
  for (const validation::Judgement& j : certificate.judgements)
    for (const auto& [what, norms] : {std::pair{"", &j.norms()}, {", not emitting", j.elements_dark.measurements > 0 ? &j.elements_dark : &j.surfaces_dark}})
      table.add({j.reading.name + what, core::format("%.1f %%", 100 * j.comparison.share), interval_text(norms->l2),
                 core::format("%.2f %%", 100 * norms->l1.value), core::format("%.2f %%", 100 * norms->max.value),
                 core::format("%.2f %%", 100 * norms->reference_error)});
  std::string text = "\n" + table.text() + "\n";
  if (!certificate.worst_surface.empty())
    text += core::format("worst surface: %s, %+.2f %%\n", certificate.worst_surface.c_str(), 100 * certificate.worst_surface_difference);
  for (const std::string& reason : certificate.reasons) text += "not validated: " + reason + "\n";
  for (const std::string& remark : certificate.remarks) text += "remark: " + remark + "\n";
  return text + certificate.verdict + "\n";
}

}  // namespace

ExitStatus validate(const ValidateOptions& options, const CommonOptions& common, Run& run) {
  const auto solved = solve_scene(options.solve, common, run);
  if (!solved) return success;
  write_solution(*solved, options.solve, common);
  const bool talk = !common.json && !common.quiet;
  if (talk) std::printf("%s", solution_text(*solved).c_str());

  const auto elements = options.all_elements ? static_cast<std::size_t>(solved->solution.mesh.size())
                                             : static_cast<std::size_t>(options.elements);
  const Questions questions = questions_about(solved->scene, solved->solution, elements, run.seed);
  montecarlo::PathTracerSettings traced;
  traced.target = options.accuracy;
  traced.intersector = options.solve.settings.intersector;
  const montecarlo::PathTracer tracer(traced);
  if (talk)
    std::printf("\ntracing %s measurements to %.2g %%, about %s\n", core::format_count(questions.asked.size()).c_str(),
                100 * options.accuracy, core::format_duration(tracer.forecast(solved->scene, questions.asked, run)).c_str());
  std::fflush(stdout);
  const std::vector<Judged> judged = judge(*solved, questions, tracer, run);

  validation::Settings settings;
  settings.accuracy = accuracy_of_norms * options.accuracy;
  const Certificate certificate = validation::certify(solved->scene, judged, fem_energy(solved->solution.energy),
                                                      traced_energy(*solved, judged), settings);
  const std::filesystem::path& out = options.solve.out;
  results::Record record = results::certificate_record(certificate, judged, solved->scene.channels);
  record.add("run", summary_record(*solved, options.solve, common)).add("accuracy", options.accuracy);
  results::write_json(out / "validation.json", record);
  write_field(*solved, judged, certificate, out / "validation.vtu");
  results::write_surfaces_csv(out / "traced_surfaces.csv", traced_rows(*solved, judged), solved->scene.channel_count());
  std::vector<Estimate> traced_points;
  for (const Judged& j : judged)
    if (j.kind == Judged::Kind::sensor) traced_points.push_back(j.mc);
  results::write_sensors_csv(out / "traced_sensors.csv", solved->points, traced_points, solved->scene.channel_count());
  if (options.solve.pictures) write_pictures(*solved, options, run);

  if (common.json) std::printf("%s\n", results::json_text(record).c_str());
  if (talk) std::printf("%s\nwritten to %s\n", certificate_text(certificate).c_str(), out.string().c_str());
  return certificate.passed ? success : not_met;
}

}  // namespace interflect::apps
