#pragma once

#include <cstdint>
#include <vector>

#include "fem/form_factor/seen_items.h"
#include "fem/form_factor/view_plane.h"

namespace interflect::fem {

/// What a square of a view plane sees, by subdivision [Warnock 1969], as [Sillion, Puech 1989] use it: a cell is
/// quartered until one polygon covers it all in front of the others, or nothing is in it, or its form factor is small;
/// a small one is worth what its middle sees. Cells' form factors are exact integrals, so that they sum to the
/// square's.
class Warnock {
 public:
  /// @param half_side  of the square at distance 1   @param small  form factor of cells that are cut no more
  Warnock(double half_side, double small) : half_side_(half_side), small_(small) {}

  void clear() { polygons_.clear(); }
  /// @param item  negative: it hides, but is not counted
  void add(const ProjectedPolygon& polygon, std::int32_t item);
  /// Adds to `visible` and `border`.
  void count(SeenItems& seen);

 private:
  struct Line {
    double a, b, c;  ///< a x + b y + c >= 0 inside
    double at(double x, double y) const { return a * x + b * y + c; }
  };
  struct Polygon {
    std::array<Line, ProjectedPolygon::capacity> edge;
    int edges;
    double x_low, x_high, y_low, y_high;
    double q0, qx, qy;
    std::int32_t item;
    double nearness(double x, double y) const { return q0 + qx * x + qy * y; }
  };
  struct Cell {
    double x, y, half;
  };
  /// A polygon in a cell, and how near it comes there, its plane extended over all of the cell.
  struct Candidate {
    std::uint32_t polygon;
    bool surrounds;
    double least, most;  ///< 1 / depth [1/m]
  };
  enum class Place { outside, crossing, surrounding };

  static Place place(const Polygon& polygon, const Cell& cell);
  void visit(const Cell& cell, std::size_t begin, std::size_t end, SeenItems& seen);
  void keep_the_nearest(const Cell& cell, std::size_t begin, std::size_t end);
  void sample(const Cell& cell, double factor, std::size_t begin, SeenItems& seen) const;

  double half_side_, small_;
  std::vector<Polygon> polygons_;
  std::vector<Candidate> stack_;  ///< candidates of the cells from the root to the one at hand
};

}  // namespace interflect::fem
