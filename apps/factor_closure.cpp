#include "apps/factor_closure.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/estimate.h"
#include "fem/closure.h"
#include "fem/environment_column.h"
#include "fem/operator/dense_symmetric.h"
#include "results/factor_pairs.h"

namespace interflect::apps {
namespace {

using results::FactorStore;
using results::FactorStoreWriter;

constexpr std::uint64_t rays_an_element = 1296, least_rays = 100'000;

/// Of every element; what masks cover sees its mask alone.  None in a closed scene.
std::optional<fem::EnvironmentColumn> environment_of(const FactorRepair& repair, Run& run) {
  const auto elements = repair.request.elements.seeing();
  const std::uint64_t rays =
      std::max<std::uint64_t>(rays_an_element, least_rays / std::max<std::size_t>(elements.size(), 1));
  fem::EnvironmentColumn column =
      fem::cast_environment_column(repair.request.geometry.scene, elements, repair.rays, rays, run);
  if (fem::is_closed(column)) return std::nullopt;
  column.factor.resize(repair.request.size(), 0.0);
  column.standard_error.resize(repair.request.size(), 0.0);
  return column;
}

/// With the stated errors as what entries may move by.
void read_into(fem::DenseSymmetric& K, const FactorStore& store) {
  results::for_pairs(store, [&](Index a, Index b, double entry, double error) {
    K.add(a, b, {entry, error / normal_95, 0});
  });
}

/// sum_j |K'_ij - K_ij| / A_i
std::vector<double> row_changes(const fem::DenseSymmetric& repaired, const FactorStore& store) {
  std::vector<double> changes(static_cast<std::size_t>(store.size()), 0);
  results::for_pairs(store, [&](Index a, Index b, double entry, double) {
    const double change = std::abs(repaired.entry(a, b) - entry);
    changes[static_cast<std::size_t>(a)] += change;
    if (a != b) changes[static_cast<std::size_t>(b)] += change;
  });
  for (std::size_t a = 0; a < changes.size(); ++a) changes[a] /= store.elements().area[a];
  return changes;
}

/// F_i,env and its errors: the rays' 95 % and what it moved, or, as it is 1 less the row, the row's.
void set_environment(results::FactorElements& about, const fem::EnvironmentColumn& found,
                     std::span<const double> repaired, const FactorStore& store) {
  for (std::size_t i = 0; i < repaired.size(); ++i) {
    const double by_rays = normal_95 * found.standard_error[i] + std::abs(repaired[i] - found.factor[i]);
    about.environment.push_back(repaired[i]);
    about.environment_error.push_back(std::min(by_rays, store.row_error()[i] + about.closure_change[i]));
  }
}

void copy_points(const FactorStore& from, FactorStoreWriter& to) {
  const results::PointFactors points = from.point_factors();
  std::vector<double> F(static_cast<std::size_t>(from.size())), error(F);
  for (Index s = 0; s < std::ssize(points.points); ++s) {
    if (to.is_point_done(s)) continue;
    points.rows(s, F, error);
    to.write_point(s, F, error);
  }
}

}  // namespace

void copy_tiles(const FactorStore& from, FactorStoreWriter& to, const TileChange& change) {
  std::vector<double> tile, tile_error;
  const Index n = to.size();
  for (Index I = 0; I < to.tiles_across(); ++I) {
    const Index rows = to.count(I);
    std::vector<double> K(static_cast<std::size_t>(rows * n)), error(K);
    from.read_rows(to.first(I), rows, K, error);
    for (Index J = I; J < to.tiles_across(); ++J) {
      if (to.is_done(I, J)) continue;
      tile.clear();
      tile_error.clear();
      for (Index a = 0; a < rows; ++a) {
        const Index begin = a * n + to.first(J), end = begin + to.count(J);
        tile.insert(tile.end(), K.begin() + begin, K.begin() + end);
        tile_error.insert(tile_error.end(), error.begin() + begin, error.begin() + end);
      }
      change(to.first(I), to.first(J), to.count(J), tile, tile_error);
      to.write(I, J, tile, tile_error);
    }
  }
}

void write_repaired(const std::filesystem::path& file, const results::FactorStoreKey& key, const FactorRepair& repair,
                    Run& run) {
  std::optional<FactorStore> store(file);
  const std::optional<fem::EnvironmentColumn> environment = environment_of(repair, run);
  fem::DenseSymmetric K(store->elements().area);
  read_into(K, *store);
  fem::ClosureSettings settings;
  settings.method = repair.closure;
  settings.row_bound = store->row_error();
  settings.environment = environment ? &*environment : nullptr;
  const fem::ClosureReport report = fem::restore_closure(K, run, settings);
  results::FactorElements about = repair.request.about;
  about.closure_change = row_changes(K, *store);
  if (environment) set_environment(about, *environment, report.environment, *store);
  FactorStoreWriter writer(file, about, key, store->tile(), repair.request.points);
  copy_points(*store, writer);
  copy_tiles(*store, writer, [&](Index a, Index b, Index columns, std::span<double> entries, std::span<double> errors) {
    run.throw_if_stopped("closure");
    for (std::size_t k = 0; k < entries.size(); ++k) {
      const Index at = static_cast<Index>(k);
      const double repaired = K.entry(a + at / columns, b + at % columns);
      errors[k] += std::abs(repaired - entries[k]);
      entries[k] = repaired;
    }
  });
  store.reset();  // the file that it reads is about to be replaced
  writer.finish();
}

}  // namespace interflect::apps
