#include "fem/specular/light_caster.h"

#include "fem/specular/specular_chains.h"

namespace interflect::fem {
namespace {

class LightCaster final : public raycast::RayCaster {
 public:
  LightCaster(std::unique_ptr<raycast::RayCaster> straight, const scene::Scene& scene, std::uint64_t seed)
      : straight_(std::move(straight)), chains_(scene, *straight_, seed) {}

  std::string name() const override { return straight_->name(); }
  std::optional<scene::SurfacePoint> closest(const raycast::Ray& ray) const override { return chains_.follow(ray).at; }
  void closest_each(std::span<const raycast::Ray> rays,
                    std::span<std::optional<scene::SurfacePoint>> hits) const override {
    straight_->closest_each(rays, hits);
    for (std::size_t k = 0; k < rays.size(); ++k)
      if (chains_.goes_on_at(hits[k])) hits[k] = chains_.onward(rays[k], hits[k]).at;
  }
  void all(const raycast::Ray& ray, std::vector<scene::SurfacePoint>& hits) const override {
    straight_->all(ray, hits);
  }
  bool occluded(const raycast::Segment& segment) const override { return straight_->occluded(segment); }
  void occluded(std::span<const raycast::Segment> segments, std::span<std::uint8_t> blocked) const override {
    straight_->occluded(segments, blocked);
  }
  double offset() const override { return straight_->offset(); }

 private:
  std::unique_ptr<raycast::RayCaster> straight_;
  SpecularChains chains_;
};

}  // namespace

std::unique_ptr<raycast::RayCaster> make_light_caster(const std::string& intersector, const scene::Scene& scene,
                                                      std::uint64_t seed) {
  auto straight = raycast::make_ray_caster(intersector, scene);
  if (!any_smooth(scene)) return straight;
  return std::make_unique<LightCaster>(std::move(straight), scene, seed);
}

}  // namespace interflect::fem
