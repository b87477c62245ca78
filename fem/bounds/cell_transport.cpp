#include "fem/bounds/cell_transport.h"

#include <algorithm>
#include <cmath>

#include "core/ordered_sum.h"
#include "fem/bounds/allotment.h"
#include "scene/place.h"

namespace interflect::fem {
namespace {

using Row = Eigen::RowVectorXd;

/// The number with half of the weight on either side; 0 of none.
double weighted_median(std::vector<std::pair<double, double>>& value_and_weight) {
  std::sort(value_and_weight.begin(), value_and_weight.end());
  double all = 0;
  for (const auto& [value, weight] : value_and_weight) all += weight;
  double sum = 0;
  for (const auto& [value, weight] : value_and_weight) {
    sum += weight;
    if (2 * sum >= all) return value;
  }
  return 0;
}

Exchange exchange(const PartSeen& part) {
  const FactorRange& f = part.factor;
  return {
      static_cast<std::uint32_t>(part.element * QuarterTree::nodes + part.node),
      f.smooth && part.whole ? Exchange::Known::whole : Exchange::Known::parts,
      static_cast<float>(f.value),
      static_cast<float>(f.remainder),
      static_cast<float>(f.across),
      static_cast<float>(f.least),
      static_cast<float>(f.most),
      {static_cast<float>(f.derivatives[0]), static_cast<float>(f.derivatives[1]), static_cast<float>(f.derivatives[2]),
       static_cast<float>(f.derivatives[3]), static_cast<float>(f.derivatives[4])}};
}

/// Parts of the same node as one, in the order of the nodes.
std::vector<Exchange> merged(std::vector<Exchange> all) {
  std::stable_sort(all.begin(), all.end(), [](const Exchange& a, const Exchange& b) { return a.source < b.source; });
  std::vector<Exchange> out;
  for (const Exchange& from : all) {
    if (out.empty() || out.back().source != from.source || from.known == Exchange::Known::whole) {
      out.push_back(from);
      continue;
    }
    Exchange& sum = out.back();
    sum.value += from.value;
    sum.remainder += from.remainder;
    sum.least += from.least;
    sum.most += from.most;
    for (std::size_t k = 0; k < sum.derivatives.size(); ++k) sum.derivatives[k] += from.derivatives[k];
  }
  out.shrink_to_fit();
  return out;
}
std::vector<Exchange> exchanges(std::span<const PartSeen> parts) {
  std::vector<Exchange> all;
  for (const PartSeen& part : parts) all.push_back(exchange(part));
  return merged(std::move(all));
}

/// How much a sum may be off or vary over a cell.
double known(const SmoothSum& sum, double radius) {
  return core::ordered_sum(sum.doubt) + radius * sum.derivatives.topRows<2>().colwise().norm().sum();
}

class Examination {
 public:
  Examination(const LinearField& b, bool closed, const Cell& whole, int deepest)
      : b_(b), closed_(closed), whole_(whole), deepest_(deepest) {}

  CellTransport operator()(const Surroundings& around) {
    CellView view(around, whole_);
    middle_ = closed_ ? median(view) : Row(Row::Zero(b_.channels()));
    ShiftedSum before(b_.channels(), middle_);
    add(view.far(), before);
    view.refine([&](const PartSeen& part) { return worth(part); }, 0.1 * known(before.of_b, whole_.radius),
                32 + static_cast<std::size_t>(b_.elements()) / 8);
    ShiftedSum far(b_.channels(), middle_);
    add(view.far(), far);
    tolerance_ = 0.2 * known(far.of_b, whole_.radius);
    examine(view, whole_, far, 0, 0);
    return std::move(out_);
  }

 private:
  Row median(const CellView& view) const {
    Row m(b_.channels());
    std::vector<std::pair<double, double>> values;
    for (Index c = 0; c < b_.channels(); ++c) {
      values.clear();
      for (const PartSeen& part : view.near()) values.emplace_back(on(part, c).mean, part.factor.most);
      if (values.empty())
        for (const PartSeen& part : view.far()) values.emplace_back(on(part, c).mean, part.factor.remainder);
      m[c] = weighted_median(values);
    }
    return m;
  }
  LinearField::OnPart on(const PartSeen& part, Index channel) const {
    return b_.on(part.element, part.ring.ring(), channel);
  }
  double worth(const PartSeen& part) const {
    double sum = 0;
    for (Index c = 0; c < b_.channels(); ++c) {
      const LinearField::OnPart b = on(part, c);
      sum += std::max(b.upper - middle_[c], middle_[c] - b.lower);
    }
    return sum;
  }
  void add(std::span<const PartSeen> parts, ShiftedSum& sum) const {
    for (const PartSeen& part : parts) {
      sum.add_factor(part.factor);
      for (Index c = 0; c < b_.channels(); ++c) {
        const LinearField::OnPart b = on(part, c);
        sum.add(part.factor, c, b.mean, part.factor.across * b.deviation);
      }
    }
  }

  /// @param far  about the cell's centre, all that is far from it
  void examine(const CellView& view, const Cell& cell, const ShiftedSum& far, std::size_t parent, int depth) {
    constexpr double left_enough = 0.1;
    const std::size_t branch = out_.branches.size();
    out_.branches.push_back({cell, parent, exchanges(view.far())});
    Leaf leaf = leaf_of(view, cell, far);
    const double doubt = (leaf.mean.upper - leaf.mean.lower).sum() / 2 - core::ordered_sum(far.of_b.doubt);
    if (view.near().empty() || (doubt <= tolerance_ && leaf.left <= left_enough) || depth == deepest_) {
      leaf.branch = branch;
      leaf.near = exchanges(view.near());
      out_.leaves.push_back(std::move(leaf));
      return;
    }
    for (const std::array<Vec3, 4>& quarter : scene::quarters_of(cell.ring)) {
      const Cell part = cell_of(std::span(quarter).first(cell.ring.size()), cell);
      const CellView closer(view, part);
      ShiftedSum sum = far;
      sum.move(cell.local(part.centre));
      add(closer.far(), sum);
      examine(closer, part, sum, branch, depth + 1);
    }
  }

  Leaf leaf_of(const CellView& view, const Cell& cell, ShiftedSum far) const {
    Row m = middle_;
    if (closed_ && !view.near().empty()) {
      m = median(view);
      far.shift(m);
    }
    double least = 0;
    for (const PartSeen& part : view.near()) least += part.factor.least;
    far.of_b.value += m;
    const auto left = [&](const Bounds& far_factors) { return std::max(0.0, 1 - far_factors.lower[0] - least); };
    const double left_everywhere = left(far.of_factors.everywhere(cell)),
                 left_in_the_mean = left(far.of_factors.mean(cell));
    const Bounds near = of_near(view, m, left_everywhere);
    SmoothSum polynomial = far.of_b;
    polynomial.value += 0.5 * (near.lower + near.upper);
    polynomial.doubt += 0.5 * (near.upper - near.lower);
    return {0,
            cell.area / whole_.area,
            polynomial.everywhere(cell),
            far.of_b.mean(cell) + of_near(view, m, left_in_the_mean),
            polynomial,
            {},
            left_everywhere};
  }

  /// @param left  what may be seen of near parts beyond the least
  Bounds of_near(const CellView& view, const Row& m, double left) const {
    Bounds out = Bounds::zero(b_.channels());
    Allotment high, low;
    for (Index c = 0; c < b_.channels(); ++c) {
      high.clear();
      low.clear();
      for (const PartSeen& part : view.near()) {
        const LinearField::OnPart b = on(part, c);
        const double upper = b.upper - m[c], lower = b.lower - m[c], room = part.factor.most - part.factor.least;
        out.upper[c] += part.factor.least * upper;
        out.lower[c] += part.factor.least * lower;
        high.add(upper, room);
        low.add(-lower, room);
      }
      out.upper[c] += high.largest_sum(left);
      out.lower[c] -= low.largest_sum(left);
    }
    return out;
  }

  const LinearField& b_;
  bool closed_;
  const Cell& whole_;
  int deepest_;
  Row middle_;
  double tolerance_ = 0;
  CellTransport out_;
};

}  // namespace

void ShiftedSum::shift(const Row& m) {
  const Row change = middle - m;
  of_b.value += change * of_factors.value[0];
  of_b.doubt += change.cwiseAbs() * of_factors.doubt[0];
  of_b.derivatives += of_factors.derivatives * change;
  middle = m;
}

void SmoothSum::move(const Vec2& way) {
  const double x = way.x(), y = way.y();
  value += derivatives.row(0) * x + derivatives.row(1) * y +
           0.5 * (derivatives.row(2) * (x * x) + derivatives.row(3) * (2 * x * y) + derivatives.row(4) * (y * y));
  derivatives.row(0) += derivatives.row(2) * x + derivatives.row(3) * y;
  derivatives.row(1) += derivatives.row(3) * x + derivatives.row(4) * y;
}

void SmoothSum::scale(const Row& by) {
  value = value.cwiseProduct(by);
  doubt = doubt.cwiseProduct(by);
  derivatives *= by.asDiagonal();
}

/// Of the linear part at the corners; of the quadratic one by its curvatures.
Bounds SmoothSum::everywhere(const Cell& cell) const {
  Bounds change = Bounds::none(value.size());
  for (const Vec3& corner : cell.ring) {
    const Row at = cell.local(corner).transpose() * derivatives.topRows<2>();
    change.widen({at, at});
  }
  for (Index c = 0; c < value.size(); ++c) {
    const double ss = derivatives(2, c), st = derivatives(3, c), tt = derivatives(4, c);
    const double middle = 0.5 * (ss + tt), spread = std::hypot(0.5 * (ss - tt), st),
                 half_square = 0.5 * cell.radius * cell.radius;
    change.lower[c] += half_square * std::min(0.0, middle - spread);
    change.upper[c] += half_square * std::max(0.0, middle + spread);
  }
  change.lower += value - doubt;
  change.upper += value + doubt;
  return change;
}

Bounds SmoothSum::mean(const Cell& cell) const {
  const auto& [ss, st, tt] = cell.second_moments;
  const Row curved = value + 0.5 * (ss * derivatives.row(2) + 2 * st * derivatives.row(3) + tt * derivatives.row(4));
  return {curved - doubt, curved + doubt};
}

CellTransport transport_over(const Surroundings& around, const Cell& cell, const LinearField& b, bool closed,
                             int deepest) {
  return Examination(b, closed, cell, deepest)(around);
}

std::size_t bytes_of(const CellTransport& transport) {
  std::size_t exchanges = 0;
  for (const Branch& branch : transport.branches) exchanges += branch.far.capacity();
  for (const Leaf& leaf : transport.leaves) exchanges += leaf.near.capacity();
  return exchanges * sizeof(Exchange) + transport.branches.size() * sizeof(Branch) +
         transport.leaves.size() * sizeof(Leaf);
}

}  // namespace interflect::fem
