#include "geometry/box_tree.h"

#include <algorithm>
#include <numeric>

namespace interflect::geometry {
namespace {

class Build {
 public:
  Build(std::span<const Box> boxes, std::uint32_t leaf_size, std::vector<BoxTree::Node>& nodes,
        std::vector<std::uint32_t>& items)
      : boxes_(boxes), leaf_size_(std::max(leaf_size, 1u)), nodes_(nodes), items_(items) {}

  std::uint32_t subtree(std::uint32_t first, std::uint32_t count) {
    const auto at = static_cast<std::uint32_t>(nodes_.size());
    Box box, centres;
    for (std::uint32_t i = first; i < first + count; ++i) {
      box.extend(boxes_[items_[i]]);
      centres.extend(boxes_[items_[i]].center());
    }
    nodes_.push_back({box, first, count, 0, 0});
    if (count <= leaf_size_) return at;
    const std::uint32_t half = count / 2;
    split(first, half, count, centres);
    const std::uint32_t left = subtree(first, half), right = subtree(first + half, count - half);
    nodes_[at].count = 0;
    nodes_[at].left = left;
    nodes_[at].right = right;
    return at;
  }

 private:
  void split(std::uint32_t first, std::uint32_t half, std::uint32_t count, const Box& centres) {
    int axis = 0;
    centres.sizes().maxCoeff(&axis);
    const auto before = [&](std::uint32_t a, std::uint32_t b) {
      const double ca = boxes_[a].center()[axis], cb = boxes_[b].center()[axis];
      return ca != cb ? ca < cb : a < b;  // a total order: the same tree from any library's nth_element
    };
    const auto begin = items_.begin() + first;
    std::nth_element(begin, begin + half, begin + count, before);
    std::sort(begin, begin + half);
    std::sort(begin + half, begin + count);
  }

  std::span<const Box> boxes_;
  std::uint32_t leaf_size_;
  std::vector<BoxTree::Node>& nodes_;
  std::vector<std::uint32_t>& items_;
};

}  // namespace

BoxTree::BoxTree(std::span<const Box> boxes, std::uint32_t leaf_size) : items_(boxes.size()) {
  std::iota(items_.begin(), items_.end(), 0u);
  if (!boxes.empty()) Build(boxes, leaf_size, nodes_, items_).subtree(0, static_cast<std::uint32_t>(boxes.size()));
}

}  // namespace interflect::geometry
