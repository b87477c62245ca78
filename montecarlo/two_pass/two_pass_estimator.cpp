#include "montecarlo/two_pass/two_pass_estimator.h"

#include "montecarlo/roulette.h"
#include "montecarlo/warp.h"

namespace interflect::montecarlo {
namespace {

constexpr std::uint32_t blocks_per_vertex = 4;

/// A surface that a solution for what is diffuse knows.
bool is_diffuse(const Bsdf& bsdf) {
  return !bsdf.glossy() && !bsdf.mirrors() && !bsdf.only_delta() && !bsdf.lets_pass();
}

}  // namespace

measure::PathClasses TwoPassEstimator::traced(int gathers) {
  return measure::PathClasses::of(gathers == 0 ? "L(G|S)*E|L.*G.*D(G|S)*E"
                                               : "L(G|S)*E|LD(G|S)*E|L(G|S)*G(G|S)*D(G|S)*E|L.*G.*D(G|S)*D(G|S)*E");
}

TwoPassEstimator::TwoPassEstimator(const scene::Scene& scene, const raycast::RayCaster& caster, int gathers)
    : caster_(caster), gathers_(gathers), optics_(scene), paths_(scene, caster, traced(gathers)) {}

TwoPassEstimator::Walked TwoPassEstimator::radiance(const raycast::Ray& ray, core::RandomNumbers& numbers,
                                                    std::uint32_t block) const {
  return arriving(ray, Spectrum(inv_pi), numbers, block);
}

TwoPassEstimator::Walked TwoPassEstimator::irradiance(const Receiver& at, core::RandomNumbers& numbers,
                                                      std::uint32_t block) const {
  numbers.jump(block);
  const double u = numbers.next(), v = numbers.next();
  const Vec3 way = frame_around(at.normal).to_world(cosine_hemisphere(u, v));
  return arriving({at.position, way, at.normal}, Spectrum(1), numbers, block + blocks_per_vertex);
}

/// On by whatever is in the way, and by `gathers` diffuse surfaces, to the next one.
TwoPassEstimator::Walked TwoPassEstimator::arriving(raycast::Ray ray, Spectrum throughput, core::RandomNumbers& numbers,
                                                    std::uint32_t block) const {
  Walked walked;
  Spectrum left(1);  // of what it set out with
  double squeezed = 1;
  for (int gathers = gathers_;; block += blocks_per_vertex) {
    const auto hit = caster_.closest(ray);
    const Bsdf* bsdf = hit ? optics_.bsdf(hit->surface) : nullptr;
    if (bsdf == nullptr) return walked;
    if (is_diffuse(*bsdf)) {
      const Asked here{*hit, throughput * left};
      (gathers == 0 ? walked.reflected : walked.mirrored) = here;
      if (gathers-- == 0) return walked;
    }
    const Vec3 front = front_normal(*hit);
    const Frame frame = frame_around(front);
    numbers.jump(block);
    const double u = numbers.next(), v = numbers.next(), lobe = numbers.next(), survival = numbers.next();
    const auto on = bsdf->sample(frame.to_local(-ray.direction), {lobe, u, v}, Walk::from_eye);
    if (!on) return walked;
    left *= on->weight;
    squeezed *= on->squeezed;
    const double survives = going_on(left.max() / squeezed);
    if (!(survival < survives)) return walked;
    left /= survives;
    ray = {hit->position, frame.to_world(on->way), on->way.z() >= 0 ? front : Vec3(-front)};
  }
}

Answered answered(const measure::SurfaceSolution& solution, const TwoPassEstimator::Walked& walked) {
  Answered all;
  if (walked.reflected) {
    const auto& [at, weight] = *walked.reflected;
    const auto& known = solution.at(at);
    all = {weight * known.reflected, weight * known.error_bound, weight * known.own_noise, weight * known.shared_noise,
           known.cell};
  }
  if (walked.mirrored) {
    const auto& known = solution.at(walked.mirrored->at);
    all.value += walked.mirrored->weight * known.mirrored;
    all.bound += walked.mirrored->weight * known.mirrored_error;
  }
  return all;
}

}  // namespace interflect::montecarlo
