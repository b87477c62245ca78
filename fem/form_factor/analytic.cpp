#include "fem/form_factor/analytic.h"

#include <algorithm>

#include "fem/form_factor/hidden_exchange.h"

namespace interflect::fem {

class Analytic::Shadows final : public Occlusion {
 public:
  explicit Shadows(const Analytic& method) : method_(method), hidden_(method.shapes().plane_tolerance()) {}

  ExchangeEntry operator()(const DoubtfulPair& pair, PairCounts& counts) override {
    find_blockers(pair);
    const std::uint64_t before = hidden_.points();
    const Integral hidden = hidden_part(pair);
    ++counts.subtracted;
    counts.points += hidden_.points() - before;
    const double value = pair.unoccluded.value - hidden.value;
    return {std::max(0.0, value), 0, pair.unoccluded.error + hidden.error};
  }

 private:
  void find_blockers(const DoubtfulPair& pair) {
    found_.clear();
    method_.blockers().append_candidates(pair.shaft, pair.among, found_);
    list_.clear();
    for (const std::uint32_t k : found_) list_.push_back(&method_.blockers()[k]);
  }
  Integral hidden_part(const DoubtfulPair& pair) {
    const ElementShape &a = method_.shapes()[pair.i], &b = method_.shapes()[pair.j];
    const double tolerance = method_.context().tolerance * pair.unoccluded.value;
    if (pair.unoccluded.facing == Facing::full) return hidden_between(a, b, tolerance);
    Integral sum;
    const Pieces of_a = pieces_in_front(a, b.plane), of_b = pieces_in_front(b, a.plane);
    const double share = tolerance / static_cast<double>(of_a.count * of_b.count);
    for (std::size_t k = 0; k < of_a.count; ++k)
      for (std::size_t l = 0; l < of_b.count; ++l) {
        const Integral part = hidden_between(of_a.shape[k], of_b.shape[l], share);
        sum.value += part.value;
        sum.error += part.error;
      }
    return sum;
  }
  /// The outer element is the smaller one, as without occlusion (pair_integral.h).
  Integral hidden_between(const ElementShape& a, const ElementShape& b, double tolerance) {
    return a.radius <= b.radius ? hidden_(a, b, list_, tolerance) : hidden_(b, a, list_, tolerance);
  }

  const Analytic& method_;
  HiddenExchange hidden_;
  std::vector<std::uint32_t> found_;
  std::vector<const geometry::ConvexBlocker*> list_;
};

std::unique_ptr<PairMethod::Occlusion> Analytic::occlusion() const { return std::make_unique<Shadows>(*this); }

}  // namespace interflect::fem
