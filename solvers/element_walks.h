#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/random.h"
#include "core/sample_sequence.h"
#include "solvers/power_draw.h"
#include "solvers/solver.h"
#include "solvers/transition_sampler.h"

namespace interflect::solvers {

/// The numbers of a walk: the first ones by a sequence, which may be evenly spread, all others independent.
class WalkNumbers {
 public:
  WalkNumbers(const core::SampleSequence& sequence, std::uint64_t index, core::RandomNumbers others, std::size_t first)
      : others_(others), numbers_(first) {
    sequence.point(index, numbers_);
  }
  /// Valid until the next call.
  std::span<const double> next(std::size_t count);

 private:
  core::RandomNumbers others_;
  std::vector<double> numbers_;
  std::size_t used_ = 0;
};

/// Those of the walks of all replications.
class WalkSequences {
 public:
  /// @param first  how many numbers of a walk are by the sequence
  WalkSequences(const SolverSettings& settings, std::uint64_t seed, std::size_t first);
  /// Of walk k of a replication, or of the walk k that starts at an unknown.  Beyond 2^20 walks an unknown some of two
  /// unknowns have the same numbers: each has the right mean all the same.
  WalkNumbers operator()(int replication, std::uint64_t k, Index unknown = 0) const;

 private:
  std::uint64_t seed_;
  std::size_t first_;
  std::vector<std::unique_ptr<core::SampleSequence>> sequences_;
};

/// Walks from element to element, by F_ij, that go on from j with the probability rho_j: what they score is in
/// random_walk.h.  With several columns walks are shared: they go on with the probability sum T rho / sum T of what they
/// carry, T a column, which is changed so that each has the right mean; of one column that is rho.
class ElementWalks {
  /// Of draws that lead from element to element.
  auto between_elements(WalkNumbers& numbers) const {
    return [this, &numbers](Index from) { return system_.walks->from_element(from, numbers.next(draw_)); };
  }

 public:
  enum class Score { absorption, survival, collision };
  /// The system outlives this.
  ElementWalks(const System& system, Score score);

  /// Births in proportion to power times worth, defensively (potential.h), and no longer to power alone.
  void prefer_sources(const ColumnMatrix& worth);
  /// Moreover they go on where what they carry is worth it: with the probability by which a walk is worth afterwards what one
  /// is at its birth, if that is less than 1, and no less than a tenth of rho's.
  void prefer_ways(const ColumnMatrix& worth);

  /// How many numbers are by a sequence: birth, a step, and whether to go on.
  std::size_t first_numbers() const { return 2 + draw_; }

  /// What a walk says of every unknown's radiosity beyond e is added to its row.  @return  draws
  std::uint64_t shoot(WalkNumbers numbers, ColumnMatrix& sum) const;
  /// The same of a walk that goes on from the very point where it arrived, which walks must have.
  std::uint64_t shoot_on(WalkNumbers numbers, ColumnMatrix& sum) const;
  /// From i, of i's.
  std::uint64_t gather(Index i, WalkNumbers numbers, ColumnMatrix& sum) const {
    return gather(i, numbers, [&](const Eigen::RowVectorXd& scored, Index) { sum.row(i) += scored; });
  }
  /// From i; at(scores so far, an unknown that scores), after each.
  template <class At>
  std::uint64_t gather(Index i, WalkNumbers& numbers, const At& at) const {
    return walk(i, rho(i), numbers, between_elements(numbers), [&](Index s, const Row& carried, double score) {
      at(Row(score * carried.cwiseProduct(system_.e.row(s))), s);
    });
  }

 private:
  using Row = Eigen::RowVectorXd;
  double area(Index a) const { return system_.K.gram()[static_cast<std::size_t>(a)]; }
  Row rho(Index a) const { return system_.R.reflectance().row(a); }
  double going_on(Index at, const Row& carried, const Row& reflected) const;

  template <class Next>
  std::uint64_t shoot_by(const Next& next, WalkNumbers& numbers, ColumnMatrix& sum) const;

  /// From an unknown, with what it carries, next(unknown) being where a draw leads; hit(unknown, carried, score) where it scores, score having the mean 1.
  template <class Next, class Hit>
  std::uint64_t walk(Index from, Row carried, WalkNumbers& numbers, const Next& next, const Hit& hit) const {
    std::uint64_t draws = 0;
    for (Index at = from;;) {
      const std::optional<Index> arrived = next(at);
      ++draws;
      if (!arrived) return draws;
      at = *arrived;
      const Row reflected = rho(at).cwiseProduct(carried);
      const double on = going_on(at, carried, reflected);
      const bool survives = numbers.next(1)[0] < on;
      if (score_ == Score::collision)
        hit(at, carried, 1);
      else if (survives == (score_ == Score::survival))
        hit(at, carried, 1 / (survives ? on : 1 - on));
      if (!survives) return draws;
      carried = reflected / on;
    }
  }

  const System& system_;
  Score score_;
  PowerDraw births_;
  std::size_t draw_;
  ColumnMatrix worth_;  ///< of ways, over that of a walk at its birth; empty: they go on by rho
};

}  // namespace interflect::solvers
