#include "fem/radiosity_operator.h"

#include <algorithm>
#include <optional>

#include "core/estimate.h"
#include "fem/assembly.h"
#include "fem/operator/dense_symmetric.h"
#include "fem/operator/sparse_symmetric.h"
#include "fem/row_errors.h"
#include "fem/space/polynomials.h"
#include "fem/specular/specular_chains.h"

namespace interflect::fem {
namespace {

std::vector<double> areas_of(std::span<const scene::SurfacePatch> patches) {
  std::vector<double> areas;
  for (const scene::SurfacePatch& patch : patches) areas.push_back(patch.area);
  return areas;
}

/// What a source of entries says beside them.
struct Filled {
  PairCounts pairs;
  std::vector<double> row_errors;  ///< e_a of row_errors.h; empty: not counted
  bool met = true;
};

/// Blocks, whose first entries are those of constants.
class BlockSink final : public ExchangeSink {
 public:
  BlockSink(ExchangeSink& constants, ExchangeSink& blocks, Index functions)
      : constants_(constants), blocks_(blocks), functions_(functions) {}
  void add(Index a, Index b, const ExchangeEntry& entry) override {
    blocks_.add(a, b, entry);
    if (a % functions_ == 0 && b % functions_ == 0) constants_.add(a / functions_, b / functions_, entry);
  }
  Index functions() const { return functions_; }

 private:
  ExchangeSink &constants_, &blocks_;
  Index functions_;
};

/// K of polynomials and, of its first functions, of constants: empty.
struct PolynomialOperator {
  explicit PolynomialOperator(std::span<const scene::SurfacePatch> patches, int order)
      : functions(plane_functions(order)), K(std::make_unique<DenseSymmetric>(areas_of(patches))) {
    std::vector<double> gram;
    for (const scene::SurfacePatch& patch : patches)
      gram.insert(gram.end(), static_cast<std::size_t>(functions), patch.area);
    blocks = std::make_unique<DenseSymmetric>(std::move(gram), functions);
  }
  /// @param constants  what K gets passes through it
  BlockSink sink(ExchangeSink& constants) { return {constants, *blocks, functions}; }

  Index functions;
  std::unique_ptr<DenseSymmetric> K, blocks;
};

/// Elements in another order than that of the sink behind.
class Reordered final : public ExchangeSink {
 public:
  /// @param element  of the sink behind, per element
  Reordered(ExchangeSink& behind, std::span<const Index> element, Index functions)
      : behind_(behind), element_(element), functions_(functions) {}
  void add(Index a, Index b, const ExchangeEntry& entry) override { behind_.add(there(a), there(b), entry); }

 private:
  Index there(Index unknown) const {
    return element_[static_cast<std::size_t>(unknown / functions_)] * functions_ + unknown % functions_;
  }
  ExchangeSink& behind_;
  std::span<const Index> element_;
  Index functions_;
};

/// All entries into a sink, from wherever settings say.
class Source {
 public:
  Source(const scene::Scene& scene, std::span<const scene::SurfacePatch> patches, const raycast::RayCaster& rays,
         const RadiositySettings& settings, std::span<const int> degrees, Run& run)
      : scene_(scene), patches_(patches), rays_(rays), settings_(settings), degrees_(degrees), run_(run) {}

  Filled fill(ExchangeSink& sink) const {
    if (settings_.row_tolerance > 0 && !settings_.stored_factors) return to_tolerance(sink);
    if (settings_.closure == "none" && !settings_.stored_factors) return {everything(sink), {}, true};
    const std::vector<double> areas = areas_of(patches_);
    RowErrors errors(sink, areas);
    const PairCounts pairs = everything(errors);
    Filled filled{pairs, errors.all(), true};
    if (settings_.row_tolerance > 0)
      filled.met = *std::max_element(filled.row_errors.begin(), filled.row_errors.end()) <= settings_.row_tolerance;
    return filled;
  }

 private:
  std::unique_ptr<FormFactorMethod> method(double relative_tolerance) const {
    FormFactorContext context = form_factor_context(scene_, patches_, rays_, settings_, run_.seed);
    context.tolerance = relative_tolerance;
    context.degrees = degrees_;
    auto method = make_form_factor_method(settings_.form_factors, context);
    require_memory(scene_, static_cast<double>(patches_.size()), settings_, method->granularity());
    return method;
  }
  Filled to_tolerance(ExchangeSink& sink) const {
    const auto make = [&](double relative) { return method(relative); };
    const ToleranceReport report = assemble_to_tolerance(make, settings_.row_tolerance, patches_, sink, run_);
    return {report.pairs, report.row_errors, report.met};
  }
  PairCounts everything(ExchangeSink& sink) const {
    if (!settings_.stored_factors) return assemble(*method(settings_.quadrature_tolerance), patches_, sink, run_);
    settings_.stored_factors(scene_, patches_, sink);
    return {};
  }

  const scene::Scene& scene_;
  std::span<const scene::SurfacePatch> patches_;
  const raycast::RayCaster& rays_;
  const RadiositySettings& settings_;
  std::span<const int> degrees_;
  Run& run_;
};

/// What is left of rows' errors without 1.96 standard errors of each entry.
std::vector<double> without_noise(std::vector<double> row_errors, const SymmetricOperator& K, const Run& run) {
  if (!K.has_errors()) return row_errors;
  const solvers::ColumnMatrix noise = K.sums_by_row(run, 1, [](const StoredPair& p, solvers::ColumnMatrix& sums) {
    sums(p.a, 0) += p.standard_error;
    if (p.a != p.b) sums(p.b, 0) += p.standard_error;
  });
  for (std::size_t a = 0; a < row_errors.size(); ++a)
    row_errors[a] = std::max(0.0, row_errors[a] - normal_95 * noise(static_cast<Index>(a), 0) / K.gram()[a]);
  return row_errors;
}

/// Elements that were there before, then those that are new.
struct KeptFirst {
  std::vector<Index> order;
  Index kept;
};
KeptFirst kept_first(std::span<const Index> same_as) {
  KeptFirst elements;
  for (std::size_t i = 0; i < same_as.size(); ++i)
    if (same_as[i] >= 0) elements.order.push_back(static_cast<Index>(i));
  elements.kept = std::ssize(elements.order);
  for (std::size_t i = 0; i < same_as.size(); ++i)
    if (same_as[i] < 0) elements.order.push_back(static_cast<Index>(i));
  return elements;
}

/// Blocks of pairs that were there before, without noise.
void copy_kept(const SymmetricOperator& before, std::span<const Index> same_as, const KeptFirst& elements,
               BlockSink& sink, Run& run) {
  const Index f = sink.functions();
  run.threads.for_blocks(elements.kept, 1, [&](Index k, Index) {
    const Index i = elements.order[static_cast<std::size_t>(k)], was_i = same_as[static_cast<std::size_t>(i)];
    for (Index l = k + 1; l < elements.kept; ++l) {
      const Index j = elements.order[static_cast<std::size_t>(l)], was_j = same_as[static_cast<std::size_t>(j)];
      for (Index a = 0; a < f; ++a)
        for (Index b = 0; b < f; ++b) sink.add(i * f + a, j * f + b, {before.entry(was_i * f + a, was_j * f + b)});
    }
  });
}

/// Counts what entries are beyond their tolerance on their way.  Not of pictures, which heed none: their bounds are the
/// worst that a cell may do, some hundred times what cells do together, which row sums tell where they are known.
class CountedBeyond {
 public:
  CountedBeyond(ExchangeSink& to, std::span<const double> areas, const RadiositySettings& settings) : to_(to) {
    if (setting_of(settings.form_factors) != Setting::resolution)
      beyond_.emplace(to, areas, settings.quadrature_tolerance);
  }
  ExchangeSink& sink() { return beyond_ ? *beyond_ : to_; }
  std::vector<double> rows() const { return beyond_ ? beyond_->all() : std::vector<double>(); }

 private:
  ExchangeSink& to_;
  std::optional<BeyondTolerance> beyond_;
};

/// What pairs that are new add to what rows had before, which is cautious: some of those pairs are gone.
std::vector<double> beyond_tolerance(std::span<const double> before, std::span<const Index> same_as,
                                     std::vector<double> of_new) {
  for (std::size_t i = 0; i < of_new.size(); ++i)
    if (same_as[i] >= 0) of_new[i] += before[static_cast<std::size_t>(same_as[i])];
  return of_new;
}

}  // namespace

FormFactorContext form_factor_context(const scene::Scene& scene, std::span<const scene::SurfacePatch> patches,
                                      const raycast::RayCaster& rays, const RadiositySettings& settings,
                                      std::uint64_t seed) {
  FormFactorContext context{scene, patches, rays, seed, settings.quadrature_tolerance, settings.visibility_rays};
  context.resolution = settings.resolution;
  context.order = settings.order;
  context.samples = settings.samples;
  context.visibility_error = settings.visibility_error;
  context.by_mirrors = any_smooth(scene).has_value();
  return context;
}

RadiosityOperator assemble_operator(const scene::Scene& scene, std::span<const scene::SurfacePatch> patches,
                                    const raycast::RayCaster& rays, const RadiositySettings& settings, Run& run,
                                    std::span<const int> degrees) {
  const Source source(scene, patches, rays, settings, degrees, run);
  RadiosityOperator out;
  Filled filled;
  const std::vector<double> areas = areas_of(patches);
  if (settings.order > 0) {
    PolynomialOperator polynomials(patches, settings.order);
    CountedBeyond constants(*polynomials.K, areas, settings);
    BlockSink sink = polynomials.sink(constants.sink());
    filled = source.fill(sink);
    out.beyond_tolerance = constants.rows();
    out.K = std::move(polynomials.K);
    out.blocks = std::move(polynomials.blocks);
  } else if (settings.drop_below > 0) {
    SparseAssembly assembly(areas, settings.drop_below);
    CountedBeyond counted(assembly, areas, settings);
    filled = source.fill(counted.sink());
    out.beyond_tolerance = counted.rows();
    out.K = assembly.packed(run);
  } else {
    auto K = std::make_unique<DenseSymmetric>(areas);
    CountedBeyond counted(*K, areas, settings);
    filled = source.fill(counted.sink());
    out.beyond_tolerance = counted.rows();
    out.K = std::move(K);
  }
  out.pairs = filled.pairs;
  out.tolerance_met = filled.met;
  if (filled.row_errors.empty()) return out;
  out.largest_row_error = *std::max_element(filled.row_errors.begin(), filled.row_errors.end());
  out.row_bound = without_noise(std::move(filled.row_errors), *out.K, run);
  return out;
}

RadiosityOperator refined_operator(const RadiosityOperator& before, std::span<const Index> same_as,
                                   std::span<const int> degrees, const scene::Scene& scene,
                                   std::span<const scene::SurfacePatch> patches, const raycast::RayCaster& rays,
                                   const RadiositySettings& settings, Run& run) {
  const std::vector<double> areas = areas_of(patches);
  PolynomialOperator polynomials(patches, settings.order);
  CountedBeyond constants(*polynomials.K, areas, settings);
  BlockSink sink = polynomials.sink(constants.sink());
  const KeptFirst elements = kept_first(same_as);
  std::vector<scene::SurfacePatch> reordered;
  std::vector<int> reordered_degrees;
  for (const Index i : elements.order) {
    reordered.push_back(patches[static_cast<std::size_t>(i)]);
    reordered_degrees.push_back(degrees[static_cast<std::size_t>(i)]);
  }
  copy_kept(*before.blocks, same_as, elements, sink, run);
  FormFactorContext context = form_factor_context(scene, reordered, rays, settings, run.seed);
  context.degrees = reordered_degrees;
  const auto method = make_form_factor_method(settings.form_factors, context);
  require_memory(scene, static_cast<double>(patches.size()), settings, method->granularity());
  Reordered to(sink, elements.order, polynomials.functions);
  RadiosityOperator out;
  out.pairs = before.pairs;
  out.pairs += assemble_new(*method, reordered, elements.kept, to, run);
  out.beyond_tolerance = beyond_tolerance(before.beyond_tolerance, same_as, constants.rows());
  out.K = std::move(polynomials.K);
  out.blocks = std::move(polynomials.blocks);
  return out;
}

}  // namespace interflect::fem
