#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "core/sample_sequence.h"
#include "solvers/transport_operator.h"

namespace interflect::solvers {

/// An estimate of what one bounce of a power reflects, R K G^-1 P, by samples.  Powers are G b: of constants, [W | lm].
class SampledBounce {
 public:
  virtual ~SampledBounce() = default;
  /// By samples first .. first + count of a sequence; what they bring is added, times `weight`.
  virtual void add(const core::SampleSequence& sequence, std::uint64_t first, std::uint64_t count, double weight,
                   ColumnMatrix& reflected) const = 0;
  /// What samples should be in proportion to, of each column: how large that is which is sent.
  virtual Eigen::RowVectorXd sizes() const = 0;
  /// The same, where parts of what is sent are worth more than others.
  virtual Eigen::RowVectorXd worths() const { return sizes(); }
  /// How many samples it takes for what they bring to be no larger than what was sent: noise must not feed itself.
  virtual std::uint64_t least_samples() const { return 1; }
};

/// How a solver samples: of a power, which outlives it.
using BounceFactory = std::function<std::unique_ptr<SampledBounce>(const ColumnMatrix& power)>;

/// The bounces of one replication.  Each has a randomisation of its own: points of one sequence know of each other, and
/// what is sent was found by earlier ones, so that means would be off.
class Bounces {
 public:
  /// The sequence outlives this.
  Bounces(BounceFactory of, const core::SampleSequence& sequence) : of_(std::move(of)), sequence_(sequence) {}

  std::uint64_t draws() const { return draws_; }

  /// What one bounce of a power reflects.
  ColumnMatrix bounced(const ColumnMatrix& power, std::uint64_t samples);
  /// G (b - e) by bounces of bounces, `samples` for what is emitted, and for all that follows as many as its worth asks
  /// for, between a half and four times what its size does.  Of what is less than one sample carries all or nothing
  /// goes on, by chance, so that means are right.
  /// @param between  called before every bounce: what it throws ends it
  ColumnMatrix incremental(
      const ColumnMatrix& emitted, std::uint64_t samples, const std::function<void()>& between = [] {});

 private:
  double number();
  void bounced(const SampledBounce& bounce, std::uint64_t samples, ColumnMatrix& reflected);

  BounceFactory of_;
  const core::SampleSequence& sequence_;
  std::uint64_t bounces_ = 0, draws_ = 0;
};

}  // namespace interflect::solvers
