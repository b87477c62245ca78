#include "fem/bounds/error_transport.h"

#include "fem/bounds/allotment.h"

namespace interflect::fem {

using Row = Eigen::RowVectorXd;

/// sign (r + rho T e) <= this: anywhere on a node, or in the mean if r is.  T e is bounded anywhere in both: it may vary
/// as k does, and the mean of their product be more than that of their means.
double ErrorTransport::highest(const ManyBounds& r, std::uint32_t source, Index c, int sign) const {
  const double rho = r_.reflectance()(source / QuarterTree::nodes, c);
  return sign > 0 ? r.upper(source, c) + rho * Te_.upper(source, c)
                  : -(r.lower(source, c) + rho * Te_.lower(source, c));
}

/// What element j sends of e with a sign: by the mean of r, or by what it is anywhere, whichever says more.
void ErrorTransport::add(const Exchange& from, int sign, ShiftedSum& sum) const {
  sum.add_factor(from);
  for (Index c = 0; c < channels(); ++c) {
    double e = highest(r_.everywhere(), from.source, c, sign), doubt = 0;
    if (from.known == Exchange::Known::whole) {
      const double across = double{from.across} * r_.deviation()(from.source, c),
                   mean = highest(r_.mean(), from.source, c, sign);
      if (across < double{from.value} * (e - mean)) e = mean, doubt = across;
    }
    sum.add(from, c, e, doubt);
  }
}
/// Of branches, with all that is far from them.
std::vector<ShiftedSum> ErrorTransport::far_sums(const CellTransport& transport, int sign) const {
  const Row middle = middle_of(transport.leaves, sign);
  std::vector<ShiftedSum> sums;
  for (const Branch& branch : transport.branches) {
    ShiftedSum sum(channels(), middle);
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
Row ErrorTransport::middle_of(std::span<const Leaf> leaves, int sign) const {
  Row sum = Row::Zero(channels());
  double weights = 0;
  for (const Leaf& leaf : leaves)
    for (const Exchange& from : leaf.near) {
      weights += double{from.most};
      for (Index c = 0; c < channels(); ++c)
        sum[c] += double{from.most} * highest(r_.everywhere(), from.source, c, sign);
    }
  return weights > 0 ? Row((sum / weights).cwiseMax(0.0)) : sum;
}
/// sign T e, at most in the leaf.
Row ErrorTransport::highest(const CellTransport& transport, const Leaf& leaf, int sign, ShiftedSum sum) const {
  if (!leaf.near.empty()) sum.shift(middle_of(std::span(&leaf, 1), sign));
  Row near(channels());
  Allotment allotment;
  for (Index c = 0; c < channels(); ++c) {
    allotment.clear();
    for (const Exchange& from : leaf.near) {
      const double e = highest(r_.everywhere(), from.source, c, sign) - sum.middle[c];
      sum.of_b.value[c] += double{from.least} * e;
      allotment.add(e, double{from.most} - double{from.least});
    }
    near[c] = allotment.largest_sum(leaf.left);
  }
  return sum.middle + sum.of_b.everywhere(transport.cell_of(leaf)).upper + near;
}

std::vector<Bounds> ErrorTransport::over_leaves(const CellTransport& transport) const {
  const std::vector<ShiftedSum> high = far_sums(transport, 1), low = far_sums(transport, -1);
  std::vector<Bounds> out;
  for (const Leaf& leaf : transport.leaves)
    out.push_back({-highest(transport, leaf, -1, low[leaf.branch]), highest(transport, leaf, 1, high[leaf.branch])});
  return out;
}

}  // namespace interflect::fem
