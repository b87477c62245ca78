#include "visual/shading.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>

#include "results/tone_mapping.h"

namespace interflect::visual {

namespace {

/// A linear function on an element, fitted to its neighbours.
struct Plane {
  Vec3 centre, normal;
  std::array<Vec3, 3> gradient;
  Rgb value, low, high;  ///< at the centre; limits of what it may be extrapolated to

  Rgb at(const Vec3& p) const {
    Rgb out;
    for (std::size_t c = 0; c < 3; ++c) out[c] = std::clamp(value[c] + gradient[c].dot(p - centre), low[c], high[c]);
    return out;
  }
};

/// Fits on one side of a surface.
class Fits {
 public:
  Fits(const mesh::ElementMesh& mesh, const mesh::ElementMesh::Part& part, std::span<const Rgb> values) {
    for (std::uint32_t e = 0; e < part.count; ++e) {
      const scene::SurfacePatch& patch = mesh.patches()[part.first + e];
      planes_.push_back({patch.centroid(),
                         patch.normal(),
                         {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()},
                         values[part.first + e],
                         {},
                         {}});
      for (const Vec3& p : patch.ring()) around_[key(p)].push_back(e);
    }
    for (std::uint32_t e = 0; e < part.count; ++e) fit(e, mesh.patches()[part.first + e].ring());
  }

  Rgb mean_at(const Vec3& corner, std::uint32_t element) const {
    Rgb sum{};
    double count = 0;
    for (std::uint32_t e : around_.at(key(corner))) {
      if (!joined(e, element)) continue;
      const Rgb value = planes_[e].at(corner);
      for (std::size_t c = 0; c < 3; ++c) sum[c] += value[c];
      count += 1;
    }
    for (double& s : sum) s /= count;
    return sum;
  }

 private:
  using Key = std::array<double, 3>;
  static Key key(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

  bool joined(std::uint32_t a, std::uint32_t b) const {
    static const double nearly_flat = std::cos(pi / 9);
    return planes_[a].normal.dot(planes_[b].normal) > nearly_flat;
  }

  void fit(std::uint32_t e, std::span<const Vec3> ring) {
    Plane& plane = planes_[e];
    const Vec3 u = plane.normal.unitOrthogonal(), v = plane.normal.cross(u);
    Eigen::Matrix2d normal_matrix = Eigen::Matrix2d::Zero();
    Eigen::Matrix<double, 2, 3> right = Eigen::Matrix<double, 2, 3>::Zero();
    Rgb low = plane.value, high = plane.value;
    for (const Vec3& corner : ring)
      for (std::uint32_t n : around_.at(key(corner))) {
        if (n == e || !joined(n, e)) continue;
        const Vec3 step = planes_[n].centre - plane.centre;
        const Eigen::Vector2d flat_step(step.dot(u), step.dot(v));
        normal_matrix += flat_step * flat_step.transpose();
        for (std::size_t c = 0; c < 3; ++c) {
          const double other = planes_[n].value[c];
          right.col(static_cast<int>(c)) += flat_step * (other - plane.value[c]);
          low[c] = std::min(low[c], other);
          high[c] = std::max(high[c], other);
        }
      }
    const double size = normal_matrix.trace();
    const bool solvable = size > 0 && normal_matrix.determinant() > 1e-6 * size * size;
    for (std::size_t c = 0; c < 3; ++c) {
      const double room = 0.5 * (high[c] - low[c]);
      plane.low[c] = std::max(0.0, low[c] - room);
      plane.high[c] = high[c] + room;
      if (!solvable) continue;
      const Eigen::Vector2d g = normal_matrix.ldlt().solve(right.col(static_cast<int>(c)));
      plane.gradient[c] = g.x() * u + g.y() * v;
    }
  }

  std::vector<Plane> planes_;
  std::map<Key, std::vector<std::uint32_t>> around_;
};

Rgb mean_of(std::span<const Rgb> values) {
  Rgb mean{};
  for (const Rgb& v : values)
    for (std::size_t c = 0; c < 3; ++c) mean[c] += v[c] / static_cast<double>(values.size());
  return mean;
}

}  // namespace

void Polygons::add(std::span<const Vec3> ring, std::span<const results::Colour> ring_colours) {
  corners.insert(corners.end(), ring.begin(), ring.end());
  colours.insert(colours.end(), ring_colours.begin(), ring_colours.end());
  sizes.push_back(static_cast<std::uint8_t>(ring.size()));
}

Polygons flat(const mesh::ElementMesh& mesh, std::span<const results::Colour> colours) {
  Polygons out;
  for (std::size_t e = 0; e < colours.size(); ++e) {
    const std::array<results::Colour, 4> same{colours[e], colours[e], colours[e], colours[e]};
    const auto ring = mesh.patches()[e].ring();
    out.add(ring, std::span(same).first(ring.size()));
  }
  return out;
}

results::Colour display_colour(const Rgb& value, double white) {
  results::Colour out;
  for (std::size_t c = 0; c < 3; ++c)
    out[c] = static_cast<std::uint8_t>(std::lround(255 * results::srgb_encoded(value[c] / white)));
  return out;
}

Polygons smooth(const mesh::ElementMesh& mesh, std::span<const Rgb> values, double white) {
  Polygons out;
  for (const mesh::ElementMesh::Part& part : mesh.parts()) {
    const Fits fits(mesh, part, values);
    for (std::uint32_t e = 0; e < part.count; ++e) {
      const scene::SurfacePatch& patch = mesh.patches()[part.first + e];
      const auto ring = patch.ring();
      std::array<Rgb, 4> rim;
      for (std::size_t k = 0; k < ring.size(); ++k) rim[k] = fits.mean_at(ring[k], e);
      const results::Colour centre = display_colour(mean_of(std::span(rim).first(ring.size())), white);
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const std::size_t next = (k + 1) % ring.size();
        out.add(std::array{ring[k], ring[next], patch.centroid()},
                std::array{display_colour(rim[k], white), display_colour(rim[next], white), centre});
      }
    }
  }
  return out;
}

Polygons black_backs(const scene::Scene& scene, std::span<const scene::SurfacePatch> patches, results::Colour colour) {
  Polygons out;
  const std::array<results::Colour, 4> same{colour, colour, colour, colour};
  for (const scene::SurfacePatch& patch : patches) {
    if (scene.material(patch.surface).active(scene::Side::back)) continue;
    std::array<Vec3, 4> turned;
    std::reverse_copy(patch.ring().begin(), patch.ring().end(), turned.begin());
    out.add(std::span(turned).first(patch.corners), std::span(same).first(patch.corners));
  }
  return out;
}

namespace {

/// What a quadratic triangle's six points are worth at the barycentric coordinates l.
std::array<double, 6> quadratic(const std::array<double, 3>& l) {
  std::array<double, 6> N{};
  for (std::size_t k = 0; k < 3; ++k) {
    N[k] = l[k] * (2 * l[k] - 1);
    N[3 + k] = 4 * l[k] * l[(k + 1) % 3];
  }
  return N;
}

/// @param colour_at  (triangle's points, what they are worth)
template <class ColourAt>
Polygons curved_by(const mesh::SmoothMesh& mesh, const ColourAt& colour_at) {
  constexpr int parts = 4;  // of an edge
  Polygons out;
  for (const mesh::SmoothMesh::Triangle& t : mesh.triangles) {
    const auto add = [&](std::array<std::array<int, 2>, 3> nodes) {
      std::array<Vec3, 3> ring;
      std::array<results::Colour, 3> colours;
      for (std::size_t k = 0; k < 3; ++k) {
        const double v = double(nodes[k][0]) / parts, w = double(nodes[k][1]) / parts;
        const std::array<double, 3> l{1 - v - w, v, w};
        ring[k] = l[0] * mesh.points[t[0]] + l[1] * mesh.points[t[1]] + l[2] * mesh.points[t[2]];
        colours[k] = colour_at(t, quadratic(l));
      }
      out.add(ring, colours);
    };
    for (int i = 0; i < parts; ++i)
      for (int j = 0; i + j < parts; ++j) {
        add({{{i, j}, {i + 1, j}, {i, j + 1}}});
        if (i + j + 1 < parts) add({{{i + 1, j}, {i + 1, j + 1}, {i, j + 1}}});
      }
  }
  return out;
}

}  // namespace

Polygons curved(const mesh::SmoothMesh& mesh, std::span<const Rgb> of_points, double white) {
  return curved_by(mesh, [&](const mesh::SmoothMesh::Triangle& t, const std::array<double, 6>& N) {
    Rgb value{};
    for (std::size_t k = 0; k < 6; ++k)
      for (std::size_t c = 0; c < 3; ++c) value[c] += N[k] * of_points[t[k]][c];
    for (double& v : value) v = std::max(0.0, v);
    return display_colour(value, white);
  });
}

Polygons curved(const mesh::SmoothMesh& mesh, std::span<const double> of_points,
                const std::function<results::Colour(double)>& colour) {
  return curved_by(mesh, [&](const mesh::SmoothMesh::Triangle& t, const std::array<double, 6>& N) {
    double value = 0;
    for (std::size_t k = 0; k < 6; ++k) value += N[k] * of_points[t[k]];
    return colour(value);
  });
}

}  // namespace interflect::visual
