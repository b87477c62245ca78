#pragma once

#include <vector>

#include "fem/form_factor/method.h"

namespace interflect::fem {

/// What row methods write: K_ab as seen from a, and as seen from b, until both are there.  12 N² bytes.
///
/// Two views of one number with errors e_a, e_b (noise and bound together) become
///
///   K = w v_a + (1 - w) v_b,   w = e_b² / (e_a² + e_b²)
///
/// which is the least noisy mean of independent ones; but w = weight_a / (weight_a + weight_b) where both rows have
/// been given weights, since errors that are estimated from the same few hits as K would favour the view that is too
/// low.  The bound of the mean is the mean of the bounds, but where nothing was sampled at least half of what the views
/// disagree by.
class TwoViews final : public ExchangeSink {
 public:
  explicit TwoViews(Index elements);
  /// The view from a; threads may add at the same time as long as no (a, b) is added twice.
  void add(Index a, Index b, const ExchangeEntry& entry) override;
  void weigh_row(Index a, double weight) override { weights_[static_cast<std::size_t>(a)] = weight; }
  /// Both views of a pair, joined; symmetric in a and b.  Of an element that sees itself the one that there is.
  ExchangeEntry joined(Index a, Index b) const;

 private:
  struct View {
    float K = 0, standard_error = 0, bound = 0;
  };
  const View& view(Index a, Index b) const { return views_[static_cast<std::size_t>(a * elements_ + b)]; }

  Index elements_;
  std::vector<View> views_;
  std::vector<double> weights_;  ///< by row; 0: by the errors
};

}  // namespace interflect::fem
