#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "geometry/box_tree.h"
#include "scene/inspection_parts.h"

namespace interflect::scene {
namespace {

struct Edge {
  std::uint32_t facet;
  Vec3 from, to;
};

/// A stretch of an edge, in metres from its start, along which another facet's edge runs, or another facet lies.
struct Cover {
  double begin, end;
  const Edge* by;  ///< none where the stretch lies on a facet
  bool same_direction;
};

/// The stretch of an edge [m from its start] that lies on a facet: in its plane (within the tolerance), and there
/// between its three edges (without one: along its border runs an edge of its own); empty if none.
std::pair<double, double> stretch_on(const Facet& facet, const Edge& edge, double tolerance) {
  const double length = (edge.to - edge.from).norm();
  double begin = 0, end = length;
  const auto height = [&](const Vec3& x) { return std::abs(facet.normal.dot(x - facet.corner[0])); };
  if (height(edge.from) > tolerance || height(edge.to) > tolerance) return {0, 0};
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3& corner = facet.corner[k];
    const Vec3 inward = facet.normal.cross(facet.corner[(k + 1) % 3] - corner);
    const double from = inward.dot(edge.from - corner), to = inward.dot(edge.to - corner);
    if (from < 0 && to < 0) return {0, 0};
    if (from < 0) begin = std::max(begin, length * from / (from - to));
    if (to < 0) end = std::min(end, length * from / (from - to));
  }
  return {begin, end};
}

class EdgeInspection {
 public:
  EdgeInspection(const Scene& scene, double tolerance, Inspection& inspection)
      : scene_(scene), tolerance_(tolerance), inspection_(inspection) {
    for (std::uint32_t f = 0; f < scene.facets.size(); ++f)
      for (std::size_t k = 0; k < 3; ++k) {
        const Edge edge{f, scene.facets[f].corner[k], scene.facets[f].corner[(k + 1) % 3]};
        if ((edge.to - edge.from).norm() > tolerance) edges_.push_back(edge);
      }
    for (const Edge& edge : edges_) boxes_.push_back(box_of(edge));
    tree_ = geometry::BoxTree(boxes_);
    std::vector<geometry::Box> facet_boxes;
    for (const Facet& facet : scene.facets) {
      facet_boxes.emplace_back(facet.corner[0]);
      for (const Vec3& corner : facet.corner) facet_boxes.back().extend(corner);
    }
    facet_tree_ = geometry::BoxTree(facet_boxes);
  }

  void run() {
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      std::vector<Cover> covers = covers_of(i);
      if (!cover_whole(edges_[i], covers)) add_facets_under(i, covers);
      judge(edges_[i], covers);
    }
    for (const auto& [pair, fault] : opposed_)
      inspection_.findings.push_back({Inspection::Finding::Kind::inconsistent_normals, name(pair.first),
                                      name(pair.second), fault.where, fault.length});
  }

 private:
  geometry::Box box_of(const Edge& e) const {
    geometry::Box box(e.from.cwiseMin(e.to), e.from.cwiseMax(e.to));
    box.min().array() -= tolerance_;
    box.max().array() += tolerance_;
    return box;
  }
  const std::string& name(std::uint32_t surface) const { return scene_.surfaces[surface].name; }
  std::uint32_t surface_of(const Edge& e) const { return scene_.facets[e.facet].surface.value; }
  bool one_sided(const Edge& e) const { return scene_.material(scene_.facets[e.facet].surface).sides == Sides::front; }

  /// Whether nothing of the edge is left open.
  bool cover_whole(const Edge& e, std::vector<Cover>& covers) const {
    std::sort(covers.begin(), covers.end(), [](const Cover& a, const Cover& b) { return a.begin < b.begin; });
    double reached = 0;
    for (const Cover& c : covers)
      if (c.begin <= reached + tolerance_) reached = std::max(reached, c.end);
    return reached >= (e.to - e.from).norm() - tolerance_;
  }

  /// Adds the stretches that lie on other facets than those whose edges are known to run along it.
  void add_facets_under(std::size_t i, std::vector<Cover>& covers) const {
    const auto visit = [&](std::uint32_t f) {
      const auto runs_along = [f](const Cover& c) { return c.by && c.by->facet == f; };
      if (f == edges_[i].facet || std::any_of(covers.begin(), covers.end(), runs_along)) return;
      const auto [begin, end] = stretch_on(scene_.facets[f], edges_[i], tolerance_);
      if (end - begin > tolerance_) covers.push_back({begin, end, nullptr, false});
    };
    facet_tree_.traverse([&](const geometry::Box& box) { return box.intersects(boxes_[i]); }, visit);
  }

  std::vector<Cover> covers_of(std::size_t i) const {
    std::vector<Cover> covers;
    const Edge& e = edges_[i];
    const double length = (e.to - e.from).norm();
    const Vec3 along = (e.to - e.from) / length;
    const auto visit = [&](std::uint32_t j) {
      const Edge& other = edges_[j];
      if (other.facet == e.facet || !boxes_[i].intersects(boxes_[j])) return;
      const double t0 = along.dot(other.from - e.from), t1 = along.dot(other.to - e.from);
      const double begin = std::max(0.0, std::min(t0, t1)), end = std::min(length, std::max(t0, t1));
      if (end - begin <= tolerance_) return;
      const auto aside = [&](double t) {  // distance between the edges at t along this one
        const Vec3 there = other.from + (t - t0) / (t1 - t0) * (other.to - other.from);
        return (there - (e.from + t * along)).norm();
      };
      if (aside(begin) <= tolerance_ && aside(end) <= tolerance_) covers.push_back({begin, end, &other, t1 > t0});
    };
    tree_.traverse([&](const geometry::Box& box) { return box.intersects(boxes_[i]); }, visit);
    return covers;
  }

  /// Cuts the edge where its covers begin and end: a stretch without any is open; one with exactly one, an edge, has
  /// one neighbour, which must run the other way.  Where more than two facets meet, no direction is wrong.
  void judge(const Edge& e, const std::vector<Cover>& covers) {
    const double length = (e.to - e.from).norm();
    std::vector<double> cuts{0, length};
    for (const Cover& c : covers) cuts.insert(cuts.end(), {c.begin, c.end});
    std::sort(cuts.begin(), cuts.end());
    const auto at = [&](double t) { return Vec3(e.from + t / length * (e.to - e.from)); };
    double open_from = -1;
    const auto close = [&](double t) {
      if (open_from >= 0 && t - open_from > tolerance_) {
        inspection_.open_edge_length += t - open_from;
        inspection_.findings.push_back({one_sided(e) ? Inspection::Finding::Kind::gap : Inspection::Finding::Kind::rim,
                                        name(surface_of(e)), "", at((open_from + t) / 2), t - open_from});
      }
      open_from = -1;
    };
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
      const double begin = cuts[k], end = cuts[k + 1];
      if (end - begin <= tolerance_) continue;  // ends that agree but for rounding
      const Cover* only = nullptr;
      int count = 0;
      for (const Cover& c : covers)
        if (c.begin <= begin && c.end >= end) ++count, only = &c;
      if (count > 0)
        close(begin);
      else if (open_from < 0)
        open_from = begin;
      if (count == 1 && only->by && only->same_direction && e.facet < only->by->facet && one_sided(e) &&
          one_sided(*only->by))
        oppose(e, *only->by, at((begin + end) / 2), end - begin);
    }
    close(length);
  }

  void oppose(const Edge& e, const Edge& other, const Vec3& where, double length) {
    const auto pair = std::minmax({surface_of(e), surface_of(other)});
    Opposed& fault = opposed_[{pair.first, pair.second}];
    if (length > fault.longest) fault.longest = length, fault.where = where;
    fault.length += length;
  }

  struct Opposed {
    double length = 0, longest = 0;
    Vec3 where = Vec3::Zero();
  };

  const Scene& scene_;
  double tolerance_;
  Inspection& inspection_;
  std::vector<Edge> edges_;
  std::vector<geometry::Box> boxes_;
  geometry::BoxTree tree_, facet_tree_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, Opposed> opposed_;  ///< by surfaces
};

}  // namespace

void find_edge_faults(const Scene& scene, double tolerance, Inspection& inspection) {
  EdgeInspection(scene, tolerance, inspection).run();
}

}  // namespace interflect::scene
