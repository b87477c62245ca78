#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/box.h"

namespace interflect::geometry {

/// A bounding hierarchy over boxes (a binary tree, split at the median along the longest side of the centres' box).
class BoxTree {
 public:
  struct Node {
    Box box;
    std::uint32_t first, count;  ///< leaf (count > 0): items()[first .. first + count)
    std::uint32_t left, right;   ///< inner node (count == 0): its children
  };

  BoxTree() = default;
  explicit BoxTree(std::span<const Box> boxes, std::uint32_t leaf_size = 4);

  std::span<const Node> nodes() const { return nodes_; }           ///< the root is nodes()[0]; empty without boxes
  std::span<const std::uint32_t> items() const { return items_; }  ///< positions in the boxes given

  /// visit(item) for every item in a leaf that `enter(box)` lets in, from the root down.
  template <class Enter, class Visit>
  void traverse(const Enter& enter, const Visit& visit) const {
    if (nodes_.empty()) return;
    std::uint32_t stack[64];
    int depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
      const Node& node = nodes_[stack[--depth]];
      if (!enter(node.box)) continue;
      if (node.count > 0)
        for (std::uint32_t i = 0; i < node.count; ++i) visit(items_[node.first + i]);
      else
        stack[depth++] = node.left, stack[depth++] = node.right;
    }
  }

 private:
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> items_;
};

}  // namespace interflect::geometry
