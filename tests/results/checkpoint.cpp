#include "results/checkpoint.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "core/error.h"
#include "tests/support/temporary_folder.h"

namespace interflect::results {
namespace {

using solvers::ColumnMatrix;
using test::TemporaryFolder;

Checkpoint some() {
  ColumnMatrix x = ColumnMatrix::Random(7, 3);
  x(2, 1) = -0.0;
  x(3, 0) = 5e-324;
  return {"digest", "settings", 1ull << 40, {{"x", x}, {"history", ColumnMatrix::Random(2, 5)}}};
}
/// The same without values.
Checkpoint expected() {
  return {"digest", "settings", 0, {{"x", ColumnMatrix(7, 3)}, {"history", ColumnMatrix(0, 5)}}};
}

TEST(Checkpoint, comes_back_to_the_bit) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder / "c.h5";
  const Checkpoint written = some();
  write_checkpoint(file, written);
  write_checkpoint(file, written);  // in place of the first
  const Checkpoint read = read_checkpoint(file, expected());
  EXPECT_EQ(read.step, 1ull << 40);
  for (const char* name : {"x", "history"}) {
    const ColumnMatrix &a = written.matrix(name), &b = read.matrix(name);
    ASSERT_EQ(a.size(), b.size());
    EXPECT_EQ(std::memcmp(a.data(), b.data(), sizeof(double) * static_cast<std::size_t>(a.size())), 0);
  }
  EXPECT_THROW(read.matrix("y"), core::PreconditionError);
  EXPECT_FALSE(std::filesystem::exists(folder / "c.h5.partial"));
}

TEST(Checkpoint, of_something_else_is_refused) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder / "c.h5";
  EXPECT_THROW(read_checkpoint(file, expected()), core::InputError);
  write_checkpoint(file, some());
  Checkpoint scene = expected(), settings = expected(), sizes = expected(), name = expected();
  scene.digest = "another";
  settings.settings = "others";
  sizes.matrices[0].values.resize(8, 3);
  name.matrices[0].name = "y";
  for (const Checkpoint& other : {scene, settings, sizes, name})
    EXPECT_THROW(read_checkpoint(file, other), core::InputError);
  Checkpoint broken = some();
  broken.matrices[0].values(1, 1) = std::numeric_limits<double>::quiet_NaN();
  write_checkpoint(file, broken);
  EXPECT_THROW(read_checkpoint(file, expected()), core::InputError);
  EXPECT_THROW(write_checkpoint(folder / "no/such/folder/c.h5", some()), core::InputError);
}

}  // namespace
}  // namespace interflect::results
