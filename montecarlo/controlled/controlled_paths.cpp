#include "montecarlo/controlled/controlled_paths.h"

#include <algorithm>

#include "montecarlo/path_wave.h"
#include "montecarlo/roulette.h"

namespace interflect::montecarlo {

/// What goes with paths whose solution is known: g, and a roulette by what is expected.
class ControlledPaths::Control {
 public:
  struct Of {
    Spectrum known{};       ///< h where it is; zero where q would be
    double carried_on = 0;  ///< T rho there
    Spectrum control{};     ///< g so far
    double expected = 0;    ///< F, as a radiance, weighed
  };
  explicit Control(const ControlledPaths& of) : of_(of) {}

  /// What the solution says stands in for the rest of a path, whether it goes on or not.
  Unaccompanied::Roulette play(Of& path, PathEstimator::Carried& carried, double u) const {
    if (path.known.is_zero()) return Unaccompanied::Roulette::not_played;
    const Spectrum sent = carried.throughput * path.known;
    path.control -= sent;
    const double q = survival(path, sent);
    if (!(u < q)) return Unaccompanied::Roulette::lost;
    carried.throughput /= q;
    path.control += sent / q;
    return Unaccompanied::Roulette::won;
  }
  void arrived(Of& path, const PathEstimator::Vertex& at, const PathEstimator::Carried& carried,
               const scene::SurfacePoint& met) const {
    path.carried_on = carried_on(at, carried);
    path.known = path.carried_on > 0 ? of_.solution_.at(met).reflected * inv_pi : Spectrum::zero();
  }
  double weigh(const Spectrum& radiance) const { return of_.paths_.scene().weigh(radiance); }

 private:
  /// q, where T h is sent.
  double survival(const Of& path, const Spectrum& sent) const {
    if (path.expected == 0) return going_on(path.carried_on);
    return going_on(share_that_goes_on * std::max(path.carried_on, weigh(sent) / path.expected));
  }
  /// The largest T rho where all of a Bsdf is diffuse, and has one f; else 0.
  static double carried_on(const PathEstimator::Vertex& at, const PathEstimator::Carried& carried) {
    const Bsdf& bsdf = *at.bsdf;
    if (bsdf.glossy() || bsdf.mirrors() || bsdf.lets_pass() || bsdf.transmits()) return 0;
    const Spectrum reflectance = bsdf.f(at.to_eye, at.to_eye) * pi;
    return (carried.throughput * reflectance).max() / carried.squeezed;
  }

  const ControlledPaths& of_;
};

double control_factor(const core::ControlVariate& pilot) { return std::clamp(pilot.factor(), 0.0, 1.5); }

ControlledPaths::ControlledPaths(const scene::Scene& scene, const raycast::RayCaster& caster,
                                 const measure::SurfaceSolution& solution, const measure::PathClasses& paths)
    : solution_(solution), paths_(scene, caster, paths) {}

void ControlledPaths::irradiance(std::span<const Receiver> at, const PathEstimator::Keys& keys, std::uint32_t block,
                                 double expected, std::span<Found> found) const {
  Wave wave(paths_, keys, at.size(), Control(*this));
  for (std::size_t first = 0; first < at.size(); first += Wave::most) {
    const std::size_t count = std::min(Wave::most, at.size() - first);
    wave.begin(first, count);
    for (std::size_t k = 0; k < count; ++k) {
      wave.start(k, paths_.receiving(at[first + k]));
      wave.of(k).expected = expected * inv_pi;
    }
    wave.follow(block);
    for (std::size_t k = 0; k < count; ++k) found[first + k] = {pi * wave.found(k), pi * wave.of(k).control};
  }
}

void ControlledPaths::radiance(std::span<const std::optional<raycast::Ray>> from_eye, const PathEstimator::Keys& keys,
                               std::uint32_t block, std::span<Found> found) const {
  Wave wave(paths_, keys, from_eye.size(), Control(*this));
  for (std::size_t first = 0; first < from_eye.size(); first += Wave::most) {
    const std::size_t count = std::min(Wave::most, from_eye.size() - first);
    wave.begin(first, count);
    wave.start(from_eye.subspan(first, count));
    for (const std::uint32_t k : wave.live())
      wave.of(k).expected = paths_.scene().weigh(wave.found(k) + wave.of(k).known);
    wave.follow(block);
    for (std::size_t k = 0; k < count; ++k) found[first + k] = {wave.found(k), wave.of(k).control};
  }
}

}  // namespace interflect::montecarlo
