#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "montecarlo/light/light.h"

namespace interflect::montecarlo {

/// Of many lights one that matters at a place: a binary tree, walked from its root, at each node to a child by their
/// importances
///
///   I cos(theta_e) cos(theta_r) / max(d², h²)   [W/m²]
///
/// of the node's circumscribed sphere (half diagonal h of its box, at the distance d of its centre): I is the intensity
/// of its lights together, theta_e the smallest angle that a way from it to the place can have with a normal of theirs,
/// theta_r the smallest with the normal of the place, and the importance is 0 beyond what a light emits or a place
/// receives.  So what is never picked gives nothing.
///
/// Identities: sum of probabilities 1 at any place; `probability` is what `pick` returned, bit by bit.
/// Source: [Conty Estevez and Kulla 2018] "Importance sampling of many lights with adaptive tree splitting", without its
/// splitting; built by its surface area and orientation heuristic.  Test: tests/montecarlo/lights.cpp
class LightTree {
 public:
  LightTree() = default;
  explicit LightTree(std::span<const LightExtent> lights);

  bool empty() const { return nodes_.empty(); }
  struct Picked {
    std::uint32_t light;
    double probability;
  };
  Picked pick(const Place& at, double u) const;
  double probability(std::uint32_t light, const Place& at) const;
  int depth() const { return depth_; }

 private:
  struct Node {
    Vec3 centre, axis;
    double half, half2;  ///< of the box's diagonal half, and its square
    double cos_normals, sin_normals, cos_emission, intensity;
    bool by_cosine;
    std::uint32_t second = 0;  ///< child; the first follows its parent; 0: a leaf
    std::uint32_t light = 0;   ///< of a leaf
  };
  struct Build;
  struct Seen;
  static double importance(const Node& node, const Place& at, const Seen& seen);
  static std::array<double, 2> importances(const Node& a, const Node& b, const Place& at);
  double first_share(std::uint32_t node, const Place& at) const;

  std::vector<Node> nodes_;
  std::vector<std::uint64_t> way_to_;  ///< each light: bit k is set where the second child is taken at depth k
  std::vector<std::uint8_t> depth_of_;
  int depth_ = 0;
};

/// The least that holds both.
LightExtent united(const LightExtent& a, const LightExtent& b);

}  // namespace interflect::montecarlo
