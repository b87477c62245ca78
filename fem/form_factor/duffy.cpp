#include "fem/form_factor/duffy.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/log.h"
#include "fem/form_factor/sampled_pair.h"
#include "fem/form_factor/seen_block.h"
#include "fem/galerkin.h"

namespace interflect::fem {
namespace {

Space space_of(const ElementShapes& shapes, int order) {
  std::vector<Panel> panels;
  for (Index i = 0; i < shapes.size(); ++i)
    panels.push_back({shapes[i].corner, shapes[i].corners, shapes[i].plane.normal, shapes[i].area});
  return {std::move(panels), order};
}

/// What is left after two changes from rule to rule.  Those of a rule that converges fall by a factor, which the last
/// two tell; either may be small by chance, when signs change.
double left_after(double before, double last) {
  constexpr double slowest = .9, fastest = .2;
  if (!(before > 0)) return last;
  const double factor = std::clamp(last / before, fastest, slowest);
  return std::max({last, last * factor / (1 - factor), fastest * before});
}

/// A rule that counts the nodes it is asked for.
class CountedRule final : public PairRule {
 public:
  CountedRule(const PairRule& rule, std::size_t& count) : rule_(rule), count_(count) {}
  void for_nodes(const Panel& a, const Panel& b, const Visit& visit) const override {
    rule_.for_nodes(a, b, [&](const PairNode& node) {
      ++count_;
      visit(node);
    });
  }

 private:
  const PairRule& rule_;
  std::size_t& count_;
};

/// Of a rule, beyond which no finer one is tried: about a tenth of a second.
constexpr std::size_t most_nodes = 2'000'000;

}  // namespace

class Duffy::Work final : public PairWork {
 public:
  explicit Work(const Duffy& method) : method_(method) {}

  void clear(Index i, Index j, const PairIntegral& K, ExchangeSink& sink) override {
    method_.write(i, j, method_.block(i, j, K), 0, sink);
  }
  void doubtful(const DoubtfulPair& pair, ExchangeSink& sink, PairCounts& counts) override {
    const SampledVisibility V = sampled(pair, method_.shapes(), method_.visibility_, workspace_, counts);
    const PairMoments all = method_.block(pair.i, pair.j, pair.unoccluded);
    const double K_00 = all.value(0, 0);
    const PairMoments seen =
        seen_block(all, K_00, V, workspace_, method_.basis(pair.i), method_.basis(pair.j), method_.shapes().origin());
    method_.write(pair.i, pair.j, seen, K_00 * V.standard_error, sink);
  }

 private:
  const Duffy& method_;
  VisibilitySampler::Workspace workspace_;
};

Duffy::Duffy(const FormFactorContext& context)
    : PairMethod(context),
      space_(space_of(shapes(), context.order)),
      visibility_(context.patches, context.rays, context.visibility_rays, context.seed, context.visibility_error) {
  for (const Panel& panel : space_.panels()) bases_.emplace_back(context.order, panel.ring(), panel.normal);
  for (const int points : rule_points) rules_.emplace_back(points);
}

std::unique_ptr<PairWork> Duffy::work() const { return std::make_unique<Work>(*this); }

PairMoments Duffy::block(Index i, Index j, const PairIntegral& K) const {
  PairMoments block{galerkin_block(space_, i, j, SpaceKernel(), rules_.front()), 0};
  double change = std::numeric_limits<double>::infinity();
  std::size_t nodes = 0;
  for (std::size_t k = 1; k < rules_.size() && (k <= 2 || nodes < most_nodes); ++k) {
    nodes = 0;
    Moments finer = galerkin_block(space_, i, j, SpaceKernel(), CountedRule(rules_[k], nodes));
    const double before = std::exchange(change, (finer - block.value).cwiseAbs().maxCoeff());
    block.value = std::move(finer);
    if (k == 1) continue;
    block.error = left_after(before, change);
    if (block.error <= context().tolerance * K.value) break;
  }
  if (block.error > context().tolerance * K.value && !told_.exchange(true))
    core::log::warning(
        "form factors by duffy: elements that nearly touch, or meet at a few degrees, miss the tolerance; analytic "
        "ones do not");
  block.value(0, 0) = std::clamp(block.value(0, 0), 0.0, std::min(shapes()[i].area, shapes()[j].area));
  return block;
}

void Duffy::write(Index i, Index j, const PairMoments& block, double standard_error, ExchangeSink& sink) const {
  const Index stride = block.value.rows();
  Index functions = stride;  // those that the degrees of the pair want
  if (const std::span<const int> degrees = context().degrees; !degrees.empty())
    functions = plane_functions(std::max(degrees[static_cast<std::size_t>(i)], degrees[static_cast<std::size_t>(j)]));
  for (Index a = 0; a < functions; ++a)
    for (Index b = 0; b < functions; ++b)
      sink.add(i * stride + a, j * stride + b, {block.value(a, b), standard_error, block.error});
}

}  // namespace interflect::fem
