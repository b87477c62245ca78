#pragma once

#include "fem/form_factor/hemicube_sight.h"

namespace interflect::fem {

/// What it may cost that an element's form factors are those of its centre, and not the mean over its points: an
/// estimate.
///
/// With F_k from the centre (k = 0) and from the 4 or 6 nodes of a Gauss rule to a whole element (Lambert), and V_k the
/// part of it that a coarse hemicube sees from there, g_k = F_k V_k,
///
///   error = 1.5 | mean_{k>0} g_k - g_0 | + 0.3 (max g - min g)² / max g
///
/// The first term is what the centre errs by as far as the nodes can tell, of the order of (size / distance)²; so is
/// the second, which does not vanish where the first does by chance, and which grows to 0.3 max g where a shadow's edge
/// passes between the views.  What no view sees may be seen from elsewhere: 0.075 max F, less where the element is
/// small against the distance.
///
/// Where the centre sees everything that is there, as in a convex room, V is 1 and no more hemicubes are made.
class ProximityError {
 public:
  static constexpr std::size_t most_views = 7;
  /// @param resolution  of the method; the coarse hemicubes have a quarter of it
  ProximityError(const ViewScene& scene, int resolution);

  /// Memory of one thread.
  class Workspace {
   public:
    explicit Workspace(const ProximityError& of) : sight(of.coarse_) {}

   private:
    friend class ProximityError;
    HemicubeSight sight;
    std::array<SeenItems, most_views> seen;
  };

  struct Item {
    double unoccluded = 0;  ///< form factor from the centre if nothing hid it
    double error = 0;       ///< the estimate, as a form factor
  };
  /// @param centre  the eye of the row
  void estimate(const Eye& centre, Index element, Workspace& workspace, std::vector<Item>& items) const;

 private:
  const ViewScene& scene_;
  HemicubeGrid coarse_;
};

}  // namespace interflect::fem
