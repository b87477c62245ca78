#pragma once

#include "fem/form_factor/item_buffer.h"
#include "fem/form_factor/view_scene.h"

namespace interflect::fem {

/// A way to see all elements from one point of another; with memory of its own, so one for each thread.
class Sight {
 public:
  virtual ~Sight() = default;
  /// Form factors from `eye`, a point of `element`, to all elements.
  /// @param seen  cleared and filled, an item per element
  virtual void look(const ViewScene& scene, const Eye& eye, Index element, SeenItems& seen) = 0;
};

}  // namespace interflect::fem
