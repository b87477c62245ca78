#include "fem/form_factor/row_method.h"

#include <algorithm>
#include <cmath>

#include "core/random.h"

namespace interflect::fem {

namespace {

constexpr double deviations = 3;  ///< of aliasing, which a bound allows for

}  // namespace

/// Of one thread.
struct RowMethod::Memory {
  explicit Memory(const RowMethod& method) : sight(method.sight()), workspace(method.proximity_) {}

  std::unique_ptr<Sight> sight;
  ProximityError::Workspace workspace;
  SeenItems seen;
  std::vector<ProximityError::Item> proximity;
};

RowMethod::RowMethod(const FormFactorContext& context)
    : seed_(core::derived_seed(context.seed, "azimuth")),
      shapes_(context.patches),
      scene_(context.scene, context.patches, shapes_),
      proximity_(scene_, even_resolution(context.resolution)) {}

void RowMethod::look(Index element, Memory& memory) const {
  const ElementShape& shape = shapes_[element];
  core::RandomNumbers random(seed_, 0, static_cast<std::uint64_t>(element));
  const Eye eye = eye_at(shape.centroid, shape.plane.normal, 0.5 * pi * random.next());
  memory.sight->look(scene_, eye, element, memory.seen);
  proximity_.estimate(eye, element, memory.workspace, memory.proximity);
}

ExchangeEntry RowMethod::entry(Index a, Index b, const Memory& memory, PairCounts& counts) const {
  const auto item = static_cast<std::size_t>(b);
  const double area = shapes_[a].area, most = std::min(area, shapes_[b].area), visible = memory.seen.visible[item];
  const ProximityError::Item& proximity = memory.proximity[item];
  double aliasing = deviations * std::sqrt(memory.seen.border[item] / 17);
  if (visible == 0) aliasing = std::min(aliasing, proximity.unoccluded);  // no more can have been missed
  const double K = area * visible, bound = area * (aliasing + proximity.error + memory.seen.beyond[item]);
  counts.clamped += K > most;
  return {std::min(K, most), 0, std::min(bound, most)};
}

PairCounts RowMethod::exchange(const ElementBlock& rows, const ElementBlock& columns, ExchangeSink& sink,
                               const Run& run) const {
  PairCounts counts;
  Memory memory(*this);
  for (Index a = rows.first; a < rows.first + rows.count; ++a) {
    run.throw_if_stopped("form factors");
    look(a, memory);
    counts.lost = std::max(counts.lost, lost());
    for (Index b = columns.first; b < columns.first + columns.count; ++b) {
      if (a == b) continue;
      const ExchangeEntry found = entry(a, b, memory, counts);
      if (found.K > 0 || found.bound > 0) sink.add(a, b, found);
    }
  }
  return counts;
}

int even_resolution(int asked) { return std::max(2, asked + asked % 2); }

}  // namespace interflect::fem
