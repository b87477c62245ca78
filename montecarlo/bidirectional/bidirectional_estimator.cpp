#include "montecarlo/bidirectional/bidirectional_estimator.h"

#include <cmath>
#include <utility>

#include "montecarlo/roulette.h"

namespace interflect::montecarlo {
namespace {

/// Of a walk from the eye: direction 2, light 1, point on it 2, survival 1, lobe 1, and one that is left.
constexpr std::uint32_t blocks_per_eye_vertex = 4;
/// Of the walk from the light; no other comes that far.
constexpr std::uint32_t light_block = 1u << 29, first_light_vertex = light_block + 3, blocks_per_light_vertex = 2;

}  // namespace

BidirectionalEstimator::BidirectionalEstimator(const scene::Scene& scene, const raycast::RayCaster& caster,
                                               const measure::PathClasses& paths,
                                               std::optional<BidirectionalStrategy> only)
    : scene_(scene),
      paths_(paths),
      lights_(scene),
      optics_(scene),
      sight_(caster, lights_, optics_),
      emissions_(lights_),
      only_(only) {}

double BidirectionalEstimator::pdf_picked(std::uint32_t light, const Place& at, const Vec3& position,
                                          const Vec3& normal, const Vec3& way) const {
  const double pick = lights_.probability(light, at);
  if (lights_[light].is_delta()) return pick;
  const double pdf = pick * lights_[light].pdf_arriving_solid_angle(at, way, position);
  return lights_[light].is_infinite() ? pdf : pdf * std::abs(normal.dot(way)) / (position - at.position).squaredNorm();
}

BidirectionalEstimator::Emitted BidirectionalEstimator::emission(std::uint32_t light, const Vec3& position,
                                                                 const Vec3& way) const {
  const EmissionPdfs pdfs = lights_[light].pdfs_emission(position, way);
  const double pick = emissions_.probability(light);
  return lights_[light].is_infinite() ? Emitted{pick * pdfs.solid_angle, pdfs.area}
                                      : Emitted{pick * pdfs.area, pdfs.solid_angle};
}

/// By emission, per area of a surface that light arrives on.
double BidirectionalEstimator::pdf_arriving(std::uint32_t light, double pdf_way, const Vec3& from, const Vec3& to,
                                            double cosine) const {
  return lights_[light].is_infinite() ? pdf_way * cosine : pdf_way * cosine / (to - from).squaredNorm();
}

void BidirectionalEstimator::walk_from_light(core::RandomNumbers& numbers, LightWalk& walk) const {
  walk.vertices.clear();
  Sent going = set_out(numbers, walk.start);
  if (going.flux.is_zero()) return;  // and not where it is no number
  for (std::uint32_t block = first_light_vertex;; block += blocks_per_light_vertex) {
    const std::optional<LightVertex> x = arrive(walk.start, going);
    if (!x) return;
    walk.vertices.push_back(*x);
    if (x->bsdf == nullptr) return;
    numbers.jump(block);
    const double lobe = numbers.next(), u = numbers.next(), v = numbers.next(), survival = numbers.next();
    const std::optional<Scattered> on = x->bsdf->sample(x->back, {lobe, u, v}, Walk::from_light);
    if (!on || !goes_on(*x, *on, survival, going)) return;
  }
}

/// From a light that is picked.
BidirectionalEstimator::Sent BidirectionalEstimator::set_out(core::RandomNumbers& numbers, LightStart& start) const {
  numbers.jump(light_block);
  const auto [light, pick] = emissions_.pick(numbers.next());
  std::array<double, 4> u;
  for (double& each : u) each = numbers.next();
  const Light& of = lights_[light];
  const Emission emission = of.sample_emission(u);
  const bool afar = of.is_infinite();
  start = {light,
           emission.position,
           emission.normal,
           emission.way,
           pick * (afar ? emission.pdf_solid_angle : emission.pdf_area),
           afar ? emission.pdf_area : emission.pdf_solid_angle};
  Sent going;
  going.ray = {emission.position, emission.way, afar ? Vec3(Vec3::Zero()) : emission.normal};
  going.leaves = light;
  going.flux = emission.weight / pick;
  going.at_first = going.flux.max();
  going.letters = paths_.after(paths_.before_light(), letter_of(of));
  return going;
}

/// @return  nothing where it meets no surface, or one that it lies within
std::optional<LightVertex> BidirectionalEstimator::arrive(const LightStart& start, Sent& going) const {
  const auto hit = sight_.met(going.ray, std::exchange(going.leaves, std::nullopt)).surface;
  if (!hit) return std::nullopt;
  LightVertex x;
  x.hit = *hit;
  x.position = hit->position;
  x.frame = frame_around(front_normal(*hit));
  x.back = x.to_local(-going.ray.direction);
  x.bsdf = optics_.bsdf(hit->surface);
  x.letters = going.letters;
  x.vertices = going.vertices;
  const double cosine = std::abs(x.back.z());
  if (cosine == 0) return std::nullopt;  // G = 0
  const std::optional<Departure>& departure = going.departure;
  x.pdf_area = departure ? departure->pdf_area(x.position, cosine)
                         : pdf_arriving(start.light, start.pdf_way, start.position, x.position, cosine);
  x.carried = going.flux = carried_to(going.flux, x.pdf_area);
  x.weights = departure ? departure->arrived(x.position, x.pdf_area) : first_weights(start, x, x.place());
  return x;
}

bool BidirectionalEstimator::goes_on(const LightVertex& x, const Scattered& on, double survival, Sent& going) const {
  going.flux *= on.weight;
  const double survives = going_on(going.flux.max() / going.at_first);
  if (!(survival < survives)) return false;
  going.flux /= survives;
  going.ray = {x.position, x.frame.to_world(on.way), x.side(on.way)};
  if (on.straight) return true;
  going.departure = departure_of(x, on);
  going.letters = paths_.after(going.letters, letter_of(*x.bsdf, on));
  going.vertices = x.vertices + 1;
  return true;
}

/// a_1 and b_1: c is what picks for that place draw x_0 with over emission; a light that is delta is met by no walk.
PartialWeights BidirectionalEstimator::first_weights(const LightStart& start, const LightVertex& x,
                                                     const Place& place) const {
  const Light& light = lights_[start.light];
  const Vec3 way = light.is_infinite() ? Vec3(-start.way) : Vec3((start.position - x.position).normalized());
  const double picked = pdf_picked(start.light, place, start.position, start.normal, way);
  const double g =
      light.is_infinite() ? 1 : std::abs(start.normal.dot(way)) / (start.position - x.position).squaredNorm();
  const double both = start.pdf * x.pdf_area;
  return {picked / both, light.is_delta() ? 0 : g / both};
}

Departure BidirectionalEstimator::departure_of(const WalkVertex& x, const Scattered& on) {
  const double cosine = std::abs(on.way.z());
  if (on.delta) return Departure::mirrored(x.position, x.weights, cosine);
  return Departure::scattered(x.position, x.weights, on.pdf_solid_angle, cosine,
                              x.bsdf->pdf_solid_angle(on.way, x.back));
}

Spectrum BidirectionalEstimator::irradiance(const Receiver& at, double pdf_area, const LightWalk& light,
                                            core::RandomNumbers& numbers, std::uint32_t block) const {
  EyeVertex z;
  z.position = at.position;
  z.frame = frame_around(at.normal);
  z.back = Vec3::UnitZ();
  z.bsdf = &receiver_;
  z.carried = Spectrum(1);
  z.weights = {pdf_area > 0 ? 1 / pdf_area : 0, 0};
  z.letters = paths_.after(paths_.before_eye(), measure::PathLetter::eye);
  z.receives = true;
  Spectrum found{};
  follow(z, {}, light, numbers, block, found);
  return found * pi;
}

Spectrum BidirectionalEstimator::arrival(const LightWalk& light, std::size_t vertex, double pdf_area) const {
  const LightVertex& x = light.vertices[vertex];
  if (!counts(x.vertices, 0)) return Spectrum::zero();
  if (!PathClasses::joined(paths_.after(x.letters, measure::PathLetter::eye), paths_.before_eye()))
    return Spectrum::zero();
  // What is measured may pick its lights otherwise than the surface that it lies on.
  const PartialWeights weights =
      x.vertices == 2 ? first_weights(light.start, x, {x.position, x.side(x.back)}) : x.weights;
  return x.carried *
         weight(pdf_area * (weights.a + cosine_hemisphere_pdf_solid_angle(std::abs(x.back.z())) * weights.b));
}

Spectrum BidirectionalEstimator::radiance(const Camera& camera, const scene::CameraRay& ray, const LightWalk& light,
                                          core::RandomNumbers& numbers, std::uint32_t block) const {
  Going going;
  going.ray = {ray.origin, ray.direction};
  going.camera = &camera;
  going.letters = paths_.after(paths_.before_eye(), measure::PathLetter::eye);
  Spectrum found{};
  if (const auto at = arrive(going, found)) follow(*at, going, light, numbers, block, found);
  return found;
}

void BidirectionalEstimator::splat(const Camera& camera, const LightWalk& light, std::vector<Splat>& splats) const {
  const PathClasses::FromEye eye = paths_.after(paths_.before_eye(), measure::PathLetter::eye);
  for (const LightVertex& y : light.vertices) {
    if (!joins(y) || !counts(y.vertices, 1)) continue;
    if (!PathClasses::joined(paths_.after(y.letters, letter_of(*y.bsdf)), eye)) continue;
    const auto image = camera.film.image_of(y.position, camera.lens);
    if (!image) continue;
    const Vec3 to = y.to_local(-image->ray.direction);
    const Spectrum f = y.bsdf->f(y.back, to);
    if (f.is_zero()) continue;
    const Spectrum passes = sight_.let_pass({y.position, image->ray.origin, y.side(to)});
    if (passes.is_zero()) continue;
    const double pdf_area = image->pdf_area * std::abs(to.z());
    const double others = y.weights.of_others(pdf_area, y.bsdf->pdf_solid_angle(to, y.back)) / camera.light_walks;
    splats.push_back({image->film, y.carried * f * passes * (pdf_area * weight(others))});
  }
}

void BidirectionalEstimator::follow(EyeVertex at, Going going, const LightWalk& light, core::RandomNumbers& numbers,
                                    std::uint32_t block, Spectrum& found) const {
  for (;; block += blocks_per_eye_vertex) {
    numbers.jump(block);
    const double u = numbers.next(), v = numbers.next(), pick = numbers.next(), on_u = numbers.next(),
                 on_v = numbers.next(), survival = numbers.next(), lobe = numbers.next();
    if (joins(at)) {
      found += from_lights(at, pick, on_u, on_v);
      for (const LightVertex& y : light.vertices)
        if (joins(y)) found += joined(y, at);
    }
    const std::optional<Scattered> on = at.bsdf->sample(at.back, {lobe, u, v}, Walk::from_eye);
    if (!on || !goes_on(at, *on, survival, going)) return;
    const std::optional<EyeVertex> next = arrive(going, found);
    if (!next) return;
    at = *next;
  }
}

bool BidirectionalEstimator::goes_on(const EyeVertex& at, const Scattered& on, double survival, Going& going) const {
  going.carried = at.carried * on.weight;
  going.squeezed *= on.squeezed;
  const double survives = going_on(going.carried.max() / going.squeezed);
  if (!(survival < survives)) return false;
  going.carried /= survives;
  going.ray = {at.position, at.frame.to_world(on.way), at.side(on.way)};
  if (on.straight) return true;
  going.departure = departure_of(at, on);
  going.picked_for = at.place();
  going.camera = nullptr;
  going.vertices = at.vertices;
  going.letters = at.receives ? at.letters : paths_.after(at.letters, letter_of(*at.bsdf, on));
  return !PathClasses::hopeless(going.letters);
}

/// Finds what shines there.  @return  nothing where no walk goes on
std::optional<BidirectionalEstimator::EyeVertex> BidirectionalEstimator::arrive(const Going& going,
                                                                                Spectrum& found) const {
  const auto [hit, ball] = sight_.met(going.ray);
  if (ball) {
    const std::uint32_t light = lights_.of_ball(ball->ball);
    found += going.carried * emitted(going, light, ball->position, ball->normal);
    return std::nullopt;
  }
  if (!hit) {
    for (std::uint32_t l = lights_.first_infinite(); l < lights_.size(); ++l)
      found += going.carried * from_afar(going, l);
    return std::nullopt;
  }
  if (const Spectrum& exitance = optics_.exitance(*hit); !exitance.is_zero()) {
    const auto light = lights_.of_facet(hit->facet);
    found +=
        going.carried * (light ? emitted(going, *light, hit->position, hit->normal) : emitted_by_none(going, exitance));
  }
  EyeVertex z;
  z.bsdf = optics_.bsdf(hit->surface);
  if (z.bsdf == nullptr) return std::nullopt;
  z.position = hit->position;
  z.frame = frame_around(front_normal(*hit));
  z.back = z.to_local(-going.ray.direction);
  z.carried = going.carried;
  z.letters = going.letters;
  z.vertices = going.vertices + 1;
  const double cosine = std::abs(z.back.z());
  if (cosine == 0) return std::nullopt;  // G = 0
  if (going.camera != nullptr) {
    const auto image = going.camera->film.image_of(z.position, going.camera->lens);
    if (image) z.weights = {going.camera->light_walks / (image->pdf_area * cosine), 0};
    return z;
  }
  const double pdf_area = going.departure.pdf_area(z.position, cosine);
  z.carried = carried_to(z.carried, pdf_area);
  z.weights = going.departure.arrived(z.position, pdf_area);
  return z;
}

/// s = 0.
Spectrum BidirectionalEstimator::emitted(const Going& going, std::uint32_t light, const Vec3& position,
                                         const Vec3& normal) const {
  if (!counts(0, going.vertices + 1) || !found_by(going, light)) return Spectrum::zero();
  const Vec3& way = going.ray.direction;
  const Spectrum radiance = lights_[light].radiance(position, -way);
  if (radiance.is_zero() || going.camera != nullptr) return radiance;
  const double cosine = std::abs(normal.dot(way));
  if (cosine == 0) return Spectrum::zero();  // G = 0
  const double pdf_area = going.departure.pdf_area(position, cosine);
  return carried_to(radiance, pdf_area) *
         weight(of_others(going, going.departure.arrived(position, pdf_area), light, position, normal));
}

Spectrum BidirectionalEstimator::from_afar(const Going& going, std::uint32_t light) const {
  if (!counts(0, going.vertices + 1) || !found_by(going, light)) return Spectrum::zero();
  const Spectrum radiance = lights_[light].radiance(Vec3::Zero(), -going.ray.direction);
  if (radiance.is_zero() || going.camera != nullptr) return radiance;
  return radiance * weight(of_others(going, going.departure.escaped(), light, Vec3::Zero(), Vec3::Zero()));
}

double BidirectionalEstimator::of_others(const Going& going, const PartialWeights& weights, std::uint32_t light,
                                         const Vec3& position, const Vec3& normal) const {
  const Vec3& way = going.ray.direction;
  const Emitted by_emission = emission(light, position, -way);
  return pdf_picked(light, going.picked_for, position, normal, way) * weights.a +
         by_emission.pdf * by_emission.pdf_way * weights.b;
}

/// By a side that is no light of the set: no other strategy finds it.
Spectrum BidirectionalEstimator::emitted_by_none(const Going& going, const Spectrum& exitance) const {
  const bool found = PathClasses::complete(paths_.after(going.letters, measure::PathLetter::area));
  return counts(0, going.vertices + 1) && found ? exitance * inv_pi : Spectrum::zero();
}

/// s = 1.
Spectrum BidirectionalEstimator::from_lights(const EyeVertex& z, double pick, double u, double v) const {
  if (lights_.empty() || !counts(1, z.vertices)) return Spectrum::zero();
  const Place place = z.place();
  const auto [index, probability] = lights_.pick(place, pick);
  const Light& light = lights_[index];
  if (!PathClasses::complete(paths_.after(with_letter(z), letter_of(light)))) return Spectrum::zero();
  const std::optional<Arriving> x = light.sample_arriving(place, u, v);
  if (!x) return Spectrum::zero();
  const Vec3 way = z.to_local(x->way);
  const Spectrum f = z.bsdf->f(way, z.back);
  if (f.is_zero()) return f;
  const bool afar = light.is_infinite(), delta = light.is_delta();
  const double leaves = std::abs(x->normal.dot(x->way));
  if (!afar && !delta && leaves == 0) return Spectrum::zero();  // G = 0: it is seen edge-on
  const Vec3 end = afar ? lights_.beyond(z.position, x->way) : x->position;
  const Spectrum passes = sight_.let_pass({z.position, end, z.side(way), x->normal}, index);
  if (passes.is_zero()) return passes;
  const double cosine = std::abs(way.z()), drawn = delta ? probability : probability * x->pdf_solid_angle;
  const double picked = afar || delta ? drawn : drawn * leaves / (x->distance * x->distance);
  const Emitted by_emission = emission(index, x->position, -x->way);
  const double arriving = pdf_arriving(index, by_emission.pdf_way, x->position, z.position, cosine);
  const double by_eye = delta ? 0 : z.bsdf->pdf_solid_angle(z.back, way) / drawn;
  const double by_light =
      by_emission.pdf / picked * z.weights.of_others(arriving, z.bsdf->pdf_solid_angle(way, z.back));
  return z.carried * passes * f * x->light * (cosine / drawn * weight(by_eye + by_light));
}

/// s >= 2, t >= 1.
Spectrum BidirectionalEstimator::joined(const LightVertex& y, const EyeVertex& z) const {
  if (!counts(y.vertices, z.vertices)) return Spectrum::zero();
  if (!PathClasses::joined(paths_.after(y.letters, letter_of(*y.bsdf)), with_letter(z))) return Spectrum::zero();
  const Vec3 between = z.position - y.position;
  const double square = between.squaredNorm();
  if (!(square > 0)) {  // 1 / r² is no number; but places of one plane send each other nothing, however close
    const bool of_one_plane = y.frame.n.cross(z.frame.n).squaredNorm() < 1e-20;
    return of_one_plane ? Spectrum::zero() : no_number();
  }
  const Vec3 way = between / std::sqrt(square), from_y = y.to_local(way), from_z = z.to_local(-way);
  const Spectrum f_y = y.bsdf->f(y.back, from_y);
  if (f_y.is_zero()) return f_y;
  const Spectrum f_z = z.bsdf->f(from_z, z.back);
  if (f_z.is_zero()) return f_z;
  const Spectrum passes = sight_.let_pass({y.position, z.position, y.side(from_y), z.side(from_z)});
  if (passes.is_zero()) return passes;
  const double cos_y = std::abs(from_y.z()), cos_z = std::abs(from_z.z());
  const double y_by_eye = z.bsdf->pdf_solid_angle(z.back, from_z) * cos_y / square;
  const double z_by_light = y.bsdf->pdf_solid_angle(y.back, from_y) * cos_z / square;
  const double others = y.weights.of_others(y_by_eye, y.bsdf->pdf_solid_angle(from_y, y.back)) +
                        z.weights.of_others(z_by_light, z.bsdf->pdf_solid_angle(from_z, z.back));
  return y.carried * f_y * passes * f_z * z.carried * (cos_y * cos_z / square * weight(others));
}

}  // namespace interflect::montecarlo
