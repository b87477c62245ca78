#pragma once

#include <functional>
#include <span>
#include <vector>

#include "solvers/power_draw.h"
#include "solvers/solver.h"
#include "solvers/transition_sampler.h"
#include "solvers/walk_numbers.h"

namespace interflect::solvers {

/// A walk that is to be.
struct WalkStart {
  Index unknown;       ///< where it starts, if it gathers; those that shoot draw that
  std::uint64_t walk;  ///< whose numbers it has
};

/// Collects walks and hands them over some thousands at a time, as they are fastest.
class WalkBatch {
 public:
  /// @param walk  what they do.  @return  draws
  explicit WalkBatch(std::function<std::uint64_t(std::span<const WalkStart>)> walk) : walk_(std::move(walk)) {}
  void add(WalkStart start) {
    starts_.push_back(start);
    if (starts_.size() == at_once) finish();
  }
  /// The rest as well.  @return  draws of all so far
  std::uint64_t finish() {
    if (!starts_.empty()) draws_ += walk_(starts_);
    starts_.clear();
    return draws_;
  }

 private:
  static constexpr std::size_t at_once = 2048;
  std::function<std::uint64_t(std::span<const WalkStart>)> walk_;
  std::vector<WalkStart> starts_;
  std::uint64_t draws_ = 0;
};

/// Walks from element to element, by F_ij, that go on from j with the probability rho_j: what they score is in
/// random_walk.h.  With several columns walks are shared: they go on with the probability sum T rho / sum T of what
/// they carry, T a column, which is changed so that each has the right mean; of one column that is rho.  Walks given
/// together take each step together, so that it is drawn for all at once.
class ElementWalks {
 public:
  enum class Score { absorption, survival, collision };
  using Row = Eigen::RowVectorXd;
  using ConstRow = Eigen::Ref<const Row>;
  /// Told what a walk that started at an unknown scores, and where.
  using Scored = std::function<void(Index start, const ConstRow& score, Index at)>;

  /// The system outlives this.
  ElementWalks(const System& system, Score score);

  /// Births in proportion to power times worth, defensively (potential.h), and no longer to power alone.
  void prefer_sources(const ColumnMatrix& worth);
  /// Moreover they go on where what they carry is worth it: with the probability by which a walk is worth afterwards
  /// what one is at its birth, if that is less than 1, and no less than a tenth of rho's.
  void prefer_ways(const ColumnMatrix& worth);

  /// How many numbers are by a sequence: birth, a step, and whether to go on.
  std::size_t first_numbers() const { return 2 + draw_; }

  /// What walks say of every unknown's radiosity beyond e is added to its row.  @return  draws
  std::uint64_t shoot(std::span<const WalkStart> starts, const WalkNumbers& numbers, ColumnMatrix& sum) const;
  /// The same of walks that go on from the very point where they arrived, which the system's must have.
  std::uint64_t shoot_on(std::span<const WalkStart> starts, const WalkNumbers& numbers, ColumnMatrix& sum) const;
  /// From where they start, and of that.
  std::uint64_t gather(std::span<const WalkStart> starts, const WalkNumbers& numbers, ColumnMatrix& sum) const;
  std::uint64_t gather(std::span<const WalkStart> starts, const WalkNumbers& numbers, const Scored& scored) const;

 private:
  /// Walks under way, which have taken as many steps.
  struct Wave {
    Wave(std::span<const WalkStart> starts, const WalkNumbers& numbers, Index columns);
    std::size_t size() const { return at.size(); }
    /// But for what it carries.
    void keep(std::size_t from, std::size_t to, Index arrived) {
      start[to] = start[from], at[to] = arrived, walk_[to] = walk_[from];
      if (!point.empty()) point[to] = point[from];
    }
    void shrink(std::size_t size);
    /// The next numbers of each, `count` a walk.
    void draw(std::size_t count, std::vector<double>& u);

    std::vector<Index> start, at;
    ColumnMatrix carried;                        ///< rows beyond size() are of walks that ended
    std::vector<PointTransitions::Point> point;  ///< of those that go on from there
    std::vector<double> ways, on;                ///< numbers of a step, and of whether to go on

   private:
    WalkNumbers numbers_;
    std::vector<std::uint64_t> walk_;
    std::vector<double> first_;  ///< numbers of all that started: of no use when one of them has ended
    std::size_t used_;           ///< of those, by each
    std::size_t drawn_ = 0;      ///< of the others, by each
  };

  double area(Index a) const { return system_.K.gram()[static_cast<std::size_t>(a)]; }
  auto rho(Index a) const { return system_.R.reflectance().row(a); }
  /// @param by_rho     what of all that is carried is reflected
  /// @param by_column  what is reflected of each
  double going_on(Index at, double by_rho, const double* by_column) const;

  Wave births(std::span<const WalkStart> starts, const WalkNumbers& numbers) const;
  void step_between_elements(Wave& wave, std::span<Index> arrived) const;
  void step_between_points(Wave& wave, std::span<Index> arrived) const;

  /// The reflectance of an unknown's columns, and the reciprocal of its area.
  const double* place(Index a) const { return places_.data() + a * places_.cols(); }

  /// Until none goes on: step(wave, arrived) says where draws lead; hit(start, unknown, carried, reflected, score,
  /// columns) is told where one scores, and of the columns that it carries and would carry on, score having the mean 1.
  template <class Step, class Hit>
  std::uint64_t walk(Wave wave, const Step& step, const Hit& hit) const;
  template <class Step, class Hit, class Count>
  std::uint64_t walk(Wave wave, const Step& step, const Hit& hit, Count columns) const;
  template <class Step>
  std::uint64_t shoot_by(const Step& step, Wave wave, ColumnMatrix& sum) const;
  template <class Hit>
  std::uint64_t gather_by(std::span<const WalkStart> starts, const WalkNumbers& numbers, const Hit& hit) const;

  const System& system_;
  Score score_;
  PowerDraw births_;
  std::size_t draw_;
  ColumnMatrix places_;
  ColumnMatrix worth_;  ///< of ways, over that of a walk at its birth; empty: they go on by rho
};

}  // namespace interflect::solvers
