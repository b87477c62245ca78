#include "fem/form_factor/visibility.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "core/random.h"

namespace interflect::fem {

namespace {

using Words = std::array<std::uint32_t, PointLanes::count>;

/// Random points in cells of the unit square, given by row and column; 16 bits are plenty to jitter inside a cell.
struct JitteredCells {
  alignas(32) PointLanes::Numbers s, t;
  JitteredCells(const std::uint32_t* row, const std::uint32_t* column, std::uint32_t side, std::uint32_t turn_rows,
                std::uint32_t turn_columns, const Words& bits) {
    const double cell = 1.0 / side;
    for (std::size_t l = 0; l < PointLanes::count; ++l) {
      const std::uint32_t r = row[l] + turn_rows,
                          c = column[l] + turn_columns;  // less `side` where that does not wrap around
      s[l] = cell * (static_cast<int>(std::min(r, r - side)) + (0.5 + static_cast<int>(bits[l] >> 16)) * 0x1p-16);
      t[l] = cell * (static_cast<int>(std::min(c, c - side)) + (0.5 + static_cast<int>(bits[l] & 0xffffu)) * 0x1p-16);
    }
  }
};

/// cos cos / r² times the weights of the points; not positive where the points face away.
PointLanes::Numbers weights_between(const PointLanes& x, const PointLanes& y, const Vec3& normal_x,
                                    const Vec3& normal_y) {
  const double ax = normal_x.x(), ay = normal_x.y(), az = normal_x.z(), bx = normal_y.x(), by = normal_y.y(),
               bz = normal_y.z();
  PointLanes::Numbers weight;
  for (std::size_t l = 0; l < PointLanes::count; ++l) {
    const double dx = y.x[l] - x.x[l], dy = y.y[l] - x.y[l], dz = y.z[l] - x.z[l];
    const double leaves = std::max(0.0, ax * dx + ay * dy + az * dz), arrives = -(bx * dx + by * dy + bz * dz);
    const double square = dx * dx + dy * dy + dz * dz;
    weight[l] = x.weight[l] * y.weight[l] * leaves * arrives / (square * square);
  }
  return weight;
}

}  // namespace

/// [Fisher, Yates 1938], a stream for each permutation.
CellPermutations::CellPermutations(int side, std::uint64_t seed) : side_(static_cast<std::uint32_t>(side)) {
  const std::uint32_t n = side_ * side_;
  std::vector<std::uint32_t> order(n);
  for (std::uint32_t p = 0; p <= count; ++p) {
    std::iota(order.begin(), order.end(), 0u);
    core::RandomNumbers random(seed, p, n);
    for (std::uint32_t left = n; p > 0 && left > 1; --left)
      std::swap(order[left - 1], order[static_cast<std::size_t>(random.next() * left)]);
    for (const std::uint32_t cell : order) rows_.push_back(cell / side_), columns_.push_back(cell % side_);
  }
  rows_.resize(rows_.size() + PointLanes::count);
  columns_.resize(rows_.size());
}

CellPermutations::Pairing CellPermutations::pairing(const core::RandomBlock& random) const {
  const auto below = [](std::uint32_t bits, std::uint32_t n) {
    return static_cast<std::uint32_t>((std::uint64_t{bits} * n) >> 32);
  };
  const std::size_t first = std::size_t{1 + random[0] % count} * side_ * side_;
  return {
      rows_.data(),           columns_.data(), rows_.data() + first, columns_.data() + first, below(random[1], side_),
      below(random[2], side_)};
}

VisibilitySampler::VisibilitySampler(std::span<const scene::SurfacePatch> patches, const raycast::RayCaster& rays,
                                     int rays_per_pair, std::uint64_t seed, double largest_error)
    : maps_(patches.begin(), patches.end()),
      rays_(rays),
      seed_(core::derived_seed(seed, "visibility")),
      largest_error_(largest_error) {
  const int side = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(std::max(rays_per_pair, 4)))));
  for (const int times : {1, 2, 4}) permutations_.emplace_back(times * side, core::derived_seed(seed, "strata"));
  for (const auto& patch : patches) normals_.push_back(patch.normal());
}

void VisibilitySampler::generate(Index i, Index j, Effort effort, Workspace& w) const {
  w.segments.clear();
  w.weights.clear();
  w.blocked.clear();
  append(i, j, effort, 0, w);
}

/// @param set  has random numbers of its own
void VisibilitySampler::append(Index i, Index j, Effort effort, std::uint32_t set, Workspace& w) const {
  const CellPermutations& strata = permutations_[static_cast<std::size_t>(effort)];
  const std::uint32_t m = strata.side(), n = m * m;
  const std::uint64_t pair = (static_cast<std::uint64_t>(i) << 32) | static_cast<std::uint64_t>(j);
  const ElementMap &onto_i = maps_[static_cast<std::size_t>(i)], &onto_j = maps_[static_cast<std::size_t>(j)];
  const Vec3 normal_i = normals_[static_cast<std::size_t>(i)], normal_j = normals_[static_cast<std::size_t>(j)];
  const CellPermutations::Pairing cells = strata.pairing(core::random_block(seed_, 2 * set + 1, pair, 0));
  std::size_t used = w.segments.size();
  w.segments.resize(used + n);
  w.weights.resize(used + n);
  for (std::uint32_t first = 0; first < n; first += PointLanes::count) {
    Words bits_i, bits_j;
    static_assert(PointLanes::count == 2 * core::blocks_at_once);
    const core::RandomBlocks words = core::random_blocks(seed_, 2 * set, pair, first / 2);
    for (std::size_t b = 0; b < core::blocks_at_once; ++b) {
      bits_i[2 * b] = words[0][b], bits_j[2 * b] = words[1][b];
      bits_i[2 * b + 1] = words[2][b], bits_j[2 * b + 1] = words[3][b];
    }
    const JitteredCells in_i(cells.row + first, cells.column + first, m, 0, 0, bits_i);
    const JitteredCells in_j(cells.partner_row + first, cells.partner_column + first, m, cells.turn_rows,
                             cells.turn_columns, bits_j);
    const PointLanes x = onto_i(in_i.s, in_i.t), y = onto_j(in_j.s, in_j.t);
    const PointLanes::Numbers weight = weights_between(x, y, normal_i, normal_j);
    for (std::uint32_t l = 0; l < std::min<std::uint32_t>(PointLanes::count, n - first); ++l) {
      if (!(weight[l] > 0.0)) continue;
      w.segments[used] = {x.position(l), y.position(l), normal_i, normal_j};
      w.weights[used++] = weight[l];
    }
  }
  w.segments.resize(used);
  w.weights.resize(used);
}

SampledVisibility VisibilitySampler::operator()(Index i, Index j, Effort effort, Workspace& w) const {
  generate(i, j, effort, w);
  SampledVisibility V = look(w);
  const std::size_t of_a_set = std::size_t{permutations_.back().side()} * permutations_.back().side();
  const auto most_sets = static_cast<std::uint32_t>(most_rays / of_a_set) + 1;
  for (std::uint32_t set = 1; largest_error_ > 0 && V.standard_error > largest_error_; ++set) {
    if (w.segments.size() >= most_rays || set > most_sets) break;
    // Errors fall as one over the root of the number.
    const double times = std::pow(V.standard_error / largest_error_, 2), wanted = times * static_cast<double>(V.rays);
    append(i, j, Effort::sixteenfold, set, w);
    while (static_cast<double>(w.segments.size()) < std::min(wanted, double(most_rays)) && set < most_sets)
      append(i, j, Effort::sixteenfold, ++set, w);
    V = look(w);
  }
  return V;
}

/// Casts what has not been cast, and estimates from all.
SampledVisibility VisibilitySampler::look(Workspace& w) const {
  const std::size_t before = w.blocked.size(), n = w.segments.size();
  if (n == 0) return {0.5, 0.5, 0};  // a sliver that no pair of points found: nothing is known
  w.blocked.resize(n);
  rays_.occluded(std::span(w.segments).subspan(before), std::span(w.blocked).subspan(before));
  return estimated_visibility(w.weights, w.blocked);
}

SampledVisibility estimated_visibility(std::span<const double> weights, std::span<const std::uint8_t> blocked) {
  double all = 0.0, clear = 0.0, squares = 0.0;
  for (std::size_t k = 0; k < weights.size(); ++k) {
    all += weights[k];
    squares += weights[k] * weights[k];
    if (blocked[k] == 0) clear += weights[k];
  }
  const double mean = all / static_cast<double>(weights.size()), cautious = (clear + mean) / (all + 2.0 * mean);
  return {clear / all, std::sqrt(cautious * (1.0 - cautious) * squares) / all, static_cast<int>(weights.size())};
}

Effort effort_for(double form_factor) {
  return form_factor > 0.03 ? Effort::sixteenfold : form_factor > 0.004 ? Effort::fourfold : Effort::single;
}

}  // namespace interflect::fem
