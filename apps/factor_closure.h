#pragma once

#include <filesystem>
#include <functional>
#include <span>

#include "apps/factor_request.h"
#include "raycast/ray_caster.h"

namespace interflect::apps {

/// Changes a tile's numbers [m²]: those of elements a .. and b .., row by row.
using TileChange = std::function<void(Index a, Index b, Index columns, std::span<double> K, std::span<double> error)>;
inline const TileChange as_they_are = [](Index, Index, Index, std::span<double>, std::span<double>) {};

/// Every tile of a store that the other has not yet.
void copy_tiles(const results::FactorStore& from, results::FactorStoreWriter& to, const TileChange& change);

struct FactorRepair {
  std::string closure;  ///< fem::closure_names
  const FactorRequest& request;
  const raycast::RayCaster& rays;
};

/// Replaces a finished store by one of the same factors, repaired (fem/closure.h): entries are weighed by their own
/// errors, and each error grows by what its entry changed.  Of an open scene it has the environment's column too, whose
/// errors are those of its row, if these are smaller than its own.  `file` is the store of before until the new one is
/// finished, which an interrupted run goes on with.
/// @throws core::InputError  as restore_closure, with the store as it was
void write_repaired(const std::filesystem::path& file, const results::FactorStoreKey& key, const FactorRepair& repair,
                    Run& run);

}  // namespace interflect::apps
