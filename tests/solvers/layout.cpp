#include "solvers/layout.h"

#include <gtest/gtest.h>

using namespace interflect;
using solvers::Layout;

TEST(Layout, knows_the_element_of_every_unknown) {
  const Layout layout = Layout::uniform(5, 3);
  EXPECT_EQ(layout.elements(), 5);
  EXPECT_EQ(layout.unknowns(), 15);
  EXPECT_EQ(layout.owned_begin, 0);
  EXPECT_EQ(layout.owned_end, 15);
  for (Index a = 0; a < 15; ++a) EXPECT_EQ(layout.element_of(a), a / 3);
}

TEST(Layout, allows_elements_with_different_numbers_of_functions) {
  const Layout layout{{0, 1, 1, 4}, 0, 4};
  EXPECT_EQ(layout.element_of(0), 0);
  EXPECT_EQ(layout.element_of(1), 2) << "element 1 has none";
  EXPECT_EQ(layout.element_of(3), 2);
}
