#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "fem/form_factor/method.h"
#include "fem/row_tally.h"

namespace interflect::fem {

/// Sums of the errors of form factors, row by row (row_tally.h), of what passes through to another sink:
///
///   e_a = sum_b (bound_ab + 1.96 standard_error_ab) / A_a     a bound on sum_b |dF_ab|: guaranteed nowhere, 95 % an
///                                                             entry where sampled
class RowErrors final : public ExchangeSink {
 public:
  RowErrors(ExchangeSink& sink, std::span<const double> areas);

  void add(Index a, Index b, const ExchangeEntry& entry) override;

  double of(Index a) const { return tally_.of(a); }
  std::vector<double> all() const { return tally_.all(); }
  /// From now on only these rows count, from 0: what others are known for stays.
  void count_afresh(std::span<const Index> rows);

 private:
  ExchangeSink& sink_;
  RowTally tally_;
  std::vector<std::uint8_t> counts_;  ///< rows that count
};

/// What the bounds of a method's entries are beyond the tolerance that it was asked for, row by row:
///
///   e_a = sum_b max(0, bound_ab - tolerance K_ab) / A_a
///
/// Next to nothing of a method that meets it: what pairs that are hidden in part may be off by is mostly relative to
/// what they would be unhidden.  A comparison an entry tells.
class BeyondTolerance final : public ExchangeSink {
 public:
  BeyondTolerance(ExchangeSink& sink, std::span<const double> areas, double tolerance)
      : sink_(sink), tolerance_(tolerance), tally_(areas) {}

  void add(Index a, Index b, const ExchangeEntry& entry) override;

  std::vector<double> all() const { return tally_.all(); }

 private:
  ExchangeSink& sink_;
  double tolerance_;
  RowTally tally_;
};

/// The relative tolerance of entries with which rows mostly meet theirs: errors come out far smaller than what entries
/// may have, and many entries have none.
/// @param pass  0 for the first, and so on: a quarter of the one before
double entry_tolerance(double of_rows, int pass = 0);

constexpr int most_passes = 6;

/// Of an entry of a row, in a matrix of so many elements: all that are below it make up a quarter of what the row may
/// err [m²].
double negligible_error(double tolerance, double area, Index elements);

struct ToleranceReport {
  PairCounts pairs;
  std::vector<double> row_errors;  ///< e_a
  int passes = 0;                  ///< of the method: one, and one for each time that rows had to be done again
  bool met = false;                ///< max_a e_a <= tolerance
};

using MethodMaker = std::function<std::unique_ptr<FormFactorMethod>(double relative_tolerance)>;

/// Where entries are computed to, as `until_rows_meet` drives it.
class RowAssembly {
 public:
  virtual ~RowAssembly() = default;
  virtual void everything(const FormFactorMethod& method) = 0;
  virtual void again(const FormFactorMethod& method, std::span<const Index> rows) = 0;
  virtual std::vector<double> row_errors() const = 0;
  virtual PairCounts counts() const = 0;
};
/// Computes everything, and again the rows whose errors are above the tolerance, to a quarter each time, in
/// `most_passes` passes at most.
ToleranceReport until_rows_meet(double tolerance, const MethodMaker& make, RowAssembly& assembly);

/// All entries with max_a e_a <= tolerance.
///
/// Entries are first computed to a relative tolerance that makes rows meet it (sum_b F_ab <= 1).  Rows that do not,
/// because some of their entries' errors came out larger than asked for, are done again to a quarter, and so on; what
/// they have in common with others counts there as before, which is cautious.  Only pair methods can be asked for rows
/// again; of others the report says what came out.
/// @param make  the method to a relative tolerance
/// @throws core::Interrupted
ToleranceReport assemble_to_tolerance(const MethodMaker& make, double tolerance,
                                      std::span<const scene::SurfacePatch> patches, ExchangeSink& sink, Run& run);

}  // namespace interflect::fem
