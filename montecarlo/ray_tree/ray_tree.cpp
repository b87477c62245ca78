#include "montecarlo/ray_tree/ray_tree.h"

#include "montecarlo/path_letters.h"

namespace interflect::montecarlo {

bool RayTree::counts(Letters letters, std::optional<std::uint32_t> light) const {
  return measure::PathClasses::complete(after(letters, light ? letter_of(lights_[*light]) : measure::PathLetter::area));
}

RayTree::Met RayTree::met(const raycast::Ray& ray) const {
  Met found;
  const Vec3 back = -ray.direction;
  const auto [hit, ball] = sight_.met(ray);
  if (ball) {
    const std::uint32_t light = lights_.of_ball(ball->ball);
    found.shining.push_back({light, lights_[light].radiance(ball->position, back), ball->position});
    return found;
  }
  if (!hit) {
    for (std::uint32_t l = lights_.first_infinite(); l < lights_.size(); ++l)
      found.shining.push_back({l, lights_[l].radiance(Vec3::Zero(), back), Vec3::Zero()});
    return found;
  }
  if (const Spectrum& exitance = optics_.exitance(*hit); !exitance.is_zero()) {
    const auto light = lights_.of_facet(hit->facet);
    found.shining.push_back(
        {light, light ? lights_[*light].radiance(hit->position, back) : exitance * inv_pi, hit->position});
  }
  if (const Bsdf* bsdf = optics_.bsdf(hit->surface)) {
    const Frame frame = frame_around(front_normal(*hit));
    found.at = TreeVertex{hit->position, frame, frame.to_local(back), bsdf};
  }
  return found;
}

std::optional<RayTree::Lit> RayTree::lit(const TreeVertex& at, std::uint32_t light, double u, double v) const {
  const auto arriving = lights_[light].sample_arriving(at.place(), u, v);
  if (!arriving) return std::nullopt;
  const Vec3 way = at.frame.to_local(arriving->way);
  const Spectrum f = at.bsdf->f(way, at.to_eye);
  if (f.is_zero()) return std::nullopt;
  const Vec3 end = lights_[light].is_infinite() ? lights_.beyond(at.position, arriving->way) : arriving->position;
  const Spectrum passes = sight_.let_pass({at.position, end, at.side(way), arriving->normal}, light);
  if (passes.is_zero()) return std::nullopt;
  return Lit{passes * f * arriving->light * std::abs(way.z()), arriving->pdf_solid_angle,
             at.bsdf->pdf_solid_angle(at.to_eye, way)};
}

}  // namespace interflect::montecarlo
