#pragma once

#include "core/random.h"
#include "measure/path_classes.h"
#include "montecarlo/bidirectional/bidirectional_strategy.h"
#include "montecarlo/bidirectional/walk.h"
#include "montecarlo/bsdf/lambert.h"
#include "montecarlo/light/emission_picker.h"
#include "montecarlo/path_letters.h"
#include "montecarlo/receiver.h"
#include "montecarlo/sight.h"
#include "scene/film_map.h"

namespace interflect::montecarlo {

/// Bidirectional path tracing [Lafortune, Willems 1993; Veach, Guibas 1995]: a walk from a light and one from the eye,
/// joined in all ways, each weighed by the balance heuristic (PartialWeights).  With s vertices from the light and t
/// from the eye,
///
///   s = 0            the walk from the eye meets a light                                    T_E L
///   s = 1            a light is picked for the eye's vertex z, as path tracing does it      T_E f L |cos_z| / p
///   s >= 2, t >= 1   y of the light's walk is in sight of z                        T_L f |cos_y cos_z| / r² f T_E
///   t = 1            z is the receiver, or the camera, that y shines into                   T_L f |cos_y| p_pixel / r²
///   t = 0            the walk from the light arrives on a patch that is measured            T_L / A
///
/// T_L: flux, T_E: what radiance counts, both over the densities so far.  f(from -> to) at y and z alike: from the
/// light's side to the eye's.  Nothing is joined at mirrors.  What a pixel sees directly is found by s = 0 alone.
/// Unbiased: walks end by Russian roulette, never by length.
class BidirectionalEstimator {
 public:
  /// Scene and caster must outlive it.
  /// @param only  one strategy alone, with the weight 1, to be looked at
  BidirectionalEstimator(const scene::Scene& scene, const raycast::RayCaster& caster,
                         const measure::PathClasses& paths = measure::PathClasses::all(),
                         std::optional<BidirectionalStrategy> only = {});

  const scene::Scene& scene() const { return scene_; }
  const LightSet& lights() const { return lights_; }
  bool dark() const { return emissions_.empty(); }
  /// As PathEstimator's: weights are at most 1.
  bool is_one_alone() const { return only_.has_value(); }
  Spectrum largest_score() const { return 2 * lights_.largest_find(); }

  /// Dimensions of `numbers` from blocks of its own on, that no walk from the eye comes to.
  void walk_from_light(core::RandomNumbers& numbers, LightWalk& walk) const;

  /// Irradiance at a place by the walk and one that starts there, t >= 1 [W/m² | lx].
  /// @param pdf_area  with which the place was drawn where walks from lights may arrive at it: then t = 0 is another
  ///                  strategy, to be added (arrival); 0: they cannot
  Spectrum irradiance(const Receiver& at, double pdf_area, const LightWalk& light, core::RandomNumbers& numbers,
                      std::uint32_t block) const;
  /// t = 0: flux that arrives with the walk's vertex, on a side that is measured, weighed [W | lm].
  Spectrum arrival(const LightWalk& light, std::size_t vertex, double pdf_area) const;

  /// How a camera sees: the lens point of a sample, and how many walks from lights there are for each walk from a pixel.
  struct Camera {
    const scene::FilmMap& film;
    Vec2 lens;
    double light_walks;
  };
  /// Radiance along a ray of the camera, t >= 2 [W/(m² sr)].
  Spectrum radiance(const Camera& camera, const scene::CameraRay& ray, const LightWalk& light,
                    core::RandomNumbers& numbers, std::uint32_t block) const;
  /// t = 1: what the light's walk leaves on the film, a value for the pixel that has the point and whose filter is 1
  /// there: over the camera's `light_walks` it is what the pixel gains.
  struct Splat {
    Vec2 film;
    Spectrum value;
  };
  void splat(const Camera& camera, const LightWalk& light, std::vector<Splat>& splats) const;

 private:
  using PathClasses = measure::PathClasses;
  struct EyeVertex : WalkVertex {
    PathClasses::FromEye letters;  ///< of the walk so far, without what is done here
    bool receives = false;         ///< the eye's own end: no letter
  };
  /// A walk from a light on its way.
  struct Sent {
    raycast::Ray ray{};
    std::optional<std::uint32_t> leaves;  ///< the light that it has just left
    std::optional<Departure> departure;   ///< none: straight from the light
    Spectrum flux;
    double at_first = 0;  ///< of the flux
    PathClasses::FromLight letters = 0;
    int vertices = 2;
  };
  /// A walk from the eye on its way.
  struct Going {
    raycast::Ray ray{};
    Departure departure{};
    Place picked_for{};              ///< where lights would be picked
    const Camera* camera = nullptr;  ///< it comes straight from there
    Spectrum carried{1};
    double squeezed = 1;
    PathClasses::FromEye letters = 0;
    int vertices = 1;
  };

  Sent set_out(core::RandomNumbers& numbers, LightStart& start) const;
  std::optional<LightVertex> arrive(const LightStart& start, Sent& going) const;
  bool goes_on(const LightVertex& x, const Scattered& on, double survival, Sent& going) const;

  void follow(EyeVertex at, Going going, const LightWalk& light, core::RandomNumbers& numbers, std::uint32_t block,
              Spectrum& found) const;
  std::optional<EyeVertex> arrive(const Going& going, Spectrum& found) const;
  bool goes_on(const EyeVertex& at, const Scattered& on, double survival, Going& going) const;
  static Departure departure_of(const WalkVertex& x, const Scattered& on);
  PartialWeights first_weights(const LightStart& start, const LightVertex& x, const Place& place) const;

  Spectrum emitted(const Going& going, std::uint32_t light, const Vec3& position, const Vec3& normal) const;
  Spectrum from_afar(const Going& going, std::uint32_t light) const;
  Spectrum emitted_by_none(const Going& going, const Spectrum& exitance) const;
  double of_others(const Going& going, const PartialWeights& weights, std::uint32_t light, const Vec3& position,
                   const Vec3& normal) const;
  Spectrum from_lights(const EyeVertex& z, double pick, double u, double v) const;
  Spectrum joined(const LightVertex& y, const EyeVertex& z) const;

  static bool joins(const WalkVertex& x) { return x.bsdf != nullptr && !x.bsdf->only_delta(); }
  PathClasses::FromEye with_letter(const EyeVertex& z) const {
    return z.receives ? z.letters : paths_.after(z.letters, letter_of(*z.bsdf));
  }
  bool found_by(const Going& going, std::uint32_t light) const {
    return PathClasses::complete(paths_.after(going.letters, letter_of(lights_[light])));
  }
  /// Of x_0 by a pick for that place [1/m²; 1/sr from afar; 1 of a point].
  double pdf_picked(std::uint32_t light, const Place& at, const Vec3& position, const Vec3& normal,
                    const Vec3& way) const;
  /// As LightStart has them.
  struct Emitted {
    double pdf, pdf_way;
  };
  Emitted emission(std::uint32_t light, const Vec3& position, const Vec3& way) const;
  double pdf_arriving(std::uint32_t light, double pdf_way, const Vec3& from, const Vec3& to, double cosine) const;
  bool counts(int s, int t) const { return !only_ || (only_->from_light == s && only_->from_eye == t); }
  double weight(double others) const { return only_ ? 1 : 1 / (1 + others); }

  const scene::Scene& scene_;
  measure::PathClasses paths_;
  LightSet lights_;
  SurfaceOptics optics_;
  Sight sight_;
  EmissionPicker emissions_;
  Lambert receiver_{Spectrum(1)};
  std::optional<BidirectionalStrategy> only_;
};

}  // namespace interflect::montecarlo
