#pragma once

#include <Eigen/Core>
#include <functional>
#include <span>
#include <vector>

#include "fem/quadrature.h"
#include "fem/space/element_basis.h"
#include "scene/place.h"
#include "solvers/layout.h"

namespace interflect::fem {

/// What elements are to a space: a planar triangle or convex quad with the normal of the side that exchanges light, or
/// a segment with a normal across it, of flatland.
struct Panel {
  std::array<Vec3, 4> corner;
  std::size_t corners;
  Vec3 normal;
  double measure;  ///< area [m²]; of segments the length [m]

  std::span<const Vec3> ring() const { return {corner.data(), corners}; }
};
Panel panel_of(const scene::SurfacePatch& patch);
/// In the plane z = 0; light leaves to the left of the way from a to b.
Panel segment_panel(const Vec3& a, const Vec3& b);

/// Nodes on a panel, with what its functions are there.
struct PanelNodes {
  std::vector<Vec3> position;
  std::vector<double> weight;  ///< [m²] or [m]; they sum to the panel's measure
  Eigen::MatrixXd values;      ///< nodes x functions
};

/// Polynomials of one order on panels, without continuity: unknowns are (panel, function), functions as in
/// ElementBasis.
///
///   G_ab = int N_a N_b = A delta_ab,   f_h = sum_a c_a N_a with c_a = (1/A) int f N_a, the best approximation in L2
class Space {
 public:
  using Field = std::function<double(Index panel, const Vec3& x)>;

  /// @throws core::PreconditionError  an order that is not 0 .. 3
  Space(std::vector<Panel> panels, int order);

  int order() const { return order_; }
  std::span<const Panel> panels() const { return panels_; }
  const Panel& panel(Index i) const { return panels_[static_cast<std::size_t>(i)]; }
  const ElementBasis& basis(Index i) const { return bases_[static_cast<std::size_t>(i)]; }
  const solvers::Layout& layout() const { return layout_; }
  std::span<const double> gram() const { return gram_; }  ///< the diagonal of G
  Index first(Index i) const { return layout_.first_of_element[static_cast<std::size_t>(i)]; }
  Index functions(Index i) const { return basis(i).size(); }

  PanelNodes nodes(Index i, const Rule& rule) const;
  /// By Gauss rules of so many points, 1 .. 4, on triangles those beside them (rules_of).
  PanelNodes nodes(Index i, int points) const;

  Eigen::VectorXd project(const Field& f, int points) const;
  double value(const Eigen::VectorXd& coefficients, Index i, double u, double v) const;
  /// sqrt(int (f_h - f)²) over all panels.
  double distance(const Eigen::VectorXd& coefficients, const Field& f, int points) const;

 private:
  int order_;
  std::vector<Panel> panels_;
  std::vector<ElementBasis> bases_;
  solvers::Layout layout_;
  std::vector<double> gram_;
};

/// On elements of a scene.
Space space_on(std::span<const scene::SurfacePatch> patches, int order);

}  // namespace interflect::fem
