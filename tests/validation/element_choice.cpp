#include "validation/element_choice.h"

#include <gtest/gtest.h>

#include <map>
#include <numeric>
#include <set>

using namespace interflect::validation;

namespace {

/// Surfaces of 1, 10, 100 and 1 000 elements; areas inside each over a factor of three.
struct Elements {
  std::vector<double> areas;
  std::vector<std::uint32_t> surface;
  Elements() {
    for (std::uint32_t s = 0, n = 1; s < 4; ++s, n *= 10)
      for (std::uint32_t i = 0; i < n; ++i) {
        areas.push_back(0.01 * (1 + 2.0 * (i % 7) / 6));
        surface.push_back(s);
      }
  }
  double area() const { return std::accumulate(areas.begin(), areas.end(), 0.0); }
};

}  // namespace

TEST(ElementChoice, every_surface_is_seen_and_represented_areas_sum_to_each_surface) {
  const Elements e;
  for (std::size_t count : {4u, 10u, 57u, 500u, 1110u}) {
    const auto chosen = choose_elements(e.areas, e.surface, count, 3);
    ASSERT_EQ(chosen.size(), count);
    std::map<std::uint32_t, double> represented, whole;
    for (std::size_t i = 0; i < e.areas.size(); ++i) whole[e.surface[i]] += e.areas[i];
    std::set<std::int64_t> distinct;
    for (const ChosenElement& c : chosen) {
      represented[e.surface[static_cast<std::size_t>(c.element)]] += c.represented_area;
      distinct.insert(c.element);
    }
    EXPECT_EQ(distinct.size(), count);
    for (const auto& [surface, area] : whole) EXPECT_NEAR(represented[surface], area, 1e-12 * e.area()) << count;
  }
}

TEST(ElementChoice, all_elements_stand_for_themselves) {
  const Elements e;
  const auto chosen = choose_elements(e.areas, e.surface, 100000, 3);
  ASSERT_EQ(chosen.size(), e.areas.size());
  for (std::size_t i = 0; i < chosen.size(); ++i) EXPECT_EQ(chosen[i].represented_area, e.areas[i]);
}

TEST(ElementChoice, fewer_elements_than_surfaces_still_represent_the_whole_area) {
  std::vector<double> areas(100, 0.5);
  std::vector<std::uint32_t> surface(100);
  std::iota(surface.begin(), surface.end(), 0u);
  const auto chosen = choose_elements(areas, surface, 7, 3);
  ASSERT_EQ(chosen.size(), 7u);
  double represented = 0;
  for (const ChosenElement& c : chosen) represented += c.represented_area;
  EXPECT_NEAR(represented, 50, 1e-12);
}

TEST(ElementChoice, the_seed_alone_decides_and_each_element_has_its_chance) {
  const Elements e;
  const auto same = [&](std::uint64_t a, std::uint64_t b) {
    const auto x = choose_elements(e.areas, e.surface, 57, a), y = choose_elements(e.areas, e.surface, 57, b);
    for (std::size_t i = 0; i < x.size(); ++i)
      if (x[i].element != y[i].element) return false;
    return true;
  };
  EXPECT_TRUE(same(3, 3));
  EXPECT_FALSE(same(3, 4));
  std::set<std::int64_t> seen;
  for (std::uint64_t seed = 0; seed < 400; ++seed)
    for (const ChosenElement& c : choose_elements(e.areas, e.surface, 57, seed)) seen.insert(c.element);
  EXPECT_EQ(seen.size(),
            e.areas.size());  // each has a chance of 1/20: missing one of 1 111 in 400 draws has probability 1e-6
}
