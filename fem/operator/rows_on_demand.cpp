#include "fem/operator/rows_on_demand.h"

#include <algorithm>

#include "core/error.h"

namespace interflect::fem {

/// Entries of one column, from either end of a pair.
class RowsOnDemand::Sink final : public ExchangeSink {
 public:
  explicit Sink(Column& column) : column_(column) {}
  void add(Index a, Index b, const ExchangeEntry& entry) override {
    const auto other = static_cast<std::size_t>(a == column_.of ? b : a);
    column_.K[other] = entry.K;
    column_.standard_error[other] = entry.standard_error;
    column_.bound[other] = entry.bound;
  }

 private:
  Column& column_;
};

RowsOnDemand::RowsOnDemand(std::span<const scene::SurfacePatch> patches, const FormFactorMethod& method, const Run& run)
    : patches_(patches),
      method_(method),
      run_(run),
      layout_(solvers::Layout::uniform(static_cast<Index>(patches.size()), 1)),
      self_(patches.size(), 0) {
  if (method.granularity() == FormFactorMethod::Granularity::all)
    throw core::InputError("form factors by " + method.name(),
                           "they come all at once: a method that can be asked for one element's is expected");
  for (const scene::SurfacePatch& patch : patches) areas_.push_back(patch.area);
}

PairCounts RowsOnDemand::pairs_of(Index i, Index begin, Index end, ExchangeSink& sink) const {
  const Run whole = run_.to_the_end();  // half a column is none
  const ElementBlock alone{patches_, i, 1};
  if (!symmetric()) return method_.exchange(alone, {patches_, begin, end - begin}, sink, whole);
  PairCounts counts;
  if (begin < i) counts += method_.exchange({patches_, begin, std::min(end, i) - begin}, alone, sink, whole);
  const Index above = std::max(begin, i + 1);
  if (above < end) counts += method_.exchange(alone, {patches_, above, end - above}, sink, whole);
  return counts;
}

void RowsOnDemand::compute(Index i) const {
  last_.of = i;
  for (std::vector<double>* each : {&last_.K, &last_.standard_error, &last_.bound}) each->assign(patches_.size(), 0);
  Sink sink(last_);
  const auto n = static_cast<Index>(patches_.size());
  constexpr Index together = 256;  // elements that a thread takes: less is not worth waking another
  const Index block = symmetric() ? together : std::max<Index>(n, 1);
  std::mutex counting;
  run_.threads.for_blocks(n, block, [&](Index begin, Index end) {
    const PairCounts counts = pairs_of(i, begin, end, sink);
    const std::scoped_lock lock(counting);
    counts_ += counts;
  });
  ++evaluated_;
}

void RowsOnDemand::rows(Index first, Index count, solvers::Columns out) const {
  const std::scoped_lock lock(mutex_);
  for (Index k = 0; k < count; ++k) {
    compute(first + k);
    out.row(k) = Eigen::Map<const Eigen::RowVectorXd>(last_.K.data(), out.cols());
  }
}

void RowsOnDemand::apply(solvers::ConstColumns b, solvers::Columns out, Run&) const {
  const std::scoped_lock lock(mutex_);
  out.setZero();
  for (Index i = 0; i < b.rows(); ++i) {
    if (b.row(i).isZero(0)) continue;
    compute(i);
    out += Eigen::Map<const Eigen::VectorXd>(last_.K.data(), out.rows()) * b.row(i);
  }
}

Index RowsOnDemand::evaluated() const {
  const std::scoped_lock lock(mutex_);
  return evaluated_;
}

}  // namespace interflect::fem
