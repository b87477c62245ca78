#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "tests/fem/goal/random_rooms.h"

/// The bound that a pass states of its goal, against what it is off by.
namespace interflect::fem::test {

struct Stated {
  double bound, error, doubt;  ///< what the truth itself may be off by
};

/// Bounds over errors, ascending, and how many errors are beyond their bounds.
class Effectivity {
 public:
  void add(const Stated& s) {
    ratios_.insert(std::upper_bound(ratios_.begin(), ratios_.end(), s.bound / s.error), s.bound / s.error);
    if (s.error > s.bound + s.doubt) ++beyond_;
  }
  std::size_t size() const { return ratios_.size(); }
  int beyond() const { return beyond_; }
  /// @param share  of the ratios that are below it
  double quantile(double share) const { return ratios_[std::size_t(share * double(ratios_.size() - 1) + .5)]; }
  double least() const { return ratios_.front(); }

 private:
  std::vector<double> ratios_;
  int beyond_ = 0;
};

/// Goals in a scene by uniform elements of order 2, with what the estimate says that they lack.
class KnownGoals {
 public:
  KnownGoals(const scene::Scene& scene, double element_size, double tolerance, Run& run)
      : scene_(scene),
        rays_(raycast::make_ray_caster("embree", scene)),
        settings_(settings_of(2, tolerance)),
        run_(run) {
    settings_.element_size = element_size;
    solved_.emplace(solved(scene, settings_, run));
  }

  /// Of each pass of elements made for a goal, to an error over its value.
  /// @param element_size  of the start; 0: as by default
  std::vector<Stated> stated(const Goal& goal, int order, double element_size, double target) const {
    const DualWeighted known = dual_weighted_of(*solved_, scene_, goal, settings_, *rays_, run_);
    const double truth = known.value[0] + known.correction[0];
    RadiositySettings settings = settings_of(order, 1e-4);
    settings.element_size = element_size;
    std::vector<Stated> out;
    for (const AdaptivePass& pass : adapt_elements(scene_, settings, {goal, target}, *rays_, run_).adaptation.passes)
      out.push_back({pass.error[0], std::abs(pass.value[0] - truth), std::abs(known.correction[0])});
    return out;
  }

 private:
  const scene::Scene& scene_;
  std::unique_ptr<raycast::RayCaster> rays_;
  RadiositySettings settings_;
  Run& run_;
  std::optional<Solved> solved_;
};

}  // namespace interflect::fem::test
