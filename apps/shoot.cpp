#include <chrono>
#include <cmath>
#include <cstdio>
#include <set>

#include "apps/commands.h"
#include "apps/read_scene.h"
#include "apps/solution_files.h"
#include "apps/solved_scene.h"
#include "core/build_info.h"
#include "core/format.h"
#include "core/log.h"
#include "core/memory.h"
#include "core/seconds_since.h"
#include "fem/error_summary.h"
#include "fem/progressive_radiosity.h"
#include "results/atomic_file.h"
#include "results/checkpoint.h"
#include "results/csv.h"
#include "results/factors.h"

namespace interflect::apps {
namespace {

using Clock = std::chrono::steady_clock;

/// All that the numbers depend on beside the equations.
results::Record settings_of(const ShootOptions& options, const CommonOptions& common) {
  const fem::RadiositySettings& s = options.settings;
  results::Record record;
  record.add("form_factors", s.form_factors)
      .add("quadrature_tolerance", s.quadrature_tolerance)
      .add("visibility_rays", s.visibility_rays)
      .add("visibility_error", s.visibility_error)
      .add("samples", s.samples)
      .add("resolution", s.resolution)
      .add("intersector", s.intersector)
      .add("solver", s.solver)
      .add("overshoot", s.solver_settings.overshoot)
      .add("seed", common.seed);
  return record;
}

/// One run of the command, which may go on where an earlier one was stopped.
class Shooting {
 public:
  Shooting(SolvedScene& solved, const ShootOptions& options, const CommonOptions& common, Run& run)
      : solved_(solved),
        options_(options),
        common_(common),
        run_(run),
        progressive_(solved.scene, options.settings, run),
        shots_(progressive_.begin()),
        history_(0, columns) {
    if (options.resume) resume();
  }

  void advance() {
    report_ = progressive_.advance(
        shots_,
        [&](const fem::Shots& now) {
          const bool due = options_.every > 0 && now.count() % options_.every == 0;
          if (due) look();
          if (due || core::seconds_since(saved_) > seconds_between_checkpoints) save();
        },
        options_.shots);
    show();
    save();
  }

  void write() const {
    write_tables_and_field(solved_, options_.out, options_.pictures);
    results::write_atomically(options_.out / "shots.csv", csv());
    results::write_json(options_.out / "summary.json", record());
  }

  bool converged() const { return report_.converged(); }

  results::Record record() const {
    const fem::ErrorSummary error = fem::summarise_error(solved_.solution, solved_.scene);
    const fem::ErrorShares shares = error_shares();
    results::Record record;
    return record.add("version", core::build_info().version)
        .add("command", common_.command_line)
        .add("scene", solved_.scene.file.string())
        .add("threads", run_.threads.count())
        .add("element_size_m", solved_.solution.element_size)
        .add("settings", settings_of(options_, common_))
        .add("elements", solved_.solution.mesh.size())
        .add("emitting_elements", progressive_.emitting())
        .add("emitting_surfaces", emitting_surfaces())
        .add("shots", shots_.count())
        .add("unshot", progressive_.unshot_fraction(shots_))
        .add("stopped", solvers::describe(report_.why))
        .add("mean_irradiance", error.mean_irradiance)
        .add("mean_irradiance_error", error.mean_error)
        .add("relative_error_l2", error.relative_l2)
        .add("relative_error_l2_of_elements", shares.of_elements)
        .add("relative_error_l2_of_unshot", shares.of_unshot)
        .add("relative_noise_l2", error.relative_noise_l2)
        .add("seconds", seconds())
        .add("warnings", solved_.warnings)
        .add("peak_memory_bytes", static_cast<std::uint64_t>(std::llround(core::peak_memory_bytes())));
  }

  std::string text() const {
    return core::format(
        "\n%s elements; %zu %s, in %td elements\n%td shots in %s, %s: %s of all that is emitted is unshot\n"
        "%s%s",
        core::format_count(static_cast<unsigned long long>(solved_.solution.mesh.size())).c_str(), emitting_surfaces(),
        emitting_surfaces() == 1 ? "surface emits" : "surfaces emit", progressive_.emitting(), shots_.count(),
        core::format_duration(seconds()).c_str(), solvers::describe(report_.why).c_str(),
        core::format_percent(progressive_.unshot_fraction(shots_)).c_str(), error_text().c_str(),
        means_text(solved_).c_str());
  }

  Index shots() const { return shots_.count(); }

 private:
  static constexpr double seconds_between_checkpoints = 60;
  static constexpr Index columns = 5;  ///< of the history: shots, seconds, unshot, mean irradiance, its relative error

  /// Those that a user has named; each is cut into elements.
  std::size_t emitting_surfaces() const {
    std::set<std::uint32_t> emit;
    for (const mesh::ElementMesh::Part& part : solved_.solution.mesh.parts())
      for (std::size_t i = part.first; i < part.first + part.count; ++i)
        if (!solved_.solution.exitance[i].is_zero()) emit.insert(part.surface.value);
    return emit.size();
  }

  fem::ErrorShares error_shares() const {
    return fem::shares_of_error(solved_.solution, solved_.scene, progressive_.missing(shots_));
  }

  /// What the stated error is of: without a matrix it is wide, and an early picture is far nearer than it says.
  std::string error_text() const {
    const auto [of_unshot, of_elements] = error_shares();
    return irradiance_text(solved_) +
           core::format(
               "            %s: what is unshot, as if all of it went elsewhere than evenly to all (more shots, less)\n"
               "            %s: what light varies by inside elements, in place of what a matrix tells (smaller "
               "elements, "
               "less)\n",
               core::format_percent(of_unshot).c_str(), core::format_percent(of_elements).c_str());
  }

  std::filesystem::path checkpoint_file() const { return options_.out / "shots.h5"; }
  double seconds() const { return seconds_before_ + core::seconds_since(start_); }

  results::Checkpoint checkpoint() const {
    const std::string geometry = results::geometry_digest(solved_.scene, progressive_.mesh().patches());
    return {results::system_digest(geometry, progressive_.system()),
            results::json_text(settings_of(options_, common_)),
            static_cast<std::uint64_t>(shots_.count()),
            {{"shot", shots_.state.x},
             {"unshot", shots_.state.residual},
             {"irradiance", shots_.irradiance},
             {"variance", shots_.variance},
             {"bound", shots_.bound},
             {"history", history_}}};
  }
  void save() {
    results::write_checkpoint(checkpoint_file(), checkpoint());
    saved_ = Clock::now();
  }
  void resume() {
    const results::Checkpoint found = results::read_checkpoint(checkpoint_file(), checkpoint());
    shots_.state.step = static_cast<int>(found.step);
    shots_.state.x = found.matrix("shot");
    shots_.state.residual = found.matrix("unshot");
    shots_.irradiance = found.matrix("irradiance");
    shots_.variance = found.matrix("variance");
    shots_.bound = found.matrix("bound");
    history_ = found.matrix("history");
    if (history_.rows() > 0) seconds_before_ = history_(history_.rows() - 1, 1);
  }

  /// What there is becomes the solution, and a line of the history.
  void show() {
    solved_.solution = progressive_.shown(shots_, report_);
    const fem::ErrorSummary error = fem::summarise_error(solved_.solution, solved_.scene);
    const double line[columns] = {static_cast<double>(shots_.count()), seconds(), progressive_.unshot_fraction(shots_),
                                  error.mean_irradiance, error.relative_l2};
    const Index last = history_.rows() - 1;
    const bool again = last >= 0 && history_(last, 0) == line[0];
    if (!again) history_.conservativeResize(last + 2, columns);
    history_.row(history_.rows() - 1) = Eigen::Map<const Eigen::RowVectorXd>(line, columns);
  }
  void look() {
    show();
    const auto folder = options_.out / core::format("after_%06td", shots_.count());
    const results::OutputDirectory made(folder);
    write_field(solved_, folder, options_.pictures);
  }

  std::string csv() const {
    results::Csv csv;
    for (const char* heading : {"shots", "seconds", "unshot", "mean_irradiance", "relative_error"}) csv.text(heading);
    csv.end_line();
    for (Index k = 0; k < history_.rows(); ++k) {
      for (Index c = 0; c < columns; ++c) csv.number(history_(k, c));
      csv.end_line();
    }
    return csv.str();
  }

  SolvedScene& solved_;
  const ShootOptions& options_;
  const CommonOptions& common_;
  Run& run_;
  fem::ProgressiveRadiosity progressive_;
  fem::Shots shots_;
  solvers::ColumnMatrix history_;
  solvers::SolverReport report_;
  double seconds_before_ = 0;
  Clock::time_point start_ = Clock::now(), saved_ = start_;
};

}  // namespace

ExitStatus shoot(const ShootOptions& options, const CommonOptions& common, Run& run) {
  scene::Scene scene = read_to_solve(options.scene);
  auto points = measure::sensor_points(scene);
  SolvedScene solved(std::move(scene), {}, fem::RadiositySolution(mesh::ElementMesh({}), 0));
  solved.points = std::move(points);
  solved.warnings = lines_of(solved.scene.warnings);
  solved.rays = raycast::make_ray_caster(options.settings.intersector, solved.scene);
  solved.folder = std::make_unique<results::OutputDirectory>(options.out);
  Shooting shooting(solved, options, common, run);
  shooting.advance();
  Run to_the_end = run.to_the_end();  // what is written of a run that was stopped is as good as of one that was not
  solved.at_points = answers_at(solved.points, solved.method(), solved.scene, to_the_end);
  shooting.write();
  if (!shooting.converged())
    core::log::shortfall(
        core::format("light is left unshot after %td shots: --resume goes on from here", shooting.shots()));
  if (common.json)
    std::printf("%s\n", results::json_text(shooting.record()).c_str());
  else if (!common.quiet)
    std::printf("%s\nwritten to %s\n", shooting.text().c_str(), options.out.string().c_str());
  return shooting.converged() ? success : not_met;
}

}  // namespace interflect::apps
