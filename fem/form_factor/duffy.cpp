#include "fem/form_factor/duffy.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/log.h"
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

Duffy::Duffy(const FormFactorContext& context) : SampledBlocks(context), space_(space_of(shapes(), context.order)) {
  for (const Panel& panel : space_.panels()) bases_.emplace_back(context.order, panel.ring(), panel.normal);
  for (const int points : rule_points) rules_.emplace_back(points);
}

/// Of all functions, by the first rule that is near enough to those before it.
PairMoments Duffy::by_rules(Index i, Index j, double tolerance) const {
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
    if (block.error <= tolerance) break;
  }
  return block;
}

PairMoments Duffy::block(Index i, Index j, const PairIntegral& K) const {
  const Index functions = plane_functions(pair_degree(context(), i, j));
  // No rule would come near enough to nothing.
  if (K.value == 0) return {Moments::Zero(functions, functions), K.error * basis(i).largest() * basis(j).largest()};
  const double tolerance = context().tolerance * K.value;
  PairMoments block = by_rules(i, j, tolerance);
  if (block.error > tolerance && !told_.exchange(true))
    core::log::warning(
        "form factors by duffy: elements that nearly touch, or meet at a few degrees, miss the tolerance; analytic "
        "ones do not");
  const double K_00 = std::clamp(block.value(0, 0), 0.0, std::min(shapes()[i].area, shapes()[j].area));
  block.error = std::max(block.error, std::abs(K_00 - block.value(0, 0)));
  block.value(0, 0) = K_00;
  block.value.conservativeResize(functions, functions);
  return block;
}

}  // namespace interflect::fem
