#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/convex_blocker.h"

namespace interflect::geometry {

/// Rings one after another: what clipping in hot loops fills, again and again, without a heap.
class RingList {
 public:
  std::size_t size() const { return ends_.size(); }
  std::span<const Vec3> operator[](std::size_t k) const {
    const std::size_t begin = k == 0 ? 0 : ends_[k - 1];
    return {corners_.data() + begin, ends_[k] - begin};
  }
  /// How much there is, to come back to.
  struct Mark {
    std::size_t corners, rings;
  };
  Mark mark() const { return {corners_.size(), ends_.size()}; }
  void back_to(const Mark& mark) { corners_.resize(mark.corners), ends_.resize(mark.rings); }
  void clear() { corners_.clear(), ends_.clear(); }
  void push_back(std::span<const Vec3> ring) {
    corners_.insert(corners_.end(), ring.begin(), ring.end());
    ends_.push_back(static_cast<std::uint32_t>(corners_.size()));
  }

 private:
  std::vector<Vec3> corners_;
  std::vector<std::uint32_t> ends_;
};

/// Which part of a convex polygon is hidden from an eye by convex blockers, and which is seen: both as disjoint convex
/// polygons whose union is the whole, up to rounding ([Nishita, Nakamae 1985] subtract the projections of occluders).
///
/// Nothing is projected: each blocker's shadow is an intersection of half-spaces, so that neither blockers across the
/// eye's horizon nor polygons beyond a blocker's plane are special.  A decision whose sign rounding may turn moves a
/// sliver as wide as the rounding from one side to the other; it can neither lose a piece nor count one twice, since
/// every cut makes two pieces of one.  So areas are right to about 1e-15 of the whole per cut, without exact
/// arithmetic. Test: tests/geometry/hidden_part.cpp, against exact polygon booleans.
class HiddenPart {
 public:
  /// All corners relative to the eye.
  void start(std::span<const Vec3> ring);
  /// Takes what the intersection of these half-spaces holds from the seen to the hidden.
  void hide(std::span<const HalfSpace> shadow);

  const RingList& seen() const { return seen_; }
  const RingList& hidden() const { return hidden_; }

 private:
  bool cut(std::span<const HalfSpace> shadow);

  RingList seen_, hidden_, before_;
  std::vector<Vec3> inside_, outside_, rest_;
  std::vector<double> distance_;
};

}  // namespace interflect::geometry
