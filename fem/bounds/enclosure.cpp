#include "fem/bounds/enclosure.h"

#include <atomic>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "core/error.h"
#include "core/format.h"
#include "fem/bounds/allotment.h"
#include "fem/bounds/cell_transport.h"
#include "fem/bounds/lit_regions.h"
#include "fem/columns.h"
#include "fem/point_view_factors.h"
#include "scene/inspection.h"
#include "scene/place.h"

namespace interflect::fem {
namespace {

using solvers::ColumnMatrix;
using Row = Eigen::RowVectorXd;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Of many elements, per channel.
struct ManyBounds {
  ColumnMatrix lower, upper;

  ManyBounds(Index rows, Index channels)
      : lower(ColumnMatrix::Constant(rows, channels, -infinity)),
        upper(ColumnMatrix::Constant(rows, channels, infinity)) {}
  void narrow(Index row, const Bounds& to) {
    lower.row(row) = lower.row(row).cwiseMax(to.lower);
    upper.row(row) = upper.row(row).cwiseMin(to.upper);
  }
  Interval of(Index row) const { return {to_spectrum(lower.row(row)), to_spectrum(upper.row(row))}; }
};

/// The residual on nodes of elements' quarter trees.
struct Residuals {
  ManyBounds everywhere, mean;
  ColumnMatrix deviation;  ///< mean |r - its mean|, at most

  Residuals(Index elements, Index channels)
      : everywhere(elements * QuarterTree::nodes, channels),
        mean(elements * QuarterTree::nodes, channels),
        deviation(elements * QuarterTree::nodes, channels) {}
};

/// A leaf that a node of its element holds, or is held by.
struct Cover {
  int node;
  std::size_t leaf;
};

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
        exitance_(to_columns(solution.exitance, scene.channel_count())),
        reflectance_(to_columns(solution.reflectance, scene.channel_count())),
        elements_(exitance_.rows()),
        channels_(exitance_.cols()),
        slack_(1e-11 * B_.largest()),
        transports_(patches_.size()),
        constants_(to_columns(solution.radiosity, scene.channel_count())),
        H_(elements_, channels_),
        mean_H_(elements_, channels_),
        e_(elements_, channels_),
        r_(around_.elements(), channels_),
        g_(around_.elements() * QuarterTree::nodes, channels_),
        covers_(patches_.size()) {
    const Index black = around_.elements() - elements_, nodes = black * QuarterTree::nodes;
    reflectance_.conservativeResize(around_.elements(), Eigen::NoChange);
    reflectance_.bottomRows(black).setZero();
    for (ColumnMatrix* r : {&r_.everywhere.lower, &r_.everywhere.upper, &r_.mean.lower, &r_.mean.upper, &r_.deviation})
      r->bottomRows(nodes).setZero();
  }

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
      find_residuals(element, 0, transports_[k].cell());
      stage.advance(1);
    });
  }

  void iterate(Run& run) {
    start();
    constexpr int most = 200;
    constexpr double enough = 3e-3;
    double before = infinity;
    for (int pass = 0; pass < most; ++pass) {
      run.throw_if_stopped("bounds");
      slack_ = 1e-11 * B_.largest() + 1e-6 * largest_parts();
      ManyBounds next = g_;
      run.threads.for_blocks(elements_, 1, [&](Index element, Index) { improve(element, next); });
      g_ = std::move(next);
      const double width = (g_.upper - g_.lower).sum();
      if (width >= (1 - enough) * before) break;
      before = width;
    }
  }

  /// Light is never negative, whatever else is known.
  void set_results() {
    H_.lower = H_.lower.cwiseMax(0.0);
    mean_H_.lower = mean_H_.lower.cwiseMax(0.0);
    for (Index i = 0; i < elements_; ++i) {
      const Row E = exitance_.row(i), rho = reflectance_.row(i);
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
    H = H + with_slack(transported(transport).front());
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

  /// r over a part of an element about whose centre T B_h is a polynomial.
  Bounds residual(Index element, const Cell& part, SmoothSum TB) const {
    TB.scale(reflectance_.row(element));
    TB.value += exitance_.row(element) - B_.at(element, part.centre);
    TB.derivatives.topRows<2>() -= B_.gradient(element, part);
    return with_slack(TB.everywhere(part));
  }
  Bounds mean_residual(Index element, const Cell& part, const Bounds& mean_TB) const {
    const Row rho = reflectance_.row(element), others = exitance_.row(element) - B_.at(element, part.centre);
    return with_slack({others + rho.cwiseProduct(mean_TB.lower), others + rho.cwiseProduct(mean_TB.upper)});
  }
  Bounds with_slack(const Bounds& b) const { return {b.lower.array() - slack_, b.upper.array() + slack_}; }

  /// The largest |r| there may be, and the largest |T e|.
  double largest_parts() const {
    const double r = r_.everywhere.upper.cwiseMax(-r_.everywhere.lower).maxCoeff();
    return r + g_.upper.cwiseMax(-g_.lower).maxCoeff();
  }

  void find_residuals(Index element, int node, const Cell& cell) {
    Bounds all = Bounds::none(channels_), mean = Bounds::zero(channels_);
    std::vector<std::pair<double, Bounds>> parts;  // share, r
    double shares = 0;
    const CellTransport& transport = transports_[static_cast<std::size_t>(element)];
    for (std::size_t l = 0; l < transport.leaves.size(); ++l) {
      const Leaf& leaf = transport.leaves[l];
      const Cell& of_leaf = transport.cell_of(leaf);
      if (holds(cell, of_leaf)) {
        parts.emplace_back(of_leaf.area / cell.area, residual(element, of_leaf, leaf.polynomial));
        mean.lower += parts.back().first * leaf.mean.lower;
        mean.upper += parts.back().first * leaf.mean.upper;
      } else if (holds(of_leaf, cell)) {
        SmoothSum polynomial = leaf.polynomial;
        polynomial.move(of_leaf.local(cell.centre));
        mean = polynomial.mean(cell);
        parts.emplace_back(1.0, residual(element, cell, std::move(polynomial)));
      } else {
        continue;
      }
      covers_[static_cast<std::size_t>(element)].push_back({node, l});
      shares += parts.back().first;
      all.widen(parts.back().second);
    }
    if (std::abs(shares - 1) > 1e-9) throw core::PreconditionError("enclose: leaves that do not cover their element");
    const Index row = element * QuarterTree::nodes + node;
    const Bounds mean_r = mean_residual(element, cell, mean);
    r_.everywhere.narrow(row, all);
    r_.mean.narrow(row, mean_r);
    Row deviation = Row::Zero(channels_);
    for (const auto& [share, r] : parts) deviation += share * (r.upper - mean_r.lower).cwiseMax(mean_r.upper - r.lower);
    r_.deviation.row(row) = deviation.cwiseMin(0.5 * (all.upper - all.lower));
    if (!QuarterTree::has(QuarterTree::child(node, 0))) return;
    const auto rings = scene::quarters_of(cell.ring);
    for (int k = 0; k < 4; ++k)
      find_residuals(element, QuarterTree::child(node, k),
                     cell_of(std::span(rings[static_cast<std::size_t>(k)]).first(cell.ring.size()), cell));
  }
  /// Of quarters of quarters of one cell.
  static bool holds(const Cell& a, const Cell& b) { return b.area <= a.area * (1 + 1e-9) && inside(a, b.centre); }
  static bool inside(const Cell& cell, const Vec3& x) {
    for (std::size_t k = 0; k < cell.ring.size(); ++k) {
      const Vec3& from = cell.ring[k];
      if (cell.normal.dot((cell.ring[(k + 1) % cell.ring.size()] - from).cross(x - from)) < 0) return false;
    }
    return true;
  }

  /// T e <= max e <= max r / (1 - max rho)
  void start() {
    const Row rho = reflectance_.colwise().maxCoeff();
    if (rho.size() > 0 && rho.maxCoeff() >= 1)
      throw core::InputError("bounds", "none can be proved where a surface reflects everything");
    const Bounds all{r_.everywhere.lower.colwise().minCoeff().cwiseMin(0.0).array() / (1 - rho.array()),
                     r_.everywhere.upper.colwise().maxCoeff().cwiseMax(0.0).array() / (1 - rho.array())};
    for (Index row = 0; row < g_.upper.rows(); ++row) g_.narrow(row, all);
  }

  /// T e over the leaves.
  std::vector<Bounds> transported(const CellTransport& transport) const {
    const std::vector<ShiftedSum> high = far_sums(transport, 1), low = far_sums(transport, -1);
    std::vector<Bounds> out;
    for (const Leaf& leaf : transport.leaves)
      out.push_back(with_slack(
          {-highest(transport, leaf, -1, low[leaf.branch]), highest(transport, leaf, 1, high[leaf.branch])}));
    return out;
  }

  void improve(Index element, ManyBounds& next) {
    const CellTransport& transport = transports_[static_cast<std::size_t>(element)];
    const std::vector<Bounds> of_leaves = transported(transport);
    std::vector<Bounds> of_nodes(QuarterTree::nodes, Bounds::none(channels_));
    for (const Cover& cover : covers_[static_cast<std::size_t>(element)])
      of_nodes[static_cast<std::size_t>(cover.node)].widen(of_leaves[cover.leaf]);
    Bounds H = Bounds::none(channels_), mean_H = Bounds::zero(channels_), e = Bounds::none(channels_);
    const Row rho = reflectance_.row(element);
    for (std::size_t l = 0; l < of_leaves.size(); ++l) {
      const Leaf& leaf = transport.leaves[l];
      const Bounds mean_of_leaf = leaf.mean + of_leaves[l];
      H.widen(leaf.everywhere + of_leaves[l]);
      e.widen(residual(element, transport.cell_of(leaf), leaf.polynomial) +
              Bounds{rho.cwiseProduct(of_leaves[l].lower), rho.cwiseProduct(of_leaves[l].upper)});
      mean_H.lower += leaf.share * mean_of_leaf.lower;
      mean_H.upper += leaf.share * mean_of_leaf.upper;
    }
    H_.narrow(element, with_slack(H));
    mean_H_.narrow(element, with_slack(mean_H));
    e_.narrow(element, with_slack(e));
    for (Index node = 0; node < QuarterTree::nodes; ++node)
      next.narrow(element * QuarterTree::nodes + node, of_nodes[static_cast<std::size_t>(node)]);
  }

  /// sign e <= this, anywhere on a node.
  double highest(std::uint32_t source, Index c, int sign) const {
    const Index j = source / QuarterTree::nodes;
    const double rho = reflectance_(j, c);
    return sign > 0 ? r_.everywhere.upper(source, c) + rho * g_.upper(source, c)
                    : -(r_.everywhere.lower(source, c) + rho * g_.lower(source, c));
  }
  /// The same of the mean of r and of T e anywhere: T e may vary as k does, and the mean of their product be more than
  /// that of their means.
  double by_mean(std::uint32_t source, Index c, int sign) const {
    const Index j = source / QuarterTree::nodes;
    const double rho = reflectance_(j, c);
    return sign > 0 ? r_.mean.upper(source, c) + rho * g_.upper(source, c)
                    : -(r_.mean.lower(source, c) + rho * g_.lower(source, c));
  }

  /// What element j sends of e with a sign: by the mean of r, or by what it is anywhere, whichever says more.
  void add(const Exchange& from, int sign, ShiftedSum& sum) const {
    sum.add_factor(from);
    for (Index c = 0; c < channels_; ++c) {
      double e = highest(from.source, c, sign), doubt = 0;
      if (from.known == Exchange::Known::whole) {
        const double across = double{from.across} * r_.deviation(from.source, c), mean = by_mean(from.source, c, sign);
        if (across < double{from.value} * (e - mean)) e = mean, doubt = across;
      }
      sum.add(from, c, e, doubt);
    }
  }
  /// Of branches, with all that is far from them.
  std::vector<ShiftedSum> far_sums(const CellTransport& transport, int sign) const {
    const Row middle = middle_of(transport.leaves, sign);
    std::vector<ShiftedSum> sums;
    for (const Branch& branch : transport.branches) {
      ShiftedSum sum(channels_, middle);
      if (!sums.empty()) {
        sum = sums[branch.parent];
        sum.move(transport.branches[branch.parent].cell.local(branch.cell.centre));
      }
      for (const Exchange& from : branch.far) add(from, sign, sum);
      sums.push_back(std::move(sum));
    }
    return sums;
  }
  /// Of what is near, and 0 at least: since sum F <= 1, T e <= m + T (e - m) for any m >= 0.
  Row middle_of(std::span<const Leaf> leaves, int sign) const {
    Row sum = Row::Zero(channels_);
    double weights = 0;
    for (const Leaf& leaf : leaves)
      for (const Exchange& from : leaf.near) {
        weights += double{from.most};
        for (Index c = 0; c < channels_; ++c) sum[c] += double{from.most} * highest(from.source, c, sign);
      }
    return weights > 0 ? Row((sum / weights).cwiseMax(0.0)) : sum;
  }
  /// sign T e, at most in the leaf.
  Row highest(const CellTransport& transport, const Leaf& leaf, int sign, ShiftedSum sum) const {
    if (!leaf.near.empty()) sum.shift(middle_of(std::span(&leaf, 1), sign));
    Row near(channels_);
    Allotment allotment;
    for (Index c = 0; c < channels_; ++c) {
      allotment.clear();
      for (const Exchange& from : leaf.near) {
        const double e = highest(from.source, c, sign) - sum.middle[c];
        sum.of_b.value[c] += double{from.least} * e;
        allotment.add(e, double{from.most} - double{from.least});
      }
      near[c] = allotment.largest_sum(leaf.left);
    }
    return sum.middle + sum.of_b.everywhere(transport.cell_of(leaf)).upper + near;
  }

  std::span<const scene::SurfacePatch> patches_;
  LitRegions lit_;
  std::optional<std::vector<scene::SurfacePatch>> black_;
  Surroundings around_;
  const PolynomialField* field_;
  PointViewFactors factors_;
  LinearField B_;
  ColumnMatrix exitance_, reflectance_;
  Index elements_, channels_;
  double slack_;
  std::vector<CellTransport> transports_;
  ColumnMatrix constants_;
  ManyBounds H_, mean_H_, e_;  ///< of elements
  Residuals r_;
  ManyBounds g_;  ///< T e on nodes
  std::vector<std::vector<Cover>> covers_;
};

void require_no_place_twice(const scene::Scene& scene) {
  for (const auto& found : scene::overlaps(scene))
    if (found.twice > 0)
      throw core::InputError("bounds", scene::overlap_text(found) +
                                           ": what is seen there is not defined, and nothing can be proved; cut them, "
                                           "or leave one out");
}

Enclosure::Enclosure(const scene::Scene& scene, const RadiositySolution& solution, double max_memory, Run& run) {
  require_no_place_twice(scene);
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
