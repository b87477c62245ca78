#pragma once

#include <optional>

#include "measure/path_classes.h"
#include "montecarlo/sight.h"
#include "montecarlo/warp.h"

namespace interflect::montecarlo {

/// Where a ray of a tree has come to.
struct TreeVertex {
  Vec3 position;
  Frame frame;  ///< about the normal of the front
  Vec3 to_eye;  ///< in the frame
  const Bsdf* bsdf;

  Vec3 side(const Vec3& local) const { return local.z() >= 0 ? frame.n : Vec3(-frame.n); }
  Place place() const { return {position, bsdf->transmits() ? Vec3(Vec3::Zero()) : side(to_eye)}; }
  raycast::Ray ray(const Vec3& local) const { return {position, frame.to_world(local), side(local)}; }
};

/// What trees of rays need of a scene: rays from the eye that go on at mirrors and smooth boundaries in all ways there
/// are, where a path takes one of them.
class RayTree {
 public:
  /// @param paths  that count.  All must outlive it
  RayTree(const scene::Scene& scene, const raycast::RayCaster& caster, const measure::PathClasses& paths)
      : scene_(scene), paths_(paths), lights_(scene), optics_(scene), sight_(caster, lights_, optics_) {}

  const scene::Scene& scene() const { return scene_; }
  const LightSet& lights() const { return lights_; }

  /// What a ray has met, from the eye on.
  using Letters = measure::PathClasses::FromEye;
  Letters at_eye() const { return after(paths_.before_eye(), measure::PathLetter::eye); }
  Letters after(Letters letters, measure::PathLetter letter) const { return paths_.after(letters, letter); }
  /// Whether paths count that end so at that light; without one, at a surface that shines and is none.
  bool counts(Letters letters, std::optional<std::uint32_t> light) const;

  /// What shines towards a ray's origin from where it ends, and where it may go on.
  struct Met {
    /// By which light, where it is one: to weigh what finds it against a pick.
    struct Shining {
      std::optional<std::uint32_t> light;
      Spectrum radiance;
      Vec3 position;  ///< of no meaning from afar
    };
    std::vector<Shining> shining;
    std::optional<TreeVertex> at;
  };
  Met met(const raycast::Ray& ray) const;

  /// Light of a draw (u, v) of a light that is scattered straight to the eye, times its density over solid angle where
  /// that is not delta: f L |cos| and what passes between; and the densities of the draw and of the material's own.
  struct Lit {
    Spectrum scattered;
    double by_light = 0;  ///< 0: delta
    double by_bsdf = 0;
  };
  std::optional<Lit> lit(const TreeVertex& at, std::uint32_t light, double u, double v) const;

 private:
  const scene::Scene& scene_;
  const measure::PathClasses& paths_;
  LightSet lights_;
  SurfaceOptics optics_;
  Sight sight_;
};

}  // namespace interflect::montecarlo
