#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "measure/measurement.h"
#include "montecarlo/film/reconstruction_filter.h"
#include "montecarlo/path_estimator.h"
#include "montecarlo/receiver_sampler.h"
#include "scene/film_map.h"

namespace interflect::montecarlo {

struct PixelOnFilm {
  int x, y;
};

/// One sample of a pixel's value: what comes to a point of the film, drawn by the filter (of a box uniform on the
/// pixel), by way of a point uniform on the lens, where there is one.
Spectrum film_sample(const scene::FilmMap& film, const ReconstructionFilter& filter, const PixelOnFilm& pixel,
                     const PathEstimator& paths, core::RandomNumbers& numbers);

/// Radiances that come along many rays, with the paths' numbers from `block` on.
using Radiances = std::function<void(std::span<const std::optional<raycast::Ray>> from_eye, std::uint32_t block,
                                     std::span<Spectrum> found)>;
/// The same of samples one after the other, whose radiances are found together.
void film_samples(const scene::FilmMap& film, const ReconstructionFilter& filter, const PixelOnFilm& pixel,
                  const Radiances& radiances, const PathEstimator::Keys& keys, std::span<Spectrum> samples);
/// By paths that are traced together; bit by bit film_sample.
void film_samples(const scene::FilmMap& film, const ReconstructionFilter& filter, const PixelOnFilm& pixel,
                  const PathEstimator& paths, const PathEstimator::Keys& keys, std::span<Spectrum> samples);

/// A measurement made ready to be sampled.
class MeasurementSampler {
 public:
  /// @throws core::InputError  for a patch without area, a direction that is not a unit vector, a camera or pixel that
  ///                           the scene does not have
  MeasurementSampler(const scene::Scene& scene, const measure::Measurement& asked);

  /// One whole path from one place: an unbiased estimate of the measurement in its unit.
  ///   patch: H(x), x uniform;   flux: A H(x), x uniform on all patches together;   point: H;   pixel: L.
  Spectrum sample(const PathEstimator& paths, core::RandomNumbers& numbers) const;
  /// The same of samples one after the other, traced together; bit by bit.
  void sample(const PathEstimator& paths, const PathEstimator::Keys& keys, std::span<Spectrum> samples) const;

  /// What an irradiance of 1 everywhere would measure: 1, the area of a flux [m²], 1 / pi for a pixel [1/sr].
  double scale() const { return scale_; }

  bool is_pixel() const { return film_ != nullptr; }
  /// Where a sample's path begins, by the numbers that `sample` takes for it: a pixel's, nothing where it sees none.
  std::optional<raycast::Ray> ray(core::RandomNumbers& numbers) const;
  /// That of all others.
  Receiver receiver(core::RandomNumbers& numbers) const { return place_->draw(numbers); }
  /// Of that [1/m²]; 0 of a point.
  double pdf_area() const { return place_->pdf_area(); }
  geometry::Box box() const { return place_->box(); }

 private:
  double scale_ = 1;
  std::optional<ReceiverSampler> place_;        ///< of a patch, flux or point
  std::shared_ptr<const scene::FilmMap> film_;  ///< of a pixel
  PixelOnFilm pixel_{};
};

}  // namespace interflect::montecarlo
