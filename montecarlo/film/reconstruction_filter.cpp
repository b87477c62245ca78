#include "montecarlo/film/reconstruction_filter.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/hemisphere.h"

namespace interflect::montecarlo {
namespace {

/// The pixel's area: a mean over it.
class Box final : public ReconstructionFilter {
 public:
  double value(const Vec2& offset) const override { return offset.cwiseAbs().maxCoeff() <= 0.5 ? 1 : 0; }
  double reach() const override { return 0.5; }
  Vec2 sample(double u, double v) const override { return {u - 0.5, v - 0.5}; }
  Vec2 inverse(const Vec2& offset) const override { return {offset.x() + 0.5, offset.y() + 0.5}; }
};

/// (1 - |x|) (1 - |y|).
class Triangle final : public ReconstructionFilter {
 public:
  double value(const Vec2& offset) const override { return tent(offset.x()) * tent(offset.y()); }
  double reach() const override { return 1; }
  Vec2 sample(double u, double v) const override { return {offset_of(u), offset_of(v)}; }
  Vec2 inverse(const Vec2& offset) const override { return {below(offset.x()), below(offset.y())}; }

 private:
  static double tent(double x) { return std::max(0.0, 1 - std::abs(x)); }
  static double offset_of(double u) { return u < 0.5 ? std::sqrt(2 * u) - 1 : 1 - std::sqrt(2 * (1 - u)); }
  /// int_-1^x of the tent.
  static double below(double x) { return x < 0 ? 0.5 * (1 + x) * (1 + x) : 1 - 0.5 * (1 - x) * (1 - x); }
};

/// exp(-r² / (2 s²)) / (2 pi s² (1 - q)) within r <= 2, s = 1/2 and q = exp(-2 / s²): rings are drawn by the inverse of
///   P(r) = (1 - exp(-r² / (2 s²))) / (1 - q).
class Gaussian final : public ReconstructionFilter {
 public:
  double value(const Vec2& offset) const override {
    const double r2 = offset.squaredNorm();
    return r2 <= radius * radius ? std::exp(-r2 / (2 * s2)) / (2 * pi * s2 * within_) : 0;
  }
  double reach() const override { return radius; }
  Vec2 sample(double u, double v) const override {
    const double r = std::sqrt(-2 * s2 * std::log1p(-u * within_));
    return {r * std::cos(2 * pi * v), r * std::sin(2 * pi * v)};
  }
  Vec2 inverse(const Vec2& offset) const override {
    return {-std::expm1(-offset.squaredNorm() / (2 * s2)) / within_, core::turns_about_z({offset.x(), offset.y(), 0})};
  }

 private:
  static constexpr double s2 = 0.25, radius = 2;
  double within_ = -std::expm1(-radius * radius / (2 * s2));
};

/// m(x) m(y) with the cubic of [Mitchell and Netravali 1988], B = C = 1/3:
///
///   m(x) = (7/6) x³ - 2 x² + 8/9                       |x| <= 1
///   m(x) = (7/18) (2 - x)² (8/7 - x)                   1 <= |x| <= 2,   negative from 8/7 on
///
/// With a = int m+ and b = int m- of a line, h+ is a² where both factors are positive and b² where both are negative, h-
/// is a b twice.  Factors are drawn by the inverses of their integrals.
class Mitchell final : public ReconstructionFilter {
 public:
  double value(const Vec2& offset) const override { return m(std::abs(offset.x())) * m(std::abs(offset.y())); }
  double reach() const override { return 2; }
  double negative() const override { return 2 * inner_ * outer_; }
  Vec2 sample(double u, double v) const override {
    if (u < both_inner_) return {inner(u / both_inner_), inner(v)};
    return {outer((u - both_inner_) / (1 - both_inner_)), outer(v)};
  }
  Vec2 sample_negative(double u, double v) const override {
    if (u < 0.5) return {inner(2 * u), outer(v)};
    return {outer(2 * u - 1), inner(v)};
  }
  Vec2 inverse(const Vec2& offset) const override {
    const Vec2 u = factors_inverse(offset);
    return {is_inner(offset.x()) ? both_inner_ * u.x() : both_inner_ + (1 - both_inner_) * u.x(), u.y()};
  }
  Vec2 inverse_negative(const Vec2& offset) const override {
    const Vec2 u = factors_inverse(offset);
    return {is_inner(offset.x()) ? u.x() / 2 : 0.5 + u.x() / 2, u.y()};
  }

 private:
  static constexpr double zero = 8.0 / 7;

  static double m(double x) {
    if (x >= 2) return 0;
    return x <= 1 ? (7 * x / 6 - 2) * x * x + 8.0 / 9 : 7.0 / 18 * (2 - x) * (2 - x) * (zero - x);
  }
  /// int_0^x m.
  static double integral(double x) {
    if (x <= 1) return ((7 * x / 24 - 2.0 / 3) * x * x + 8.0 / 9) * x;
    const double t = 2 - x;  // m = (7/18) (t³ - (6/7) t²)
    return 0.5 + 7.0 / 18 * (2.0 / 7 - t / 4) * t * t * t;
  }
  /// x in [low, high], where m keeps its sign, with |int_low^x m| = part |int_low^high m|: Newton's steps, where they
  /// stay within what is left by halving.
  static double reached(double part, double low, double high) {
    const double from = integral(low), all = integral(high) - from, sign = all < 0 ? -1 : 1;
    double x = low + part * (high - low);
    for (int step = 0; step < 60; ++step) {
      const double excess = sign * (integral(x) - from - part * all);
      (excess > 0 ? high : low) = x;
      const double slope = std::abs(m(x)), newton = x - excess / slope;
      const double next = slope > 0 && newton > low && newton < high ? newton : (low + high) / 2;
      if (std::abs(next - x) < 1e-15) break;
      x = next;
    }
    return x;
  }
  static double on_a_side(double u, double low, double high) {
    const double part = 2 * u - 1;
    return std::copysign(reached(std::abs(part), low, high), part);
  }
  static double on_a_side_inverse(double x, double low, double high) {
    const double part = (integral(std::abs(x)) - integral(low)) / (integral(high) - integral(low));
    return 0.5 + 0.5 * std::copysign(part, x);
  }
  static double inner(double u) { return on_a_side(u, 0, zero); }
  static double outer(double u) { return on_a_side(u, zero, 2); }
  static bool is_inner(double x) { return std::abs(x) < zero; }
  /// The numbers that each factor is drawn by.
  static Vec2 factors_inverse(const Vec2& offset) {
    const auto of = [](double x) {
      return is_inner(x) ? on_a_side_inverse(x, 0, zero) : on_a_side_inverse(x, zero, 2);
    };
    return {of(offset.x()), of(offset.y())};
  }

  double inner_ = 2 * integral(zero), outer_ = 2 * (integral(zero) - integral(2));  ///< a, b
  double both_inner_ = inner_ * inner_ / (inner_ * inner_ + outer_ * outer_);       ///< of int h+
};

template <class F>
std::unique_ptr<ReconstructionFilter> make() {
  return std::make_unique<F>();
}

}  // namespace

Vec2 ReconstructionFilter::sample_negative(double, double) const {
  throw core::PreconditionError("this filter is not negative anywhere");
}

Vec2 ReconstructionFilter::inverse_negative(const Vec2&) const {
  throw core::PreconditionError("this filter is not negative anywhere");
}

const std::vector<FilterEntry>& known_filters() {
  static const std::vector<FilterEntry> filters = {
      {"box", "the mean over the pixel", make<Box>},
      {"triangle", "a pyramid over 2 x 2 pixels", make<Triangle>},
      {"gaussian", "a bell of standard deviation 1/2, over 4 x 4 pixels", make<Gaussian>},
      {"mitchell", "a cubic with negative lobes, over 4 x 4 pixels: sharper, twice the work", make<Mitchell>}};
  return filters;
}

std::vector<std::string> filter_names() {
  std::vector<std::string> names;
  for (const FilterEntry& entry : known_filters()) names.push_back(entry.name);
  return names;
}

std::unique_ptr<ReconstructionFilter> make_filter(const std::string& name) {
  std::string known;
  for (const FilterEntry& entry : known_filters()) {
    if (entry.name == name) return entry.make();
    known += (known.empty() ? "" : ", ") + entry.name;
  }
  throw core::InputError("filter '" + name + "'", "one of " + known + " expected");
}

const ReconstructionFilter& box_filter() {
  static const std::unique_ptr<ReconstructionFilter> filter = make_filter("box");
  return *filter;
}

}  // namespace interflect::montecarlo
