#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "montecarlo/alias_table.h"
#include "montecarlo/light/balls.h"
#include "montecarlo/light/light.h"
#include "montecarlo/light/light_tree.h"
#include "scene/scene.h"

namespace interflect::montecarlo {

/// Everything in a scene that shines: each facet whose front emits (the two of a rectangle as one), and scene::Lights.
///
/// One is picked for a place.  Lights from afar and all the others together have the same probability each; among the
/// others it is
///
///   Phi_i / sum Phi      by power, in the largest channel, or
///   LightTree            where there are more than `few`: of the four panels of an office it takes two fifths of the
///                        variance
class LightSet {
 public:
  enum class Picking : std::uint8_t { by_number, by_power, by_tree };
  static constexpr std::size_t few = 1;

  /// The scene must outlive it.
  explicit LightSet(const scene::Scene& scene, Picking picking = Picking::by_number);

  bool empty() const { return lights_.empty(); }
  std::uint32_t size() const { return static_cast<std::uint32_t>(lights_.size()); }
  const Light& operator[](std::uint32_t light) const { return *lights_[light]; }
  /// Those from afar are the last.
  std::uint32_t first_infinite() const { return nearby_; }

  struct Picked {
    std::uint32_t light;
    double probability;
  };
  /// @param u  uniform in [0, 1); not for a scene without lights
  Picked pick(const Place& at, double u) const;
  /// What `pick` returns with this light, bit by bit.
  double probability(std::uint32_t light, const Place& at) const;

  /// The light that a facet's front belongs to.
  std::optional<std::uint32_t> of_facet(std::uint32_t facet) const {
    return of_facet_[facet] == none ? std::nullopt : std::optional(of_facet_[facet]);
  }
  const Balls& balls() const { return balls_; }
  std::uint32_t of_ball(std::uint32_t ball) const { return first_ball_ + ball; }
  /// Balls::none for what is no ball.
  std::uint32_t ball_of(std::uint32_t light) const {
    return light >= first_ball_ && light < nearby_ ? light - first_ball_ : Balls::none;
  }
  /// A point beyond the scene, seen from x along the way.
  Vec3 beyond(const Vec3& x, const Vec3& way) const { return x + ((x - centre_).norm() + 2 * radius_) * way; }

  Spectrum flux() const;  ///< of all [W | lm]
  double section() const { return pi * radius_ * radius_; }  ///< of the disk that covers the scene [m²]
  /// An irradiance that one sample can find at most by one technique, except beside points of light: of those it is what
  /// they give at a tenth of the scene's radius, over the probability of their pick by power.
  const Spectrum& largest_find() const { return largest_; }
  /// pi L of the brightest that a ray can meet: an irradiance that one sample can find by a ray alone.
  const Spectrum& brightest() const { return brightest_; }

 private:
  static constexpr std::uint32_t none = ~0u;
  void add_surfaces(const scene::Scene& scene);
  void add_facet_lights(const scene::Scene& scene, scene::SurfaceId id, const Spectrum& exitance);
  void set_largest();

  std::vector<std::unique_ptr<Light>> lights_;
  std::vector<std::uint32_t> of_facet_;
  std::uint32_t nearby_ = 0, first_ball_ = 0;
  bool any_nearby_ = false;    ///< that shines
  std::vector<double> share_;  ///< of the power of those nearby
  AliasTable by_power_;
  LightTree tree_;
  double of_group_ = 1;  ///< probability of each light from afar, and of all others together
  Balls balls_;
  Vec3 centre_ = Vec3::Zero();
  double radius_ = 0;
  Spectrum largest_, brightest_;
};

}  // namespace interflect::montecarlo
