#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "fem/quadrature.h"
#include "scene/scene.h"

/// (T b)(x) of radiosity that is a polynomial on each surface, by what shares no code with form factors: clipping and
/// integration are done once more here, and otherwise.
namespace interflect::fem::test {

/// sum_ij c_ij xi^i eta^j, i + j <= 3, by i + j and then by j, in coordinates of a surface's plane about the mean of
/// its corners, in units of the largest distance of a corner from there.
struct SurfaceRadiosity {
  std::array<double, 10> c{};
};

/// A convex ring of few corners.
struct ConvexPiece {
  std::array<Vec3, 12> corner;
  std::size_t corners = 0;

  std::span<const Vec3> ring() const { return {corner.data(), corners}; }
  void push_back(const Vec3& x) { corner.at(corners++) = x; }
  bool reaches(const Vec3& n, const Vec3& origin, double rounding) const {
    return std::any_of(corner.data(), corner.data() + corners,
                       [&](const Vec3& x) { return n.dot(x - origin) > rounding; });
  }
  /// What stays where n . (x - origin) >= 0; corners within `rounding` of that plane are on it.
  ConvexPiece clipped(const Vec3& n, const Vec3& origin, double rounding) const {
    ConvexPiece out;
    for (std::size_t k = 0; k < corners; ++k) {
      const Vec3 &p = corner[k], &q = corner[(k + 1) % corners];
      const double at_p = n.dot(p - origin), at_q = n.dot(q - origin);
      if (at_p >= -rounding) out.push_back(p);
      if ((at_p > rounding && at_q < -rounding) || (at_p < -rounding && at_q > rounding))
        out.push_back(p + at_p / (at_p - at_q) * (q - p));
    }
    return out;
  }
};

/// T b in a closed convex room with closed bodies in it, all of convex faces,
///
///   (T b)(x) = sum_j int_{seen part of j} cos cos / (pi r²) b dA,   each face j cut at the horizon
///
/// in two parts: of the room's faces as if nothing hid, which is smooth but for the room's edges; and of the bodies'
/// less what is hidden, which is smooth but for kinks along shadows' edges, and 0 near the room's.
///
/// A ray that goes through a body leaves it by a face that is turned away from its start: the cones from x over those
/// faces are taken out of j one after another, which leaves convex pieces.  In polar coordinates (s, phi) about the
/// foot of x, at the height h over j, with cos_x r = alpha + beta(phi) s and omega = (cos phi, sin phi),
///
///   1/pi int h (alpha + beta s) / r^4  xi^i eta^j dA
///       = h / pi  closed integral of  omega_1^i omega_2^j (alpha A_k + beta A_{k+1})(s(phi)) dphi,   k = i + j
///   A_k(s) = int_0^s sigma^{k+1} / (sigma² + h²)² dsigma
///
/// by Gauss's rule along each edge, s = |d| cosh w and dphi = dw / cosh w, d being the distance of the edge's line from
/// the foot: the integrand has no singularity within pi / 2 of the real w.  Accuracy: about 1e-9.
class SeenRadiosity {
 public:
  using Solutions = std::span<const std::vector<SurfaceRadiosity>>;  ///< per solution and surface
  enum class Part : std::uint8_t { room, bodies_and_hidden };

  explicit SeenRadiosity(const scene::Scene& scene)
      : rule_(gauss_legendre(8)), rounding_(1e-14 * scene.box().diagonal().norm()) {
    for (const scene::SurfaceId id : scene.surface_ids()) faces_.emplace_back(scene.surface(id).outline->outer);
    for (Face& face : faces_)
      face.of_room = std::none_of(faces_.begin(), faces_.end(), [&](const Face& other) {
        return other.piece.reaches(-face.normal, face.middle, 1e3 * rounding_);
      });
  }

  double value(const SurfaceRadiosity& b, scene::SurfaceId on, const Vec3& x) const {
    return expanded(b.c, faces_[on.value].coordinates(x))[0];
  }

  /// @param x, n  a point of a surface and its normal
  /// @param out   per solution; what a part adds is added
  void add(Part part, const Vec3& x, const Vec3& n, Solutions b, std::span<double> out) const {
    std::vector<const Face*> hiding;
    for (const Face& face : faces_)
      if (part != Part::room && face.height(x) < -rounding_) hiding.push_back(&face);
    for (std::size_t j = 0; j < faces_.size(); ++j) {
      const Face& face = faces_[j];
      if (face.height(x) <= rounding_ || (part == Part::room && !face.of_room)) continue;
      const ConvexPiece above = face.piece.clipped(n, x, rounding_);
      Moments moments{};
      if (face.of_room == (part == Part::room)) add_moments(above, x, n, face, 1, moments);
      if (part != Part::room) take_out_hidden(above, hiding, x, n, face, moments);
      add_expanded(moments, x, j, b, out);
    }
  }

 private:
  using Moments = std::array<double, 10>;

  struct Face {
    explicit Face(std::span<const Vec3> ring)
        : normal(geometry::vector_area(ring).normalized()), u((ring[1] - ring[0]).normalized()), v(normal.cross(u)) {
      for (const Vec3& x : ring) piece.push_back(x), middle += x / static_cast<double>(ring.size());
      for (const Vec3& x : ring) radius = std::max(radius, (x - middle).norm());
    }
    double height(const Vec3& x) const { return normal.dot(x - middle); }
    Vec2 coordinates(const Vec3& x) const { return Vec2(u.dot(x - middle), v.dot(x - middle)) / radius; }

    ConvexPiece piece;
    Vec3 middle = Vec3::Zero(), normal, u, v;
    double radius = 0;
    bool of_room = false;
  };
  /// The same polynomial in coordinates about y.
  static std::array<double, 10> expanded(const std::array<double, 10>& c, const Vec2& y) {
    const double u = y.x(), v = y.y();
    return {c[0] + u * (c[1] + u * (c[3] + u * c[6])) + v * (c[2] + v * (c[5] + v * c[9])) +
                u * v * (c[4] + u * c[7] + v * c[8]),
            c[1] + u * (2 * c[3] + 3 * u * c[6]) + v * (c[4] + 2 * u * c[7] + v * c[8]),
            c[2] + v * (2 * c[5] + 3 * v * c[9]) + u * (c[4] + u * c[7] + 2 * v * c[8]),
            c[3] + 3 * u * c[6] + v * c[7],
            c[4] + 2 * (u * c[7] + v * c[8]),
            c[5] + u * c[8] + 3 * v * c[9],
            c[6],
            c[7],
            c[8],
            c[9]};
  }

  void take_out_hidden(const ConvexPiece& above, std::span<const Face* const> hiding, const Vec3& x, const Vec3& n,
                       const Face& face, Moments& moments) const {
    std::vector<ConvexPiece> pieces{above}, left;
    for (const Face* k : hiding) {
      const ConvexPiece between = k->piece.clipped(face.normal, face.middle, rounding_);
      if (between.corners < 3) continue;
      left.clear();
      for (const ConvexPiece& piece : pieces)
        if (const auto hidden = split(piece, between, x, left)) add_moments(*hidden, x, n, face, -1, moments);
      std::swap(pieces, left);
    }
  }

  /// The part of a piece in the cone from x over a face turned away; what is outside goes to `left`, in parts.
  std::optional<ConvexPiece> split(const ConvexPiece& piece, const ConvexPiece& over, const Vec3& x,
                                   std::vector<ConvexPiece>& left) const {
    std::array<Vec3, 12> inwards;
    std::size_t sides = 0;
    bool apart = false;
    for (std::size_t k = 0; k < over.corners && !apart; ++k) {
      const Vec3 across = (over.corner[k] - x).cross(over.corner[(k + 1) % over.corners] - x);
      if (across.norm() <= rounding_ * rounding_) continue;
      inwards[sides] = across.normalized();
      apart = !piece.reaches(inwards[sides++], x, rounding_);
    }
    const std::size_t before = left.size();
    ConvexPiece inside = piece;
    for (std::size_t k = 0; k < sides && !apart; ++k) {
      const ConvexPiece beyond = inside.clipped(-inwards[k], x, rounding_);
      if (beyond.corners > 2) left.push_back(beyond);
      inside = inside.clipped(inwards[k], x, rounding_);
      apart = inside.corners < 3;
    }
    if (!apart) return inside;
    left.resize(before);
    left.push_back(piece);
    return {};
  }

  void add_moments(const ConvexPiece& piece, const Vec3& x, const Vec3& n, const Face& face, double sign,
                   Moments& moments) const {
    const double h = face.height(x), h2 = h * h;
    const Vec3 foot = x - h * face.normal;
    const double alpha = -h * n.dot(face.normal), n_u = n.dot(face.u), n_v = n.dot(face.v);
    for (std::size_t k = 0; k < piece.corners; ++k) {
      const Vec3 from = piece.corner[k] - foot, to = piece.corner[(k + 1) % piece.corners] - foot;
      const Vec2 p(face.u.dot(from), face.v.dot(from)), q(face.u.dot(to), face.v.dot(to));
      const double length = (q - p).norm();
      if (length <= rounding_) continue;
      const Vec2 along = (q - p) / length;
      const double d = p.x() * along.y() - p.y() * along.x(), distance = std::abs(d);
      if (distance <= rounding_) continue;
      const double first = std::asinh(p.dot(along) / distance), last = std::asinh(q.dot(along) / distance);
      const int panels = static_cast<int>(std::ceil((last - first) / 2));
      const double width = (last - first) / panels;
      for (int panel = 0; panel < panels; ++panel)
        for (const RuleNode& node : rule_) {
          const double e = std::exp(first + (panel + node.u) * width), cosh = (e + 1 / e) / 2, sinh = (e - 1 / e) / 2;
          const double s = distance * cosh, s2 = s * s, r2 = s2 + h2, arc = std::atan(s / h);
          const double log = std::log1p(s2 / h2);
          const std::array<double, 5> A{s2 / (2 * h2 * r2), (arc / h - s / r2) / 2, (log - s2 / r2) / 2,
                                        s - 1.5 * h * arc + s * h2 / (2 * r2), s2 / 2 - h2 * log + s2 * h2 / (2 * r2)};
          const Vec2 omega = (d * Vec2(along.y(), -along.x()) + distance * sinh * along) / s;
          const double beta = n_u * omega.x() + n_v * omega.y();
          const double weight = sign * h * inv_pi * std::copysign(node.weight * width, d) / cosh;
          const auto of = [&](std::size_t degree) { return weight * (alpha * A[degree] + beta * A[degree + 1]); };
          const double linear = of(1), square = of(2), cube = of(3);
          moments[0] += of(0);
          moments[1] += linear * omega.x();
          moments[2] += linear * omega.y();
          moments[3] += square * omega.x() * omega.x();
          moments[4] += square * omega.x() * omega.y();
          moments[5] += square * omega.y() * omega.y();
          moments[6] += cube * omega.x() * omega.x() * omega.x();
          moments[7] += cube * omega.x() * omega.x() * omega.y();
          moments[8] += cube * omega.x() * omega.y() * omega.y();
          moments[9] += cube * omega.y() * omega.y() * omega.y();
        }
    }
  }

  /// Moments about the foot of x times each solution's expansion there.
  void add_expanded(const Moments& moments, const Vec3& x, std::size_t j, Solutions b, std::span<double> out) const {
    const Vec2 y = faces_[j].coordinates(x);
    const double r = faces_[j].radius;
    for (std::size_t m = 0; m < b.size(); ++m) {
      const std::array<double, 10> c = expanded(b[m][j].c, y);
      const double cubes = c[6] * moments[6] + c[7] * moments[7] + c[8] * moments[8] + c[9] * moments[9],
                   squares = c[3] * moments[3] + c[4] * moments[4] + c[5] * moments[5] + cubes / r;
      out[m] += c[0] * moments[0] + (c[1] * moments[1] + c[2] * moments[2] + squares / r) / r;
    }
  }

  Rule rule_;
  double rounding_;
  std::vector<Face> faces_;
};

}  // namespace interflect::fem::test
