#include "geometry/hidden_part.h"

#include <algorithm>
#include <utility>

#include "geometry/split.h"

namespace interflect::geometry {

void HiddenPart::start(std::span<const Vec3> ring) {
  seen_.clear();
  hidden_.clear();
  seen_.push_back(ring);
}

void HiddenPart::hide(std::span<const HalfSpace> shadow) {
  std::swap(seen_, before_);
  seen_.clear();
  for (std::size_t k = 0; k < before_.size(); ++k) {
    rest_.assign(before_[k].begin(), before_[k].end());
    const auto misses = [&](const HalfSpace& half) { return side_of(rest_, half, distance_) == HalfSide::outside; };
    if (std::any_of(shadow.begin(), shadow.end(), misses) || !cut(shadow))
      seen_.push_back(before_[k]);
    else
      hidden_.push_back(rest_);
  }
}

/// Cuts what is outside off rest_, half-space after half-space, and adds it to the seen; false, and the seen unchanged,
/// where nothing is left in the end.
bool HiddenPart::cut(std::span<const HalfSpace> shadow) {
  const RingList::Mark before = seen_.mark();
  for (const HalfSpace& half : shadow) {
    const HalfSide side = side_of(rest_, half, distance_);
    if (side == HalfSide::inside) continue;
    if (side == HalfSide::across) {
      split(rest_, distance_, inside_, outside_);
      if (inside_.size() >= 3) {
        if (outside_.size() >= 3) seen_.push_back(outside_);
        std::swap(rest_, inside_);
        continue;
      }
    }
    seen_.back_to(before);
    return false;
  }
  return true;
}

}  // namespace interflect::geometry
