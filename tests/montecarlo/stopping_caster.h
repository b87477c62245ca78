#pragma once

#include <atomic>
#include <stop_token>

#include "raycast/ray_caster.h"

namespace interflect::test {

/// Sees what "brute" sees, and asks a run to stop at a certain ray: a run is stopped by how far it has come, never by a
/// clock, and on one thread always at the same place.
class StoppingCaster final : public raycast::RayCaster {
 public:
  StoppingCaster(const scene::Scene& scene, std::stop_source stop, std::uint64_t at_ray)
      : seen_(raycast::make_ray_caster("brute", scene)), stop_(std::move(stop)), left_(at_ray) {}

  std::string name() const override { return seen_->name(); }
  std::optional<scene::SurfacePoint> closest(const raycast::Ray& ray) const override {
    count(1);
    return seen_->closest(ray);
  }
  bool occluded(const raycast::Segment& segment) const override {
    count(1);
    return seen_->occluded(segment);
  }
  void occluded(std::span<const raycast::Segment> segments, std::span<std::uint8_t> blocked) const override {
    count(segments.size());
    seen_->occluded(segments, blocked);
  }
  double offset() const override { return seen_->offset(); }

 private:
  void count(std::uint64_t rays) const {
    const std::uint64_t left = left_.fetch_sub(rays);
    if (left <= rays && left > 0) stop_.request_stop();
  }

  std::unique_ptr<raycast::RayCaster> seen_;
  mutable std::stop_source stop_;
  mutable std::atomic<std::uint64_t> left_;
};

}  // namespace interflect::test
