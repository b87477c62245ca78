#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "core/vec.h"

namespace interflect::mesh {

/// Points of one side of a surface by their place, bit for bit, and by the normal of the elements that share them:
/// where normals differ by more than 20 degrees there is a sharp edge, and nothing is shared.
class SharedPoints {
 public:
  std::optional<std::uint32_t> find(const Vec3& p, const Vec3& normal) const;
  void add(const Vec3& p, const Vec3& normal, std::uint32_t number) { known_[key(p)].push_back({number, normal}); }

 private:
  struct Known {
    std::uint32_t number;
    Vec3 normal;
  };
  using Key = std::array<double, 3>;
  static Key key(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

  std::map<Key, std::vector<Known>> known_;
};

}  // namespace interflect::mesh
