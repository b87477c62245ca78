#include "results/factor_store.h"

#include <gtest/gtest.h>

#include "factor_matrix.h"
#include "factor_stores.h"
#include "tests/support/temporary_folder.h"

using namespace interflect;
using namespace interflect::results;
using test::expect_holds;
using test::fill;
using test::key;
using test::Matrix;
using test::message_of;

namespace {

std::vector<measure::SensorPoint> three_points() {
  return {{"desk, \"left\"", 0, {Vec3(1, 2, 3), Vec3::UnitZ(), std::nullopt}},
          {"desk, \"left\"", 1, {Vec3(1e-300, 2, 3), Vec3::UnitZ(), std::nullopt}},
          {"wall", 0, {Vec3(0, 0, 1), Vec3::UnitX(), std::nullopt}}};
}
/// Row s of any numbers.
std::vector<double> point_row(std::size_t elements, std::size_t s) {
  std::vector<double> row;
  for (std::size_t j = 0; j < elements; ++j) row.push_back(1.0 / static_cast<double>(3 + s + j));
  return row;
}

}  // namespace

TEST(FactorStore, holds_rows_of_sensor_points_to_the_last_bit) {
  const test::TemporaryFolder scratch;
  const Matrix matrix(5);
  const auto points = three_points();
  {
    FactorStoreWriter store(scratch / "F.h5", matrix.elements, key, 2, points);
    fill(store, matrix);
    for (Index s : {2, 0}) store.write_point(s, point_row(5, static_cast<std::size_t>(s)), point_row(5, 9));
    EXPECT_THROW(store.finish(), core::PreconditionError) << "a point is missing";
    EXPECT_THROW(store.write_point(3, point_row(5, 0), point_row(5, 0)), core::PreconditionError);
    EXPECT_THROW(store.write_point(0, point_row(6, 0), point_row(6, 0)), core::PreconditionError);
    store.write_point(1, point_row(3, 1), point_row(3, 9));  // of the first elements: the rest is 0
    store.finish();
  }
  expect_holds(scratch / "F.h5", matrix);
  const FactorStore store(scratch / "F.h5");
  EXPECT_TRUE(same_points(store.points(), points));
  std::vector<double> F(5), error(5);
  store.point_factors().rows(2, F, error);
  EXPECT_EQ(F, point_row(5, 2));
  EXPECT_EQ(error, point_row(5, 9));
  store.point_factors().rows(1, F, error);
  EXPECT_EQ(F, (std::vector<double>{1.0 / 4, 1.0 / 5, 1.0 / 6, 0, 0}));
}

TEST(FactorStore, goes_on_with_the_rows_of_sensor_points_and_refuses_other_sensors) {
  const test::TemporaryFolder scratch;
  const Matrix matrix(5);
  auto points = three_points();
  {
    FactorStoreWriter store(scratch / "F.h5", matrix.elements, key, 2, points);
    store.write_point(1, point_row(5, 1), point_row(5, 9));
  }
  points[2].at.position.z() = std::nextafter(1.0, 2.0);
  EXPECT_EQ(message_of([&] { FactorStoreWriter(scratch / "F.h5", matrix.elements, key, 2, points); }),
            (scratch / "F.h5.partial").string() + ": it was begun with other sensors (remove it to begin anew)");
  EXPECT_NE(message_of([&] { FactorStoreWriter(scratch / "F.h5", matrix.elements, key, 2); }), "");
  points[2].at.position.z() = 1;
  FactorStoreWriter store(scratch / "F.h5", matrix.elements, key, 2, points);
  EXPECT_FALSE(store.is_point_done(0));
  EXPECT_TRUE(store.is_point_done(1));
}
