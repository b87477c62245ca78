#include "fem/point_view_factors.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fem/form_factor/hidden_exchange.h"
#include "fem/form_factor/moment_integrand.h"
#include "fem/form_factor/pair_integral.h"
#include "fem/form_factor/point_to_polygon.h"
#include "geometry/box.h"

namespace interflect::fem {

namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

using BlockerList = std::vector<const geometry::ConvexBlocker*>;

double largest_coordinate(const scene::Scene& scene, std::span<const scene::SurfacePatch> patches) {
  geometry::Box box = scene.box();
  for (const scene::SurfacePatch& patch : patches)
    for (const Vec3& x : patch.ring()) box.extend(x);
  return std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
}

/// An edge as a point sees it.
struct EdgeSeen {
  double distance;  ///< [m]
  double arc;       ///< bound on its length on the unit sphere, at most pi
};
EdgeSeen edge_seen(const Vec3& from, const Vec3& to) {
  const Vec3 along = to - from;
  const double square = along.squaredNorm(), t = square > 0 ? std::clamp(-along.dot(from) / square, 0.0, 1.0) : 0.0;
  const double distance = (from + t * along).norm(), length = std::sqrt(square);
  return {distance, length < pi * distance ? length / distance : pi};
}

/// What an edge adds to the error of F, over an arc.
double edge_error(const EdgeSeen& edge, double arc, double delta) {
  const double shift = delta < edge.distance ? delta / edge.distance : 1.0;
  return inv_pi * arc * (shift + 8 * eps);
}

struct Outline {
  double arc = 0, error = 0;
};
Outline outline_of(std::span<const Vec3> ring, const Vec3& eye, double delta) {
  Outline sum;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const EdgeSeen edge = edge_seen(ring[k] - eye, ring[(k + 1) % ring.size()] - eye);
    sum.arc += edge.arc;
    sum.error += edge_error(edge, edge.arc, delta);
  }
  return sum;
}

bool goes_through(const geometry::Plane& plane, std::span<const Vec3> ring) {
  double lowest = plane.distance(ring[0]), highest = lowest;
  for (const Vec3& x : ring.subspan(1)) {
    lowest = std::min(lowest, plane.distance(x));
    highest = std::max(highest, plane.distance(x));
  }
  return lowest < 0 && highest > 0;
}

/// How large a face is to an eye in its plane, which may as well be `height` off: as a part of the hemisphere, at
/// most 1.
double doubt_edge_on(std::span<const Vec3> face, const Vec3& normal, const Vec3& eye, double height) {
  bool inside = true;
  double distance = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < face.size(); ++k) {
    const Vec3 from = face[k] - eye, to = face[(k + 1) % face.size()] - eye;
    inside = inside && normal.dot(from.cross(to)) >= 0;
    distance = std::min(distance, edge_seen(from, to).distance);
  }
  return inside ? 1 : std::min(1.0, 2 * height / distance);  // as high as height / distance, as wide as all around
}

}  // namespace

/// A point that looks; with memory of its own.
class PointViewFactors::Receiver {
 public:
  Receiver(const PointViewFactors& of, const measure::PointIrradiance& at)
      : of_(of),
        at_(at),
        x_(at.position - of.shapes_.origin()),
        n_(at.normal),
        horizon_{n_, n_.dot(x_)},
        triangle_(geometry::speck(x_, n_, 8 * rounding())),
        here_(0, triangle_, n_),
        hidden_(rounding()),
        hidden_moments_(rounding()) {}

  void look(const ElementCluster& cluster, std::span<double> F, std::span<double> error) {
    std::optional<std::vector<std::uint32_t>> among;
    const auto functions = static_cast<std::size_t>(of_.functions());
    for (const Index j : cluster.elements) {
      const auto to = static_cast<std::size_t>(j);
      if (!may_see(j, error[to])) continue;
      if (!among && cluster.rectangle) among = of_.blockers_.candidates(shaft(*cluster.rectangle));
      find_blockers(j, among ? &*among : nullptr);
      error[to] = look(j, F.subspan(to * functions, functions));
    }
  }

 private:
  double rounding() const { return of_.shapes_.plane_tolerance(); }
  geometry::Shaft shaft(std::span<const Vec3> ring) const { return geometry::Shaft(triangle_, ring, rounding()); }

  /// Whether the element's side is seen and not below the horizon.  From its plane it is not; should rounding hide that
  /// the point is in front, `error` is what it would see.
  bool may_see(Index j, double& error) const {
    const ElementShape& shape = of_.shapes_[j];
    if (std::none_of(shape.ring().begin(), shape.ring().end(),
                     [&](const Vec3& p) { return horizon_.distance(p) > rounding(); }))
      return false;
    const double height = shape.plane.distance(x_), tolerance = of_.shapes_.height_tolerance(shape, x_);
    if (height > tolerance) return true;
    const bool on_it = at_.on == of_.patches_[static_cast<std::size_t>(j)].surface;
    if (height >= -tolerance && !on_it)
      error = point_to_polygon(x_ + (tolerance - height) * shape.plane.normal, n_, shape.ring());
    return false;
  }

  void find_blockers(Index j, const std::vector<std::uint32_t>* among) {
    found_.clear();
    list_.clear();
    if (!among || !among->empty()) of_.blockers_.append_candidates(shaft(of_.shapes_[j].ring()), among, found_);
    for (const std::uint32_t k : found_) list_.push_back(&of_.blockers_[k]);
  }

  /// @param out  the element's functions   @return  the error
  double look(Index j, std::span<double> out) {
    const ElementShape& shape = of_.shapes_[j];
    const bool crosses =
        std::any_of(shape.ring().begin(), shape.ring().end(), [&](const Vec3& p) { return horizon_.distance(p) < 0; });
    double whole = 0;
    const auto add = [&](const ElementShape& piece) {
      const double F = point_to_polygon_above_horizon(x_, n_, piece.ring());
      whole += F;
      out[0] += list_.empty() ? F : std::max(0.0, F - hidden_.hidden_factor(x_, n_, piece, list_));
      if (of_.order_ > 0) add_moments(j, piece, out);
    };
    if (crosses) {
      const Pieces pieces = pieces_in_front(shape, horizon_);
      for (std::size_t k = 0; k < pieces.count; ++k) add(pieces.shape[k]);
    } else {
      add(shape);
    }
    const Outline outline = outline_of(shape.ring(), x_, of_.delta_);
    double error = outline.error;
    for (const geometry::ConvexBlocker* blocker : list_)
      error += shadow_error(*blocker, shape, 0.5 * outline.arc, whole);
    out[0] = std::min(1.0, out[0]);
    return std::min(1.0, error) * (of_.order_ > 0 ? of_.bases_[static_cast<std::size_t>(j)].largest() : 1.0);
  }
  /// Of all functions but the first.
  void add_moments(Index j, const ElementShape& piece, std::span<double> out) {
    const MomentIntegrand integrand(here_, n_, of_.bases_[static_cast<std::size_t>(j)], of_.accuracy_);
    Moments seen = integrand.at_whole(x_, piece.ring());
    if (!list_.empty()) seen -= hidden_moments_.hidden_at(x_, piece, integrand, list_);
    for (std::size_t b = 1; b < out.size(); ++b) out[b] += seen(0, static_cast<Index>(b));
  }

  /// @param arc    across the element, at most
  /// @param whole  its factor if nothing hid it
  double shadow_error(const geometry::ConvexBlocker& blocker, const ElementShape& shape, double arc,
                      double whole) const {
    double error = 0;
    for (const geometry::ConvexBlocker::Edge& edge : blocker.edges()) {
      const EdgeSeen seen = edge_seen(blocker.corners()[edge.from] - x_, blocker.corners()[edge.to] - x_);
      error += edge_error(seen, std::min(seen.arc, arc), of_.delta_);
    }
    for (std::size_t f = 0; f < blocker.faces().size(); ++f) {
      const geometry::Plane& plane = blocker.planes()[f];
      if (goes_through(plane, shape.ring())) {
        const double sine = plane.normal.cross(shape.plane.normal).norm(), distance = sine * shape.plane.distance(x_);
        error += edge_error({distance, arc}, arc, of_.delta_);
      }
      if (std::abs(plane.distance(x_)) <= rounding())
        error += std::min(whole, doubt_edge_on(blocker.faces()[f], plane.normal, x_, 2 * rounding()));
    }
    return error;
  }

  const PointViewFactors& of_;
  const measure::PointIrradiance& at_;
  Vec3 x_, n_;  ///< x relative to the shapes' origin
  geometry::Plane horizon_;
  std::array<Vec3, 3> triangle_;
  PlaneBasis here_;  ///< 1
  HiddenExchange hidden_;
  HiddenExchangeOf<MomentIntegrand> hidden_moments_;
  std::vector<std::uint32_t> found_;
  BlockerList list_;
};

PointViewFactors::PointViewFactors(const scene::Scene& scene, std::span<const scene::SurfacePatch> patches, int order,
                                   double accuracy)
    : patches_(patches),
      shapes_(patches),
      clusters_(clusters_of(patches, shapes_)),
      blockers_(scene, shapes_.origin(), shapes_.plane_tolerance()),
      order_(order),
      accuracy_(accuracy),
      delta_(4 * eps * largest_coordinate(scene, patches)) {
  for (Index j = 0; order > 0 && j < elements(); ++j)
    bases_.emplace_back(order, shapes_[j].ring(), shapes_[j].plane.normal);
}

void PointViewFactors::operator()(const measure::PointIrradiance& at, std::span<double> F,
                                  std::span<double> error) const {
  std::fill(F.begin(), F.end(), 0.0);
  std::fill(error.begin(), error.end(), 0.0);
  Receiver receiver(*this, at);
  for (const ElementCluster& cluster : clusters_) receiver.look(cluster, F, error);
}

void assemble_points(const PointViewFactors& factors, std::span<const measure::PointIrradiance> points,
                     PointStore& store, Run& run) {
  std::vector<Index> missing;
  for (Index s = 0; s < static_cast<Index>(points.size()); ++s)
    if (!store.is_done(s)) missing.push_back(s);
  core::Progress::Stage stage(run.progress, "point view factors", missing.size());
  run.threads.for_blocks(static_cast<Index>(missing.size()), 1, [&](Index k, Index) {
    run.throw_if_stopped("point view factors");
    const Index s = missing[static_cast<std::size_t>(k)];
    std::vector<double> F(static_cast<std::size_t>(factors.elements() * factors.functions())),
        error(static_cast<std::size_t>(factors.elements()));
    factors(points[static_cast<std::size_t>(s)], F, error);
    store.write(s, F, error);
    stage.advance(1);
  });
}

}  // namespace interflect::fem
