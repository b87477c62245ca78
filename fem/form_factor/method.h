#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/run.h"
#include "raycast/ray_caster.h"
#include "scene/scene.h"

namespace interflect::fem {

/// Some of the elements: patches[first .. first + count) of all of them.
struct ElementBlock {
  std::span<const scene::SurfacePatch> patches;
  Index first = 0, count = 0;
};

/// One pair's exchange and what is known of its error.
struct ExchangeEntry {
  double K = 0;               ///< A_a F_ab [m²], 0 <= K <= min(A_a, A_b)
  double standard_error = 0;  ///< of what was sampled; 0 where nothing was [m²]
  double bound = 0;           ///< estimated bound on the rest: quadrature, aliasing, one view point [m²]
};

/// Where entries of K go.  A pair is written once (a <= b or as asked for); the sink keeps K symmetric.
class ExchangeSink {
 public:
  virtual ~ExchangeSink() = default;
  virtual void add(Index a, Index b, const ExchangeEntry& entry) = 0;
  /// Said once by a row method that samples: what a view from a is worth beside the other one of a pair, chosen without
  /// a look at K.
  virtual void weigh_row(Index, double) {}
};

/// Counts of what happened to the pairs of an assembly.
struct PairCounts {
  std::uint64_t facing_away = 0;  ///< proved dark by orientation
  std::uint64_t clear = 0;        ///< proved fully visible by a shaft
  std::uint64_t sampled = 0;      ///< visibility by rays
  std::uint64_t rays = 0;
  std::uint64_t subtracted = 0;  ///< what hides a part was taken out exactly
  std::uint64_t points = 0;      ///< at which that was done
  std::uint64_t clamped = 0;     ///< entries pulled back into 0 <= K <= min(A_a, A_b)
  double lost = 0;  ///< largest part of a row that its method cannot see and does not make up for, in [0, 1)
  PairCounts& operator+=(const PairCounts& o);
};

/// A way to compute form factors, picked by name.
class FormFactorMethod {
 public:
  /// What the method computes at a time, and so what `exchange` may be asked for.
  enum class Granularity : std::uint8_t {
    pair,  ///< any block: every pair (a in rows, b in columns) with a < b once
    row,   ///< all columns: every b != a, for a in rows, as seen from a; K_ab and K_ba are two views of one number
    all    ///< everything in one call, every pair a < b once
  };
  virtual ~FormFactorMethod() = default;
  virtual std::string name() const = 0;
  virtual Granularity granularity() const = 0;
  virtual int highest_order() const { return 0; }  ///< of the basis: 0 for constants only
  /// Adds entries to the sink, as the granularity says; entries that are not added are 0, exactly.  Reentrant, but for
  /// `all`, which uses the run's threads itself.  Same numbers whatever the blocks and the threads.
  virtual PairCounts exchange(const ElementBlock& rows, const ElementBlock& columns, ExchangeSink& sink,
                              const Run& run) const = 0;
  /// Seconds on one thread for everything, by a short trial: only of a method that cannot be asked for a part.
  virtual double trial(const Run&) const { return 0; }
};

/// What a method is made for; all of it outlives the method.
struct FormFactorContext {
  const scene::Scene& scene;
  std::span<const scene::SurfacePatch> patches;
  const raycast::RayCaster& rays;
  std::uint64_t seed = 1;
  double tolerance = 1e-3;   ///< relative, of the quadrature of one entry
  int visibility_rays = 16;  ///< per pair that is neither clear nor dark; at least 4
  int resolution = 256;      ///< cells across the top of a hemicube, or across a plane
  int order = 0;             ///< of the polynomials on an element: a method's highest_order at most
  /// Of elements, where they differ, 1 .. order: entries of two functions are wanted up to the higher degree of their
  /// elements, and are left 0 beyond.  Empty: `order`, all.
  std::span<const int> degrees{};
  std::uint64_t samples =
      0;  ///< of a Monte Carlo method: a pair, a row, or in all; 0: as many as the tolerance asks for
  double visibility_error = 0;  ///< standard error of a pair's visible part that rays are added up to; 0: none are
  /// Rays are those of specular/light_caster.h: by mirrors elements may see what is behind them, and themselves.
  bool by_mirrors = false;
};

/// @throws core::InputError with the names known
std::unique_ptr<FormFactorMethod> make_form_factor_method(const std::string& name, const FormFactorContext& context);
std::vector<std::string> form_factor_names();

/// What a method's accuracy depends on beside its tolerance.
enum class Setting : std::uint8_t { tolerance, rays, samples, resolution };
/// @throws core::InputError with the names known
Setting setting_of(const std::string& name);

}  // namespace interflect::fem
