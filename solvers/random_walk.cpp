#include "solvers/random_walk.h"

#include <algorithm>

#include "core/error.h"
#include "core/random.h"
#include "solvers/power_draw.h"
#include "solvers/sampled_rounds.h"
#include "solvers/system_check.h"

namespace interflect::solvers {
namespace {

using Row = Eigen::RowVectorXd;
using Way = RandomWalk::Way;
using Score = RandomWalk::Score;

/// The numbers of a walk: the first ones by a sequence, which may be evenly spread, all others independent.
class WalkNumbers {
 public:
  WalkNumbers(const core::SampleSequence& sequence, std::uint64_t index, core::RandomNumbers others, std::size_t first)
      : others_(others), numbers_(first) {
    sequence.point(index, numbers_);
  }
  /// Valid until the next call.
  std::span<const double> next(std::size_t count) {
    if (used_ + count > numbers_.size()) {
      numbers_.resize(std::max(numbers_.size(), count));
      used_ = numbers_.size() - count;
      for (std::size_t k = used_; k < numbers_.size(); ++k) numbers_[k] = others_.next();
    }
    used_ += count;
    return std::span(numbers_).subspan(used_ - count, count);
  }

 private:
  core::RandomNumbers others_;
  std::vector<double> numbers_;
  std::size_t used_ = 0;
};

class Walks {
 public:
  Walks(const System& system, Score score)
      : system_(system),
        score_(score),
        births_(power_of(system.K.gram(), system.e)),
        draw_(static_cast<std::size_t>(system.walks->dimensions())) {}

  /// Birth, a step, and whether to go on: what the first numbers of a walk are for.
  std::size_t first_numbers() const { return 2 + draw_; }

  /// @return  draws
  std::uint64_t shoot(WalkNumbers numbers, ColumnMatrix& sum) const {
    const auto [source, probability] = births_(numbers.next(1)[0]);
    return walk(source, system_.e.row(source) * (area(source) / probability), numbers,
                [&](Index i, const Row& carried, double score) {
                  sum.row(i) += score / area(i) * rho(i).cwiseProduct(carried);
                });
  }
  std::uint64_t gather(Index i, WalkNumbers numbers, ColumnMatrix& sum) const {
    return walk(i, rho(i), numbers, [&](Index s, const Row& carried, double score) {
      sum.row(i) += score * carried.cwiseProduct(system_.e.row(s));
    });
  }

 private:
  double area(Index a) const { return system_.K.gram()[static_cast<std::size_t>(a)]; }
  Row rho(Index a) const { return system_.R.reflectance().row(a); }

  /// From an unknown, with what it carries; hit(unknown, carried, score) at every hit, score having the mean 1.
  template <class Hit>
  std::uint64_t walk(Index from, Row carried, WalkNumbers& numbers, const Hit& hit) const {
    std::uint64_t draws = 0;
    for (Index at = from;;) {
      const std::optional<Index> next = system_.walks->from_element(at, numbers.next(draw_));
      ++draws;
      if (!next) return draws;
      at = *next;
      const Row reflected = rho(at).cwiseProduct(carried);
      const double all = carried.cwiseAbs().sum(), on = all > 0 ? reflected.cwiseAbs().sum() / all : 0;
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
};

void require_answerable(const System& system, Way way, Score score, const std::string& name) {
  const ColumnMatrix& rho = system.R.reflectance();
  if (score == Score::absorption && (rho.array() >= 1).any())
    throw core::InputError("solver '" + name + "'", "what reflects everything absorbs nothing to count: another score");
  if (way == Way::gathering && score == Score::survival && (rho.array() == 0 && system.e.array() != 0).any())
    throw core::InputError("solver '" + name + "'", "a source that reflects nothing is not found: another score");
}

}  // namespace

std::string RandomWalk::name() const {
  const char* score = score_ == Score::absorption ? "absorption" : score_ == Score::survival ? "survival" : "collision";
  return std::string(way_ == Way::shooting ? "shooting-" : "gathering-") + score;
}

SolverReport RandomWalk::advance(const System& system, SolverState& state, const StoppingRule& rule, Run& run) const {
  require_walks(system, name());
  require_solvable(system);
  require_answerable(system, way_, score_, name());
  if (!prepare(system, state)) return {.why = SolverReport::Stopped::nothing_to_do};

  const std::uint64_t starts = way_ == Way::gathering ? static_cast<std::uint64_t>(system.e.rows()) : 1;
  const std::uint64_t seed = core::derived_seed(run.seed, "random walks");
  const auto sequences = sequences_for(settings_, seed);
  const Walks walks(system, score_);
  const auto add = [&](int r, std::uint64_t begin, std::uint64_t end, ColumnMatrix& sum) {
    const core::SampleSequence& sequence = *sequences[static_cast<std::size_t>(r)];
    const auto numbers = [&](std::uint64_t index) {
      return WalkNumbers(sequence, index, {seed, static_cast<std::uint32_t>(1 + r), index}, walks.first_numbers());
    };
    std::uint64_t draws = 0;
    for (std::uint64_t k = begin; k < end; ++k)
      for (std::uint64_t i = 0; i < starts; ++i)
        draws += way_ == Way::gathering ? walks.gather(static_cast<Index>(i), numbers(i << 20 | k), sum)
                                        : walks.shoot(numbers(k), sum);
    return draws;
  };
  return sample_in_rounds(system, state, rule, settings_, {way_ == Way::gathering ? 4u : 256u, starts, add}, run);
}

}  // namespace interflect::solvers
