#include "fem/bounds/enclosure.h"

#include <atomic>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "core/error.h"
#include "core/format.h"
#include "fem/bounds/error_transport.h"
#include "fem/bounds/lit_regions.h"
#include "fem/columns.h"
#include "fem/point_view_factors.h"
#include "scene/inspection.h"

namespace interflect::fem {
namespace {

using solvers::ColumnMatrix;
using Row = Eigen::RowVectorXd;

/// How often a cell may be cut: a few large elements are cut once more, which there is time for.
int cuts_of(Index elements) {
  constexpr Index few = 160;
  return elements <= few ? 4 : 3;
}

/// Elements, and what else light may end on.
Surroundings surroundings_of(const scene::Scene& scene, std::span<const scene::SurfacePatch> elements,
                             const std::optional<std::vector<scene::SurfacePatch>>& black, bool closed) {
  std::vector<scene::SurfacePatch> all(elements.begin(), elements.end());
  if (black) all.insert(all.end(), black->begin(), black->end());
  return {scene, all, closed || !black};
}

}  // namespace

class Enclosure::Iteration {
 public:
  Iteration(const scene::Scene& scene, const RadiositySolution& solution)
      : patches_(solution.mesh.patches()),
        lit_(scene),
        black_(lit_.black_ones(scene)),
        around_(surroundings_of(scene, patches_, black_, lit_.closed())),
        field_(solution.field ? &*solution.field : nullptr),
        factors_(scene, patches_, field_ ? std::min(1, field_->order) : 0),
        B_(around_, solution, scene.channel_count()),
        elements_(std::ssize(patches_)),
        channels_(scene.channel_count()),
        transports_(patches_.size()),
        constants_(to_columns(solution.radiosity, scene.channel_count())),
        H_(elements_, channels_),
        mean_H_(elements_, channels_),
        e_(elements_, channels_),
        r_(B_, solution),
        g_(around_.elements() * QuarterTree::nodes, channels_),
        slack_(r_.rounding()) {}

  void look_around(double max_memory, Run& run) {
    core::Progress::Stage stage(run.progress, "bounds", patches_.size());
    std::atomic<std::size_t> bytes = 0;
    run.threads.for_blocks(elements_, 1, [&](Index element, Index) {
      run.throw_if_stopped("bounds");
      const auto k = static_cast<std::size_t>(element);
      transports_[k] =
          transport_over(around_, around_.cell(patches_[k].ring()), B_, black_.has_value(), cuts_of(elements_));
      bytes += bytes_of(transports_[k]);
      if (static_cast<double>(bytes) > max_memory)
        throw core::InputError("bounds", core::format("of %td elements they need more than %s: --max-memory, or larger "
                                                      "elements",
                                                      elements_, core::format_bytes(max_memory).c_str()));
      r_.find(element, transports_[k]);
      stage.advance(1);
    });
  }

  void iterate(Run& run) {
    start();
    constexpr int most = 200;
    constexpr double enough = 3e-3;
    double before = std::numeric_limits<double>::infinity();
    for (int pass = 0; pass < most; ++pass) {
      run.throw_if_stopped("bounds");
      slack_ = r_.rounding() + 1e-6 * largest_parts();
      ManyBounds next = g_;
      run.threads.for_blocks(elements_, 1, [&](Index element, Index) { improve(element, next); });
      g_ = std::move(next);
      const double width = (g_.upper - g_.lower).sum();
      if (width >= (1 - enough) * before) break;
      before = width;
    }
  }

  /// Light is never negative, and its mean is one of the values that it has, whatever else is known.
  void set_results() {
    H_.lower = H_.lower.cwiseMax(0.0);
    mean_H_.lower = mean_H_.lower.cwiseMax(H_.lower);
    mean_H_.upper = mean_H_.upper.cwiseMin(H_.upper);
    for (Index i = 0; i < elements_; ++i) {
      const Row E = r_.exitance().row(i), rho = r_.reflectance().row(i);
      irradiance.push_back(H_.of(i));
      mean_irradiance.push_back(mean_H_.of(i));
      error.push_back(e_.of(i));
      radiosity.push_back(
          {to_spectrum(E + rho.cwiseProduct(H_.lower.row(i))), to_spectrum(E + rho.cwiseProduct(H_.upper.row(i)))});
    }
  }
  Interval irradiance_at(const measure::PointIrradiance& at) const {
    const Index functions = factors_.functions();
    std::vector<double> F(patches_.size() * static_cast<std::size_t>(functions)), rounding(patches_.size());
    factors_(at, F, rounding);
    Bounds H = Bounds::zero(channels_);
    for (Index j = 0; j < elements_; ++j) {
      const auto k = static_cast<std::size_t>(j);
      const ColumnMatrix B = coefficients(j, functions);
      const Row sent = Eigen::Map<const Row>(&F[k * static_cast<std::size_t>(functions)], functions) * B,
                doubt = rounding[k] * B.cwiseAbs().colwise().sum();
      H.lower += sent - doubt;
      H.upper += sent + doubt;
    }
    const CellTransport transport =
        transport_over(around_, around_.cell_at(at.position, at.normal), B_, is_surrounded(at), 0);
    H = H + error_over_leaves(transport).front();
    H.lower = H.lower.cwiseMax(0.0);
    return {to_spectrum(H.lower), to_spectrum(H.upper)};
  }

  std::vector<Interval> irradiance, mean_irradiance, radiosity, error;

 private:
  /// Whether all rays from a point end on something that is known here.
  bool is_surrounded(const measure::PointIrradiance& at) const {
    return lit_.closed() ? lit_.contain(at.position, at.normal) : black_ && around_.within(at.position);
  }
  /// B_h on an element by its constant, or by that and its linear functions.
  ColumnMatrix coefficients(Index element, Index functions) const {
    return functions > 1 ? ColumnMatrix(field_->radiosity.middleRows(element * field_->functions, functions))
                         : ColumnMatrix(constants_.row(element));
  }

  /// The largest |r| there may be, and the largest |T e|.
  double largest_parts() const {
    const double r = r_.everywhere().upper.cwiseMax(-r_.everywhere().lower).maxCoeff();
    return r + g_.upper.cwiseMax(-g_.lower).maxCoeff();
  }

  /// T e <= max e <= max r / (1 - max rho)
  void start() {
    const Row rho = r_.reflectance().colwise().maxCoeff();
    if (rho.size() > 0 && rho.maxCoeff() >= 1)
      throw core::InputError("bounds", "none can be proved where a surface reflects everything");
    const Bounds all{r_.everywhere().lower.colwise().minCoeff().cwiseMin(0.0).array() / (1 - rho.array()),
                     r_.everywhere().upper.colwise().maxCoeff().cwiseMax(0.0).array() / (1 - rho.array())};
    for (Index row = 0; row < g_.upper.rows(); ++row) g_.narrow(row, all);
  }

  /// T e over leaves, with what rounding may do to it and to what it is added to.
  std::vector<Bounds> error_over_leaves(const CellTransport& transport) const {
    std::vector<Bounds> of_leaves = ErrorTransport(r_, g_).over_leaves(transport);
    for (Bounds& of_leaf : of_leaves) of_leaf = of_leaf.widened(slack_);
    return of_leaves;
  }

  void improve(Index element, ManyBounds& next) {
    const CellTransport& transport = transports_[static_cast<std::size_t>(element)];
    const std::vector<Bounds> of_leaves = error_over_leaves(transport);
    std::vector<Bounds> of_nodes(QuarterTree::nodes, Bounds::none(channels_));
    for (const NodeResiduals::Cover& cover : r_.covers(element))
      of_nodes[static_cast<std::size_t>(cover.node)].widen(of_leaves[cover.leaf]);
    Bounds H = Bounds::none(channels_), mean_H = Bounds::zero(channels_), e = Bounds::none(channels_);
    const Row rho = r_.reflectance().row(element);
    for (std::size_t l = 0; l < of_leaves.size(); ++l) {
      const Leaf& leaf = transport.leaves[l];
      H.widen(leaf.everywhere + of_leaves[l]);
      e.widen(r_.over(element, transport.cell_of(leaf), leaf.polynomial) + of_leaves[l].scaled(rho));
      mean_H = mean_H + (leaf.mean + of_leaves[l]).scaled(Row::Constant(channels_, leaf.share));
    }
    H_.narrow(element, H);
    mean_H_.narrow(element, mean_H);
    e_.narrow(element, e);
    for (Index node = 0; node < QuarterTree::nodes; ++node)
      next.narrow(element * QuarterTree::nodes + node, of_nodes[static_cast<std::size_t>(node)]);
  }

  std::span<const scene::SurfacePatch> patches_;
  LitRegions lit_;
  std::optional<std::vector<scene::SurfacePatch>> black_;
  Surroundings around_;
  const PolynomialField* field_;
  PointViewFactors factors_;
  LinearField B_;
  Index elements_, channels_;
  std::vector<CellTransport> transports_;
  ColumnMatrix constants_;
  ManyBounds H_, mean_H_, e_;  ///< of elements
  NodeResiduals r_;
  ManyBounds g_;  ///< T e on nodes
  double slack_;  ///< for rounding
};

Enclosure::Enclosure(const scene::Scene& scene, const RadiositySolution& solution, double max_memory, Run& run) {
  scene::require_each_place_once(scene);
  of_ = std::make_unique<Iteration>(scene, solution);
  of_->look_around(max_memory, run);
  of_->iterate(run);
  of_->set_results();
}
Enclosure::~Enclosure() = default;
Enclosure::Enclosure(Enclosure&&) noexcept = default;

std::span<const Interval> Enclosure::irradiance() const { return of_->irradiance; }
std::span<const Interval> Enclosure::mean_irradiance() const { return of_->mean_irradiance; }
std::span<const Interval> Enclosure::radiosity() const { return of_->radiosity; }
std::span<const Interval> Enclosure::error() const { return of_->error; }
Interval Enclosure::irradiance_at(const measure::PointIrradiance& at) const { return of_->irradiance_at(at); }

}  // namespace interflect::fem
