#include "fem/residual.h"

#include <limits>

#include "fem/columns.h"
#include "fem/goal/iterated_transport.h"

namespace interflect::fem {
namespace {

/// By channel: what norms of r are multiplied by.
Spectrum amplification(const RadiositySolution& s, int channels) {
  Spectrum highest, out;
  for (const Spectrum& rho : s.reflectance) highest = max(highest, rho);
  for (int c = 0; c < channels; ++c)
    out[c] = highest[c] < 1 ? 1 / (1 - highest[c]) : std::numeric_limits<double>::infinity();
  return out;
}

/// Where r is looked at: at Gauss nodes, whose weights norms are sums with, and beside corners and edges, where what
/// shines from the next wall makes |r| largest, and which no Gauss node is near to.
ElementNodes nodes_and_edges(std::span<const scene::SurfacePatch> patches) {
  constexpr int points = 4;
  constexpr double inwards = 1e-3;  ///< of the way to the middle: on an edge where walls meet T b has two values
  const ElementNodes inside = element_nodes(patches, points);
  ElementNodes out;
  out.first.push_back(0);
  for (std::size_t i = 0; i < patches.size(); ++i) {
    out.nodes.insert(out.nodes.end(), inside.nodes.begin() + static_cast<std::ptrdiff_t>(inside.first[i]),
                     inside.nodes.begin() + static_cast<std::ptrdiff_t>(inside.first[i + 1]));
    const std::span<const Vec3> ring = patches[i].ring();
    for (std::size_t k = 0; k < ring.size(); ++k)
      for (const double along : {0.0, 0.2, 0.5, 0.8}) {
        const Vec3 x = ring[k] + along * (ring[(k + 1) % ring.size()] - ring[k]);
        out.nodes.push_back({x + inwards * (patches[i].centroid() - x), 0});
      }
    out.first.push_back(out.nodes.size());
  }
  return out;
}

}  // namespace

ResidualNorms residual_norms(const scene::Scene& scene, const RadiositySolution& s, Run& run) {
  const auto patches = s.mesh.patches();
  const int channels = scene.channel_count();
  const PointViewFactors factors(scene, patches, s.field ? s.field->order : 0);
  const ElementNodes nodes = nodes_and_edges(patches);
  const std::vector<Spectrum> H = to_spectra(iterated_transport(
      factors, patches, nodes, s.field ? s.field->radiosity : to_columns(s.radiosity, channels), run));
  ResidualNorms out;
  Spectrum squares;
  double area = 0;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    Spectrum of_element;
    for (std::size_t q = nodes.first[i]; q < nodes.first[i + 1]; ++q) {
      const SurfaceNode& node = nodes.nodes[q];
      const Spectrum B_h = s.field ? s.field->at(i, node.position) : s.radiosity[i];
      const Spectrum r = s.exitance[i] + s.reflectance[i] * H[q] - B_h;
      of_element += node.weight * (r * r);
      out.largest = max(out.largest, abs(r));
    }
    squares += of_element;
    area += patches[i].area;
    out.of_elements.push_back(sqrt(of_element / patches[i].area));
  }
  out.rms = sqrt(squares / area);
  const Spectrum times = amplification(s, channels);
  for (int c = 0; c < channels; ++c) {  // 0 stays 0
    out.rms_bound[c] = out.rms[c] > 0 ? times[c] * out.rms[c] : 0.0;
    out.largest_bound[c] = out.largest[c] > 0 ? times[c] * out.largest[c] : 0.0;
  }
  return out;
}

}  // namespace interflect::fem
