#pragma once

#include <span>

#include "core/random.h"
#include "measure/path_classes.h"
#include "montecarlo/bsdf/lambert.h"
#include "montecarlo/next_event.h"
#include "montecarlo/path_letters.h"
#include "montecarlo/rare_light.h"
#include "montecarlo/receiver.h"
#include "montecarlo/sight.h"

namespace interflect::montecarlo {

/// One path from where light arrives, one unbiased estimate: the rendering equation [Kajiya 1986]
///
///   L(x -> o) = L_e(x -> o) + int f(i -> o) L(y -> x) |cos_i| d sigma_i,     y what is seen from x along i,
///
/// by recursion on y, whose direction the Bsdf of x draws.  Light that shines from y, or from afar where the ray
/// escapes, is found by two techniques: that ray, and a way drawn to a light that is picked for x (LightSet).  Under the
/// balance heuristic [Veach and Guibas 1995, eq. 11] both score
///
///   f |cos_x| L(y) / (p_bsdf + p_light)  [1/sr],   p_light = p_pick pdf_solid_angle(y from x),
///
/// since f / (p_1 + p_2) does not know which of the two drew y: no singularity where walls and lights meet.  What is
/// delta at x finds light by the ray alone; a light that is delta, of irradiance H, is found by its pick alone, which
/// scores f |cos_x| H / p_pick.  Balls of light (scene::SphereLight) end rays as surfaces do.  Through panes and masks
/// light goes straight on: shadow rays are weakened there, a ray passes without a new direction, and both weigh as if
/// nothing were there (any weights that add up to 1 are right).
///
/// A path goes on with probability q = min(0.999, max_c T_c), T the product of f |cos| / (p q) so far, but for what
/// radiance gains or loses as the square of the index does: never cut by length.
/// Irradiance is what a receiver that reflects everything diffusely would send, times pi.
class PathEstimator {
 public:
  /// Scene and caster must outlive it.
  /// @param paths       those that count
  /// @param next_event  without it light is found by the ray alone, with the weight 1
  PathEstimator(const scene::Scene& scene, const raycast::RayCaster& caster,
                const measure::PathClasses& paths = measure::PathClasses::all(), NextEvent next_event = NextEvent::yes);

  /// Irradiance H at a place [W/m² | lx].  Uses the dimensions of `numbers` from `block` on, four blocks a vertex.
  Spectrum irradiance(const Receiver& at, core::RandomNumbers& numbers, std::uint32_t block) const;

  /// Radiance L that comes to a point in free space along -direction.
  Spectrum radiance(const Vec3& eye, const Vec3& direction, core::RandomNumbers& numbers, std::uint32_t block) const;

  /// The same of many paths that are traced together, several times sooner: path k by keys.numbers(k), bit by bit.
  struct Keys {
    std::uint64_t seed;
    std::uint32_t stream;
    std::uint64_t first;
    std::span<const double> given = {};  ///< sample by sample the first numbers of each, those of a sequence
    std::size_t given_each = 0;          ///< an even number

    std::span<const double> given_to(std::size_t k) const { return given.subspan(k * given_each, given_each); }
    core::RandomNumbers numbers(std::size_t k) const { return {seed, stream, first + k, given_to(k)}; }
  };
  void irradiance(std::span<const Receiver> at, const Keys& keys, std::uint32_t block, std::span<Spectrum> found) const;
  /// @param from_eye  none: a path that finds nothing
  void radiance(std::span<const std::optional<raycast::Ray>> from_eye, const Keys& keys, std::uint32_t block,
                std::span<Spectrum> found) const;

  const scene::Scene& scene() const { return scene_; }
  const LightSet& lights() const { return lights_; }
  const measure::PathClasses& classes() const { return paths_; }  ///< that count

  /// What one vertex of a path can add to an irradiance at most: where all is diffuse by the two techniques together
  /// (beside points of light there is no such bound: LightSet::largest_find), and by a ray alone all of a light's
  /// radiance.  What is met behind a mirror may be more: of that RareLights knows.
  const Spectrum& largest_score() const { return largest_score_; }
  RareLights rare_lights() const { return {scene_, lights_, paths_, next_event_ ? NextEvent::yes : NextEvent::no}; }

 private:
  friend class ControlledPaths;  ///< the same steps, and a solution where paths end
  /// Where a path scatters.
  struct Vertex {
    Vec3 position;
    Frame frame;  ///< about the normal of the front
    Vec3 to_eye;  ///< in the frame
    const Bsdf* bsdf;
    bool receives = false;  ///< what is measured: it has no letter
  };
  /// A ray, and where its direction was drawn.
  struct Drawn {
    raycast::Ray ray;
    Place from;              ///< the last that was not passed straight
    double pdf_solid_angle;  ///< 0: delta, or of the eye
  };
  /// What a path has found, and what further finds are worth.
  struct Carried {
    Spectrum found{}, throughput{1};
    double squeezed = 1;  ///< of the throughput
    measure::PathClasses::FromEye letters;
  };
  Carried from_eye() const;
  /// Point on the light 2, direction 2, light 1, survival 1, lobe 1, and one that is left.
  static constexpr std::uint32_t blocks_per_vertex = 4;
  /// What one vertex does with its numbers: those that belong together first, as pairs, since sequences are the more
  /// even the fewer dimensions they are looked at in.
  struct Numbers {
    double on_u, on_v, u, v, pick, survival, lobe;
  };
  /// Light that is found at a vertex if nothing is in between.
  struct Candidate {
    Spectrum light;
    raycast::Segment segment;
    std::uint32_t of;
  };
  template <class Company>
  class Wave;
  bool ends_at(const Carried& path, measure::PathLetter light) const {
    return all_paths_ || measure::PathClasses::complete(paths_.after(path.letters, light));
  }
  measure::PathClasses::FromEye with_letter(const Carried& path, const Vertex& at) const {
    return all_paths_ || at.receives ? path.letters : paths_.after(path.letters, letter_of(*at.bsdf));
  }

  void follow(Vertex at, Carried& path, core::RandomNumbers& numbers, std::uint32_t block) const;
  Vertex receiving(const Receiver& at) const {
    return {at.position, frame_around(at.normal), Vec3::UnitZ(), &receiver_, true};
  }
  static Place place_of(const Vertex& at);
  std::optional<Candidate> from_lights(const Vertex& at, const Carried& path, const Place& place, double pick, double u,
                                       double v) const;
  /// @param for_sure  the roulette was played before
  bool goes_on(const Vertex& at, const Place& place, const Numbers& numbers, Carried& path, Drawn& drawn,
               bool for_sure = false) const;
  bool arrive(const Drawn& drawn, const std::optional<scene::SurfacePoint>& hit, Carried& path, Vertex& at) const;
  Spectrum emitted(const Drawn& drawn, const Carried& path, const scene::SurfacePoint& hit) const;
  Spectrum escaped(const Drawn& drawn, const Carried& path) const;
  Spectrum shines(std::uint32_t light, const Drawn& drawn, const Vec3& from) const;

  const scene::Scene& scene_;
  measure::PathClasses paths_;
  bool all_paths_, next_event_;
  LightSet lights_;
  SurfaceOptics optics_;
  Sight sight_;
  Lambert receiver_{Spectrum(1)};
  Spectrum largest_score_;
};

}  // namespace interflect::montecarlo
