#include "montecarlo/light/light_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace interflect::montecarlo {
namespace {

constexpr int deepest_by_cost = 40;  ///< below it nodes are halved, which ends within 64
constexpr int bins = 12;
constexpr double rounding = 1e-9;  ///< of cosines: what is zero by less may not be
constexpr double least_cosine = 1e-6;
constexpr double least_share = 0x1p-26;  ///< of a child that may give something: rounding shall not lose it

double angle_of(double cosine) { return std::acos(std::clamp(cosine, -1., 1.)); }
double sine_of(double cosine) { return std::sqrt(std::max(0., (1 - cosine) * (1 + cosine))); }

/// An angle by its cosine and sine, 0 .. pi.
struct Angle {
  double cosine, sine;
  /// this - other, or 0.
  Angle less(const Angle& other) const {
    if (cosine >= other.cosine) return {1, 0};
    return {cosine * other.cosine + sine * other.sine, sine * other.cosine - cosine * other.sine};
  }
};

/// Solid angle of what a cone of normals sends where, weighed by the cosine beyond it [Conty Estevez and Kulla, 4.4].
double orientation_measure(const LightExtent& e) {
  const double o = angle_of(e.cos_normals), w = std::min(o + angle_of(std::max(0., e.cos_emission)), pi);
  return 2 * pi * (1 - std::cos(o)) +
         pi / 2 * (2 * w * std::sin(o) - std::cos(o - 2 * w) - 2 * o * std::sin(o) + std::cos(o));
}

double cost(const LightExtent& e) {
  const Vec3 s = e.box.sizes();
  // Boxes of lights in a row or a plane have no surface: an edge counts too.
  const double size = s.x() * s.y() + s.y() * s.z() + s.z() * s.x() + 1e-3 * s.squaredNorm();
  return e.intensity * orientation_measure(e) * size;
}

}  // namespace

LightExtent united(const LightExtent& a, const LightExtent& b) {
  if (a.intensity == 0) return b;
  if (b.intensity == 0) return a;
  LightExtent all{
      a.box.merged(b.box),       a.axis, 1, std::min(a.cos_emission, b.cos_emission), a.intensity + b.intensity,
      a.by_cosine && b.by_cosine};
  const double angle_a = angle_of(a.cos_normals), angle_b = angle_of(b.cos_normals),
               between = angle_of(a.axis.dot(b.axis));
  const auto& [wide, narrow, of_wide, of_narrow] =
      angle_a >= angle_b ? std::tie(a, b, angle_a, angle_b) : std::tie(b, a, angle_b, angle_a);
  all.axis = wide.axis;
  all.cos_normals = wide.cos_normals;
  if (between + of_narrow <= of_wide) return all;
  const double half = (of_wide + between + of_narrow) / 2;
  if (half >= pi) {
    all.cos_normals = -1;
    return all;
  }
  // The wide one's axis, turned towards the other's.
  Vec3 beside = narrow.axis - narrow.axis.dot(wide.axis) * wide.axis;
  if (!(beside.norm() > 1e-9)) {
    all.cos_normals = between < 1 ? std::cos(std::min(pi, std::max(of_wide, between + of_narrow))) : -1;
    return all;
  }
  const double turn = half - of_wide;
  all.axis = (std::cos(turn) * wide.axis + std::sin(turn) * beside.normalized()).normalized();
  all.cos_normals = std::cos(half);
  return all;
}

struct LightTree::Build {
  std::span<const LightExtent> lights;
  LightTree& tree;

  LightExtent all(std::span<const std::uint32_t> of) const {
    LightExtent sum = lights[of[0]];
    for (const std::uint32_t l : of.subspan(1)) sum = united(sum, lights[l]);
    return sum;
  }

  static int bin_of(double at, double low, double high) {
    return std::min(bins - 1, static_cast<int>(bins * ((at - low) / (high - low))));
  }

  /// How many of them, put in order, go to the first child.
  std::size_t split(std::span<std::uint32_t> of, int depth) const {
    geometry::Box centres;
    for (const std::uint32_t l : of) centres.extend(Vec3(lights[l].box.center()));
    const Vec3 sizes = centres.sizes();
    double best = std::numeric_limits<double>::infinity();
    int best_axis = -1, best_bin = 0;
    for (int axis = 0; axis < 3 && depth < deepest_by_cost; ++axis) {
      if (!(sizes[axis] > 0)) continue;
      const double low = centres.min()[axis], high = centres.max()[axis];
      std::array<LightExtent, bins> bin;
      for (const std::uint32_t l : of) {
        LightExtent& at = bin[static_cast<std::size_t>(bin_of(lights[l].box.center()[axis], low, high))];
        at = united(at, lights[l]);
      }
      // Long boxes are cut across.
      const double stretched = sizes.maxCoeff() / sizes[axis];
      for (int cut = 1; cut < bins; ++cut) {
        LightExtent before, after;
        for (int b = 0; b < bins; ++b)
          (b < cut ? before : after) = united(b < cut ? before : after, bin[static_cast<std::size_t>(b)]);
        if (before.intensity == 0 || after.intensity == 0) continue;
        if (const double c = stretched * (cost(before) + cost(after)); c < best)
          best = c, best_axis = axis, best_bin = cut;
      }
    }
    if (best_axis >= 0) {
      const double low = centres.min()[best_axis], high = centres.max()[best_axis];
      const auto middle = std::partition(of.begin(), of.end(), [&](std::uint32_t l) {
        return bin_of(lights[l].box.center()[best_axis], low, high) < best_bin;
      });
      const auto first = static_cast<std::size_t>(middle - of.begin());
      if (first > 0 && first < of.size()) return first;
    }
    Index longest = 0;
    sizes.maxCoeff(&longest);
    const auto half = of.begin() + static_cast<std::ptrdiff_t>(of.size() / 2);
    std::nth_element(of.begin(), half, of.end(), [&](std::uint32_t a, std::uint32_t b) {
      const double at_a = lights[a].box.center()[longest], at_b = lights[b].box.center()[longest];
      return at_a < at_b || (at_a == at_b && a < b);
    });
    return of.size() / 2;
  }

  void add(std::span<std::uint32_t> of, std::uint64_t way, int depth) {
    const LightExtent e = all(of);
    const auto at = static_cast<std::uint32_t>(tree.nodes_.size());
    const double diagonal = e.box.diagonal().squaredNorm();
    tree.nodes_.push_back({e.box.center(), e.axis, std::sqrt(diagonal / 4), diagonal / 4, e.cos_normals,
                           sine_of(e.cos_normals), e.cos_emission, e.intensity, e.by_cosine, 0, of[0]});
    tree.depth_ = std::max(tree.depth_, depth);
    if (of.size() == 1) {
      tree.way_to_[of[0]] = way;
      tree.depth_of_[of[0]] = static_cast<std::uint8_t>(depth);
      return;
    }
    const std::size_t first = split(of, depth);
    add(of.first(first), way, depth + 1);
    tree.nodes_[at].second = static_cast<std::uint32_t>(tree.nodes_.size());
    add(of.subspan(first), way | std::uint64_t{1} << depth, depth + 1);
  }
};

LightTree::LightTree(std::span<const LightExtent> lights) : way_to_(lights.size()), depth_of_(lights.size()) {
  if (lights.empty()) return;
  std::vector<std::uint32_t> order(lights.size());
  std::iota(order.begin(), order.end(), 0u);
  nodes_.reserve(2 * lights.size());
  Build{lights, *this}.add(order, 0, 0);
}

/// A node as it is seen from a place.
struct LightTree::Seen {
  bool within;            ///< its sphere: all ways are possible
  double over;            ///< I / max(d², h²)
  Angle spread;           ///< that its sphere fills
  Angle leaves, arrives;  ///< of the way between the centres with its axis, and with the normal of the place
};

double LightTree::importance(const Node& node, const Place& at, const Seen& seen) {
  if (seen.within) return seen.over;
  double cosines = 1;
  if (node.cos_normals > -1) {
    const Angle beyond = seen.leaves.less({node.cos_normals, node.sin_normals}).less(seen.spread);
    if (beyond.cosine < node.cos_emission - rounding) return 0;
    if (node.by_cosine) cosines = std::max(beyond.cosine, least_cosine);
  }
  if (!at.normal.isZero(0)) {
    const Angle least = seen.arrives.less(seen.spread);
    if (least.cosine < -rounding) return 0;
    cosines *= std::max(least.cosine, least_cosine);
  }
  return seen.over * cosines;
}

/// Of both at once, since roots and quotients are what takes its time.
std::array<double, 2> LightTree::importances(const Node& a, const Node& b, const Place& at) {
  using Both = Eigen::Array2d;
  const Vec3 from_a = at.position - a.centre, from_b = at.position - b.centre;
  const Both square(from_a.squaredNorm(), from_b.squaredNorm()), half2(a.half2, b.half2);
  const Both over = Both(a.intensity, b.intensity) / square.max(half2).max(0x1p-900);
  const Both d = square.sqrt(), sine_u = Both(a.half, b.half) / d, cosine_u = (1 - sine_u * sine_u).sqrt();
  const auto cosine = [&](double of_a, double of_b) -> Both { return (Both(of_a, of_b) / d).max(-1.).min(1.); };
  const auto sine = [](const Both& c) -> Both { return ((1 - c) * (1 + c)).max(0.).sqrt(); };
  const Both leaves = cosine(a.axis.dot(from_a), b.axis.dot(from_b)),
             arrives = cosine(-at.normal.dot(from_a), -at.normal.dot(from_b));
  const Both sine_leaves = sine(leaves), sine_arrives = sine(arrives);
  const auto seen = [&](Index k) -> Seen {
    return {!(square[k] > half2[k]),
            over[k],
            {cosine_u[k], sine_u[k]},
            {leaves[k], sine_leaves[k]},
            {arrives[k], sine_arrives[k]}};
  };
  return {importance(a, at, seen(0)), importance(b, at, seen(1))};
}

/// Of the two children, what the first is picked with.
double LightTree::first_share(std::uint32_t node, const Place& at) const {
  const auto [first, second] = importances(nodes_[node + 1], nodes_[nodes_[node].second], at);
  if (!(first + second > 0)) return .5;  // where none gives anything, any will do
  const double share = first / (first + second);
  return first > 0 && second > 0 ? std::clamp(share, least_share, 1 - least_share) : share;
}

LightTree::Picked LightTree::pick(const Place& at, double u) const {
  std::uint32_t node = 0;
  double probability = 1;
  while (nodes_[node].second != 0) {
    const double first = first_share(node, at);
    if (u < first) {
      u /= first;
      probability *= first;
      ++node;
    } else {
      u = (u - first) / (1 - first);
      probability *= 1 - first;
      node = nodes_[node].second;
    }
    u = std::min(u, 1 - 0x1p-53);
  }
  return {nodes_[node].light, probability};
}

double LightTree::probability(std::uint32_t light, const Place& at) const {
  std::uint32_t node = 0;
  double probability = 1;
  for (int depth = 0; depth < depth_of_[light]; ++depth) {
    const double first = first_share(node, at);
    const bool second = way_to_[light] >> depth & 1;
    probability *= second ? 1 - first : first;
    node = second ? nodes_[node].second : node + 1;
  }
  return probability;
}

}  // namespace interflect::montecarlo
