#include "geometry/box_tree.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "shapes.h"

namespace interflect::geometry {
namespace {

std::vector<std::uint32_t> found(const BoxTree& tree, const std::vector<Box>& boxes, const Box& query) {
  std::vector<std::uint32_t> items;
  tree.traverse([&](const Box& box) { return box.intersects(query); },
                [&](std::uint32_t item) {
                  if (boxes[item].intersects(query)) items.push_back(item);
                });
  std::sort(items.begin(), items.end());
  return items;
}

TEST(BoxTree, finds_what_a_look_at_every_box_finds) {
  test::Dice dice(40);
  for (const int count : {0, 1, 4, 5, 1000}) {
    std::vector<Box> boxes;
    for (int k = 0; k < count; ++k) {
      const Vec3 low = dice.point(10);
      boxes.emplace_back(low, low + Vec3(dice.in(0, 2), dice.in(0, 2), 0));  // flat ones too
    }
    const BoxTree tree(boxes);
    for (int q = 0; q < 100; ++q) {
      const Vec3 low = dice.point(10);
      const Box query(low, low + Vec3::Constant(3));
      std::vector<std::uint32_t> all;
      for (std::uint32_t k = 0; k < boxes.size(); ++k)
        if (boxes[k].intersects(query)) all.push_back(k);
      EXPECT_EQ(found(tree, boxes, query), all);
    }
  }
}

TEST(BoxTree, a_thousand_equal_boxes_are_split_like_any_others) {
  const std::vector<Box> boxes(1000, Box(Vec3::Zero(), Vec3::Ones()));
  const BoxTree tree(boxes);
  EXPECT_EQ(found(tree, boxes, boxes[0]).size(), 1000u);
  for (const auto& node : tree.nodes()) EXPECT_LE(node.count, 4u);
}

}  // namespace
}  // namespace interflect::geometry
