#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/format.h"
#include "core/vec.h"

/// Files of geometry, written as a user would.
namespace interflect::test {

/// Polygons of a View3D file, one after another.
class View3dText {
 public:
  /// @param kind  S, M, N or O;  @param base  number of the surface that it lies on, from 1; 0: none
  void polygon(char kind, const std::vector<Vec3>& ring, const std::string& name, int base = 0,
               double emittance = 0.9) {
    std::string corners;
    for (const Vec3& x : ring) {
      vertices_ += core::format("V %d %.17g %.17g %.17g\n", ++count_, x.x(), x.y(), x.z());
      corners += core::format(" %d", count_);
    }
    surfaces_ += core::format("%c %d%s%s %d 0 %.17g %s\n", kind, ++number_, corners.c_str(),
                              ring.size() == 3 ? " 0" : "", base, emittance, name.c_str());
  }
  std::string text() const { return "T a test\nF 3\n" + vertices_ + surfaces_ + "E\n"; }

 private:
  std::string vertices_, surfaces_;
  int count_ = 0, number_ = 0;
};

/// The six walls of a box, seen from inside: low corner, sizes.
inline void add_walls(View3dText& text, const Vec3& low, const Vec3& size) {
  const Vec3 x(size.x(), 0, 0), y(0, size.y(), 0), z(0, 0, size.z());
  text.polygon('S', {low, low + x, low + x + y, low + y}, "floor");
  text.polygon('S', {low + z, low + z + y, low + x + y + z, low + x + z}, "ceiling");
  text.polygon('S', {low, low + y, low + y + z, low + z}, "west");
  text.polygon('S', {low + x, low + x + z, low + x + y + z, low + x + y}, "east");
  text.polygon('S', {low, low + z, low + x + z, low + x}, "south");
  text.polygon('S', {low + y, low + x + y, low + x + y + z, low + y + z}, "north");
}

/// A crate that stands on the floor (surface 1): its five faces, and what it covers as a mask.
inline void add_crate(View3dText& text, const Vec3& low, const Vec3& size) {
  const Vec3 x(size.x(), 0, 0), y(0, size.y(), 0), z(0, 0, size.z());
  text.polygon('S', {low + z, low + x + z, low + x + y + z, low + y + z}, "top", 0, 0.5);
  text.polygon('S', {low, low + z, low + y + z, low + y}, "side-w", 0, 0.5);
  text.polygon('S', {low + x, low + x + y, low + x + y + z, low + x + z}, "side-e", 0, 0.5);
  text.polygon('S', {low, low + x, low + x + z, low + z}, "side-s", 0, 0.5);
  text.polygon('S', {low + y, low + y + z, low + x + y + z, low + x + y}, "side-n", 0, 0.5);
  text.polygon('M', {low + y, low + x + y, low + x, low}, "bottom", 1, 0.7);
}

}  // namespace interflect::test
