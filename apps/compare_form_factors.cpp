#include <algorithm>
#include <array>
#include <cstdio>
#include <string_view>

#include "apps/commands.h"
#include "apps/read_scene.h"
#include "core/format.h"
#include "fem/method_comparison.h"
#include "fem/radiosity.h"
#include "results/atomic_file.h"
#include "results/csv.h"
#include "results/output_directory.h"
#include "results/record.h"
#ifdef INTERFLECT_WITH_VTK
#include "results/image_file.h"
#include "visual/plot.h"
#endif

namespace interflect::apps {
namespace {

using fem::MethodScore;

std::string csv_of(const std::vector<MethodScore>& scores) {
  results::Csv csv;
  for (const char* heading :
       {"method", "setting", "seconds", "largest_row_error", "mean_row_error", "stated_row_error", "energy_error"})
    csv.text(heading);
  csv.end_line();
  for (const MethodScore& s : scores) {
    csv.text(s.method).text(s.setting).number(s.seconds).number(s.largest_row_error).number(s.mean_row_error);
    csv.number(s.stated_row_error).number(s.energy_error).end_line();
  }
  return csv.str();
}

constexpr const char* row_pattern = "%-17s  %-31s  %8s  %12s  %9s  %9s  %9s\n";

std::string heading() {
  return "row error: sum_j |F_ij - exact|, the largest and the mean of all rows; stated: the largest that the method\n"
         "states; energy: max |sum_j F_ij - exact|, light that is lost or made; time: all of a method's own work\n" +
         core::format(row_pattern, "method", "setting", "time s", "largest", "mean", "stated", "energy");
}

std::string row_of(const MethodScore& s) {
  const auto error = [](double value) { return core::format("%.2g", value); };
  return core::format(row_pattern, s.method.c_str(), s.setting.c_str(), core::format("%.3g", s.seconds).c_str(),
                      error(s.largest_row_error).c_str(), error(s.mean_row_error).c_str(),
                      error(s.stated_row_error).c_str(), error(s.energy_error).c_str());
}

results::Record record_of(const std::vector<MethodScore>& scores, Index elements) {
  results::Record::List list;
  for (const MethodScore& s : scores)
    list.push_back(results::Record()
                       .add("method", s.method)
                       .add("setting", s.setting)
                       .add("seconds", s.seconds)
                       .add("largest_row_error", s.largest_row_error)
                       .add("mean_row_error", s.mean_row_error)
                       .add("stated_row_error", s.stated_row_error)
                       .add("energy_error", s.energy_error));
  results::Record record;
  return record.add("elements", static_cast<std::int64_t>(elements)).add("methods", std::move(list));
}

#ifdef INTERFLECT_WITH_VTK
/// Where a method's curve is drawn: hemicubes lie on each other, and show if a full marker is below two hollow ones,
/// which curves have by turns (visual/plot.h).
std::size_t place_of(const std::string& method) {
  constexpr std::array<std::string_view, 4> first{"hemicube-midpoint", "hemicube", "global-lines", "hemicube-max"};
  return static_cast<std::size_t>(std::find(first.begin(), first.end(), method) - first.begin());
}

/// Mean row error against time, a curve a method; the reference has no error of its own.
void write_plot(const std::filesystem::path& file, const std::vector<MethodScore>& scores) {
  visual::Plot plot{"form factors: error against time", "time [s]", "mean over rows of sum_j |F_ij - exact|", {}};
  for (std::size_t k = 0; k + 1 < scores.size(); ++k) {
    const MethodScore& s = scores[k];
    if (plot.curves.empty() || plot.curves.back().name != s.method) plot.curves.push_back({s.method, {}, {}});
    plot.curves.back().x.push_back(s.seconds);
    plot.curves.back().y.push_back(s.mean_row_error);
  }
  std::stable_sort(plot.curves.begin(), plot.curves.end(),
                   [](const auto& a, const auto& b) { return place_of(a.name) < place_of(b.name); });
  results::write_png(file, visual::plot_picture(plot));
}
#endif

}  // namespace

ExitStatus compare_form_factors(const CompareFormFactorsOptions& options, const CommonOptions& common, Run& run) {
  const scene::Scene scene = read_to_solve(options.scene, SceneUse::exchange);
  fem::RadiositySettings settings;
  settings.element_size = options.element_size;
  const mesh::ElementMesh mesh = fem::elements_of(scene, settings, mesh::is_active);
  const results::OutputDirectory folder(options.out);
  const bool talk = !common.json && !common.quiet;
  if (talk)
    std::printf("%s elements, bounding box %s\n",
                core::format_count(static_cast<unsigned long long>(mesh.size())).c_str(), box_text(scene).c_str());
  std::fflush(stdout);
  const auto rays = raycast::make_ray_caster("embree", scene);
  if (talk) std::fputs(heading().c_str(), stdout);
  const auto told = [&](const MethodScore& s) {  // the table grows: the whole takes minutes
    if (!talk) return;
    std::fputs(row_of(s).c_str(), stdout);
    std::fflush(stdout);
  };
  const std::vector<MethodScore> scores =
      fem::compare_methods({scene, mesh.patches(), *rays, run.seed}, options.tolerance, run, told);
  results::write_atomically(options.out / "form_factors.csv", csv_of(scores));
#ifdef INTERFLECT_WITH_VTK
  write_plot(options.out / "form_factors.png", scores);
#endif
  if (common.json) std::printf("%s\n", results::json_text(record_of(scores, mesh.size())).c_str());
  if (talk) std::printf("\nwritten to %s\n", options.out.string().c_str());
  return success;
}

}  // namespace interflect::apps
