#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <vector>

#include "fem/assembly.h"
#include "fem/operator/dense_symmetric.h"
#include "fem/point_view_factors.h"
#include "fem/space/polynomials.h"
#include "solvers/solver.h"
#include "tests/fem/rooms.h"

namespace interflect::fem::test {

/// K of polynomials on elements of one's own choice, by "analytic" form factors, to be solved for any rho that is
/// constant on surfaces and any E.
class AssembledScene {
 public:
  using OnSurface = std::function<double(scene::SurfaceId)>;

  /// @param tolerance  relative, of an entry
  AssembledScene(scene::Scene scene, std::vector<scene::SurfacePatch> patches, int order, double tolerance)
      : scene_(std::move(scene)), patches_(std::move(patches)), order_(order), points_(scene_, patches_, order) {
    const auto caster = raycast::make_ray_caster("embree", scene_);
    FormFactorContext context{scene_, patches_, *caster, 1, tolerance};
    context.order = order;
    std::vector<double> gram;
    for (const scene::SurfacePatch& patch : patches_)
      gram.insert(gram.end(), static_cast<std::size_t>(functions()), patch.area);
    K_ = std::make_unique<DenseSymmetric>(std::move(gram));
    assemble(*make_form_factor_method("analytic", context), patches_, *K_, run_.get());
  }
  // Elements and points refer to the scene.
  AssembledScene(const AssembledScene&) = delete;
  AssembledScene& operator=(const AssembledScene&) = delete;

  Index functions() const { return plane_functions(order_); }
  const DenseSymmetric& K() const { return *K_; }

  /// Coefficients of B.
  solvers::ColumnMatrix solve(const OnSurface& rho, const OnSurface& exitance) {
    solvers::ColumnMatrix e = solvers::ColumnMatrix::Zero(K_->size(), 1);
    for (Index i = 0; i < std::ssize(patches_); ++i) e(i * functions(), 0) = exitance(surface(i));
    return solve(rho, e);
  }
  /// @param e  coefficients of E, which may vary on elements
  solvers::ColumnMatrix solve(const OnSurface& rho, const solvers::ColumnMatrix& e) {
    solvers::ColumnMatrix reflectance = solvers::ColumnMatrix::Zero(K_->size(), 1);
    for (Index i = 0; i < std::ssize(patches_); ++i)
      reflectance.middleRows(i * functions(), functions()).setConstant(rho(surface(i)));
    const solvers::Reflection R(reflectance);
    solvers::SolverState state{e, 0};
    const auto report = solvers::make_solver("gauss-seidel")->advance({*K_, R, e}, state, {1e-14, 1000}, run_.get());
    EXPECT_TRUE(report.converged());
    return state.x;
  }
  /// Of B over the elements of a surface.
  double mean(const solvers::ColumnMatrix& B, scene::SurfaceId of) const {
    double sum = 0, area = 0;
    for (Index i = 0; i < std::ssize(patches_); ++i)
      if (surface(i) == of) {
        sum += patches_[std::size_t(i)].area * B(i * functions(), 0);
        area += patches_[std::size_t(i)].area;
      }
    return sum / area;
  }
  /// H_1 = T B_h at a point in the plane of a surface, in front of it.
  double irradiance(const solvers::ColumnMatrix& B, const Vec3& x, scene::SurfaceId on) const {
    std::vector<double> F(static_cast<std::size_t>(B.rows())), error(patches_.size());
    const Vec3 normal = geometry::plane_of(scene_.surface(on).outline->outer).normal;
    points_({x, normal, on}, F, error);
    return Eigen::Map<const Eigen::VectorXd>(F.data(), B.rows()).dot(B.col(0));
  }

 private:
  scene::SurfaceId surface(Index i) const { return patches_[std::size_t(i)].surface; }

  scene::Scene scene_;
  std::vector<scene::SurfacePatch> patches_;
  int order_;
  PointViewFactors points_;
  core::LocalRun run_{1, 2};
  std::unique_ptr<DenseSymmetric> K_;
};

}  // namespace interflect::fem::test
