#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "measure/path_classes.h"
#include "montecarlo/lamps.h"
#include "montecarlo/next_event.h"
#include "montecarlo/sample_report.h"

namespace interflect::montecarlo {

/// Light of which chance alone tells: what small lights send by way of mirrors, smooth glass or nearly smooth metal onto
/// what is none.  No way can be drawn to it, and where no path has met it, samples know nothing of it.  Without next-event
/// estimation all light is of that kind.
///
/// A find is pi L of irradiance.  Where n samples met none, the lamps of one radiance may have brought 3 pi L / n together
/// (rule of three); a sun no more than H by each mirror, its image there (not those of images).  A lamp counts as met
/// where paths as long as is usual there meet it a hundred times in n samples: ten times where it shines at a tenth of
/// that, aslant or by a dark mirror.  Where all that is smooth has a lobe, the lamp is found as often as that is wide, if
/// it is the smaller one, and a find is so much less.
/// Test: tests/montecarlo/rare_light.cpp
class RareLights {
 public:
  /// Where paths begin that look for it.
  struct From {
    geometry::Box box;
    bool pixel = false;    ///< what a mirror shows there is met by every path
    double walked_to = 0;  ///< chance that a walk from a light which comes from what is smooth is counted there
  };
  /// The scene must outlive it.
  /// @param lights  the scene's
  /// @param paths   that count
  RareLights(const scene::Scene& scene, const LightSet& lights, const measure::PathClasses& paths,
             NextEvent next_event = NextEvent::yes);
  bool empty() const { return lights_.empty(); }
  /// A mirror, smooth glass, or what is nearly one.
  static bool throws_narrowly(const scene::Material& material);

  /// What so many samples of an irradiance may lack, as a standard error [W/m² | lx].
  Spectrum lacks(std::uint64_t samples, const From& from) const;
  /// Samples for which that is as little, weighed, as far as samples help.
  double samples_for(double wanted, const From& from) const;
  /// Of measurement `m`, of that scale: as much into its standard errors; told where it is most of them, of the
  /// measurement that has the fewest samples.
  void add_to(Estimate& estimate, double scale, const From& from, std::size_t m, SampleReport& report) const;
  /// Of a picture with so many samples a pixel, whose errors are of these alone: what is lacked, in words; empty where
  /// nothing is.
  std::string of_picture(std::uint64_t samples) const;

 private:
  struct RareLight {
    AlikeLamps of;
    bool to_places, to_pixels;
    bool comes_to(const From& from) const { return from.pixel ? to_pixels : to_places; }
  };
  /// Of the lamp that is found least: that a path finds it; and of a find, how much of pi L it is at most.
  struct Chance {
    const Lamp* of;
    double found, share;
  };
  void set_smooth();
  std::string text(std::uint64_t samples, const From& from, const char* ending) const;
  void add(std::vector<AlikeLamps> lamps, char letter, const measure::PathClasses& there);
  double met(const Lamp& lamp, const From& from) const;
  double walks_meet(const From& from) const;
  Chance chance(const RareLight& light, const From& from) const;
  Spectrum lacks(const RareLight& light, double samples, const From& from) const;

  const scene::Scene& scene_;
  bool by_mirrors_;
  double section_;          ///< that walks from afar cover [m²]
  geometry::Box smooth_;    ///< around all that mirrors, or nearly
  double smooth_area_ = 0;  ///< [m²]
  bool mirrors_ = false, lobes_ = false;
  double images_ = 0;  ///< of a light, by one of them each, as far as chance alone finds them
  double lobe_ = 1;    ///< part of all paths that the narrowest catches: 0 of a mirror, 1 where there is none
  std::vector<RareLight> lights_;
};

}  // namespace interflect::montecarlo
