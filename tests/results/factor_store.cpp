#include "results/factor_store.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstring>
#include <fstream>
#include <thread>

#include "factor_matrix.h"
#include "full_disk.h"
#include "results/output_directory.h"
#include "scene/builder.h"
#include "tests/support/temporary_folder.h"

using namespace interflect;
using namespace interflect::results;
using test::FullDisk;
using test::Matrix;
using test::message_of;

namespace {

const FactorStoreKey key{"0123", "{\"method\": \"analytic\"}\n"};

void write_tile(FactorStoreWriter& store, const Matrix& matrix, Index I, Index J) {
  const auto i0 = static_cast<std::size_t>(store.first(I)), j0 = static_cast<std::size_t>(store.first(J));
  const auto rows = static_cast<std::size_t>(store.count(I)), columns = static_cast<std::size_t>(store.count(J));
  store.write(I, J, matrix.tile(matrix.K, i0, j0, rows, columns), matrix.tile(matrix.error, i0, j0, rows, columns));
}

/// Writes what is not done, but no more than `most` tiles; returns how many.
Index fill(FactorStoreWriter& store, const Matrix& matrix, Index most = 1000000) {
  Index written = 0;
  for (Index I = 0; I < store.tiles_across(); ++I)
    for (Index J = I; J < store.tiles_across(); ++J) {
      if (written == most || store.is_done(I, J)) continue;
      write_tile(store, matrix, I, J);
      ++written;
    }
  return written;
}

void write_store(const std::filesystem::path& file, const Matrix& matrix, Index tile) {
  FactorStoreWriter store(file, matrix.elements, key, tile);
  fill(store, matrix);
  store.finish();
}

void expect_holds(const std::filesystem::path& file, const Matrix& matrix) {
  const FactorStore store(file);
  const std::size_t n = matrix.size;
  ASSERT_EQ(store.size(), static_cast<Index>(n));
  EXPECT_EQ(store.key().digest, key.digest);
  EXPECT_EQ(store.key().settings, key.settings);
  EXPECT_EQ(store.elements().area, matrix.elements.area);
  EXPECT_EQ(store.elements().normal, matrix.elements.normal);
  EXPECT_EQ(store.elements().centroid, matrix.elements.centroid);
  EXPECT_EQ(store.elements().name, matrix.elements.name);
  std::vector<double> K(n * n), error(n * n), F(n), bound(n);
  store.read_rows(0, store.size(), K, error);
  EXPECT_EQ(K, matrix.K) << "to the last bit";
  const FactorRows rows = store.rows();
  for (std::size_t i = 0; i < n; ++i) {
    double sum = 0, sum_error = 0;
    rows(static_cast<Index>(i), F, bound);
    for (std::size_t j = 0; j < n; ++j) {
      const double given = matrix.error[i * n + j], kept = error[i * n + j];
      EXPECT_GE(kept, given) << "a bound stays one";
      EXPECT_LE(kept, given * (1 + 2e-7));
      EXPECT_EQ(F[j], matrix.K[i * n + j] / matrix.elements.area[i]);
      sum += F[j], sum_error += bound[j];
    }
    EXPECT_NEAR(store.row_sum()[i], sum, 1e-14 * sum);
    EXPECT_NEAR(store.row_error()[i], sum_error, 1e-14 * sum_error);
  }
}

}  // namespace

TEST(FactorStore, gives_back_what_was_written_to_the_last_bit) {
  const test::TemporaryFolder scratch;
  for (const std::size_t n : {0, 1, 5, 23})
    for (const Index tile : {1, 4, 5, 512}) {
      const Matrix matrix(n);
      write_store(scratch / "F.h5", matrix, tile);
      expect_holds(scratch / "F.h5", matrix);
      EXPECT_EQ(scratch.files(), 1u) << n << " elements in tiles of " << tile;
    }
}

TEST(FactorStore, keeps_what_reaches_no_element_and_goes_on_with_no_other) {
  const test::TemporaryFolder scratch;
  Matrix matrix(5);
  matrix.elements.environment = {0, 0.1, 0.2, 0.3, 1};
  matrix.elements.environment_error = {0, 1e-3, 1e-3, 1e-3, 0};
  { FactorStoreWriter begun(scratch / "F.h5", matrix.elements, key, 4); }
  Matrix other = matrix;
  other.elements.environment[1] = 0.11;
  for (const Matrix& wrong : {Matrix(5), other})
    EXPECT_NE(message_of([&] { FactorStoreWriter(scratch / "F.h5", wrong.elements, key, 4); }), "");
  write_store(scratch / "F.h5", matrix, 4);
  const FactorStore store(scratch / "F.h5");
  EXPECT_EQ(store.elements().environment, matrix.elements.environment);
  EXPECT_EQ(store.elements().environment_error, matrix.elements.environment_error);
}

TEST(FactorStore, rows_are_read_from_anywhere) {
  const test::TemporaryFolder scratch;
  const Matrix matrix(23);
  write_store(scratch / "F.h5", matrix, 4);
  const FactorStore store(scratch / "F.h5");
  std::vector<double> K(9 * 23), error(9 * 23);
  store.read_rows(3, 9, K, error);
  EXPECT_EQ(K, matrix.tile(matrix.K, 3, 0, 9, 23));
  EXPECT_THROW(store.read_rows(15, 9, K, error), core::PreconditionError);
}

TEST(FactorStore, goes_on_where_it_was_interrupted) {
  const test::TemporaryFolder scratch;
  const Matrix matrix(23);
  {
    FactorStoreWriter store(scratch / "F.h5", matrix.elements, key, 4);
    EXPECT_EQ(store.tiles(), 21);
    EXPECT_EQ(fill(store, matrix, 8), 8);
    EXPECT_THROW(store.finish(), core::PreconditionError);
  }
  EXPECT_FALSE(std::filesystem::exists(scratch / "F.h5"));
  FactorStoreWriter store(scratch / "F.h5", matrix.elements, key, 512);
  EXPECT_EQ(store.tile(), 4) << "as it was begun";
  EXPECT_EQ(store.done(), 8);
  EXPECT_TRUE(store.is_done(0, 0));
  EXPECT_FALSE(store.is_done(5, 5));
  EXPECT_EQ(fill(store, matrix), 13);
  store.finish();
  expect_holds(scratch / "F.h5", matrix);
  EXPECT_EQ(scratch.files(), 1u);
}

TEST(FactorStore, a_killed_process_loses_no_tile_that_it_had_written) {
  const test::TemporaryFolder scratch;
  const Matrix matrix(40);
  for (int round = 0; round < 4; ++round) {
    int pipe[2];
    ASSERT_EQ(::pipe(pipe), 0);
    const pid_t child = ::fork();
    if (child == 0) {
      FactorStoreWriter store(scratch / "F.h5", matrix.elements, key, 8);
      fill(store, matrix, 3);
      const char ready = '!';
      if (::write(pipe[1], &ready, 1) != 1) ::_exit(1);
      for (;;) ::pause();
    }
    char ready = 0;
    ASSERT_EQ(::read(pipe[0], &ready, 1), 1);
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    ::close(pipe[0]);
    ::close(pipe[1]);
  }
  FactorStoreWriter store(scratch / "F.h5", matrix.elements, key, 8);
  EXPECT_EQ(store.done(), 12);
  EXPECT_EQ(fill(store, matrix), 3);
  store.finish();
  expect_holds(scratch / "F.h5", matrix);
}

TEST(FactorStore, is_filled_by_many_threads) {
  const test::TemporaryFolder scratch;
  const Matrix matrix(64);
  FactorStoreWriter store(scratch / "F.h5", matrix.elements, key, 8);
  std::vector<std::thread> threads;
  for (Index t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      for (Index I = 0; I < 8; ++I)
        for (Index J = I; J < 8; ++J)
          if ((I + J) % 4 == t) write_tile(store, matrix, I, J);
    });
  for (std::thread& thread : threads) thread.join();
  store.finish();
  expect_holds(scratch / "F.h5", matrix);
}

TEST(FactorStore, tiles_of_zeros_take_no_space) {
  const test::TemporaryFolder scratch;
  Matrix matrix(1024);
  std::fill(matrix.K.begin(), matrix.K.end(), 0);
  std::fill(matrix.error.begin(), matrix.error.end(), 0);
  write_store(scratch / "F.h5", matrix, 128);
  expect_holds(scratch / "F.h5", matrix);
}

TEST(FactorStore, of_another_geometry_or_other_settings_is_refused_in_one_line) {
  const test::TemporaryFolder scratch;
  const Matrix matrix(5), other(6);
  const std::string partial = (scratch / "F.h5.partial").string();
  { FactorStoreWriter store(scratch / "F.h5", matrix.elements, key); }
  EXPECT_EQ(message_of([&] {
              FactorStoreWriter(scratch / "F.h5", matrix.elements, {"4567", key.settings});
            }),
            partial + ": its view factors are of another geometry (digest 0123, not 4567)");
  EXPECT_EQ(message_of([&] {
              FactorStoreWriter(scratch / "F.h5", matrix.elements, {"0123", "{}"});
            }),
            partial + ": it was begun with other settings (remove it to begin anew, or repeat them to go on)");
  EXPECT_EQ(message_of([&] { FactorStoreWriter(scratch / "F.h5", other.elements, key); }),
            partial +
                ": it was begun with 5 elements, and this run has 6 (remove it to begin anew, or repeat the "
                "options to go on)");
  EXPECT_EQ(message_of([&] { FactorStore{scratch / "F.h5.partial"}; }),
            partial + ": it is not finished: the run that computes it can be repeated to go on");
  write_store(scratch / "G.h5", matrix, 512);
  const FactorStore store(scratch / "G.h5");
  EXPECT_EQ(message_of([&] { store.require_geometry("0123"); }), "");
  EXPECT_EQ(message_of([&] { store.require_geometry("89ab"); }),
            (scratch / "G.h5").string() + ": its view factors are of another geometry (digest 0123, not 89ab)");
}

TEST(FactorStore, files_that_are_none_are_refused_in_one_line_and_hdf5_prints_nothing) {
  const test::TemporaryFolder scratch;
  const auto said = [&](const std::string& name) {
    testing::internal::CaptureStderr();
    std::string message = message_of([&] { FactorStore{scratch / name}; });
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    const std::string place = (scratch / name).string() + ": ";
    EXPECT_TRUE(message.starts_with(place)) << message;
    return message.substr(std::min(place.size(), message.size()));
  };
  EXPECT_EQ(said("nothing.h5"), "there is no such file");
  scratch.write("text.h5", "i,j,F,error\n");
  scratch.write("empty.h5", "");
  EXPECT_EQ(said("text.h5"), "this is not an HDF5 file");
  EXPECT_EQ(said("empty.h5"), "this is not an HDF5 file");
  std::filesystem::create_directory(scratch / "folder.h5");
  EXPECT_EQ(said("folder.h5"), "this is not a regular file");
  { Hdf5File::create(scratch / "foreign.h5", {}).make_doubles("area", {3}); }
  EXPECT_EQ(said("foreign.h5"), "this HDF5 file holds no view factors");
  { Hdf5File::create(scratch / "later.h5", {}).write_note("format", "interflect/view-factors/2"); }
  EXPECT_EQ(said("later.h5"), "'interflect/view-factors/1' is expected, not 'interflect/view-factors/2'");
}

TEST(FactorStore, every_truncation_and_every_flipped_byte_is_read_or_refused_in_one_line) {
  const test::TemporaryFolder scratch;
  const Matrix matrix(5);
  write_store(scratch / "F.h5", matrix, 2);
  const std::string bytes = test::read_file(scratch / "F.h5");
  for (std::size_t size = 0; size < bytes.size(); size += 37) {
    scratch.write("cut.h5", bytes.substr(0, size));
    const std::string said = message_of([&] { FactorStore{scratch / "cut.h5"}; });
    EXPECT_TRUE(said.starts_with((scratch / "cut.h5").string() + ": "))
        << size << " of " << bytes.size() << ": " << said;
  }
  // In a process of its own: of what is damaged the library loses memory, which a sanitizer would find at our end.
  const pid_t child = ::fork();
  if (child == 0) {
    bool good = true;
    for (std::size_t at = 0; at < bytes.size(); at += 11) {
      std::string changed = bytes;
      changed[at] = static_cast<char>(changed[at] ^ 0x55);
      scratch.write("changed.h5", changed);
      const std::string said = message_of([&] {
        const FactorStore store(scratch / "changed.h5");
        std::vector<double> K(static_cast<std::size_t>(store.size() * store.size())), error(K.size());
        store.read_rows(0, store.size(), K, error);
      });
      good = good && !said.starts_with("MORE");
    }
    ::_exit(good ? 0 : 1);
  }
  int status = -1;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
}

TEST(FactorStore, what_a_stopped_run_left_is_called_damaged_where_it_is_cut) {
  const test::TemporaryFolder scratch;
  const Matrix matrix(5);
  { FactorStoreWriter store(scratch / "F.h5", matrix.elements, key, 2); }
  const std::string partial = (scratch / "F.h5.partial").string(), bytes = test::read_file(partial);
  for (const std::size_t size : {std::size_t{0}, std::size_t{100}, bytes.size() / 2, bytes.size() - 1}) {
    scratch.write("F.h5.partial", bytes.substr(0, size));
    EXPECT_EQ(message_of([&] { FactorStoreWriter(scratch / "F.h5", matrix.elements, key, 2); }),
              partial + ": it is damaged or cut short: remove it to begin anew")
        << size;
  }
  scratch.write("cut.h5", bytes.substr(0, bytes.size() / 2));
  EXPECT_EQ(message_of([&] { FactorStore{scratch / "cut.h5"}; }),
            (scratch / "cut.h5").string() + ": cannot be opened: the file is damaged or cut short");
}

TEST(FactorStore, a_full_disk_leaves_no_half_file) {
  const test::TemporaryFolder scratch;
  const Matrix matrix(64);
  {
    const FullDisk full(20000);
    EXPECT_EQ(message_of([&] { FactorStoreWriter(scratch / "F.h5", matrix.elements, key, 16); }),
              (scratch / "F.h5.partial.new").string() + ": cannot be written: File too large");
  }
  EXPECT_EQ(scratch.files(), 0u);
  EXPECT_EQ(message_of([&] { FactorStoreWriter(scratch / "no/F.h5", matrix.elements, key); }),
            (scratch / "no/F.h5.partial.new").string() + ": cannot be written: No such file or directory");
  EXPECT_EQ(message_of([&] { FactorStoreWriter(scratch.path(), matrix.elements, key); }),
            scratch.path().string() + ": cannot be written: Is a directory");
}

TEST(FactorStore, tiles_that_a_full_disk_refuses_can_be_written_later) {
  const test::TemporaryFolder scratch;
  const Matrix matrix(64);
  FactorStoreWriter store(scratch / "F.h5", matrix.elements, key, 16);
  {
    const FullDisk full(1000);
    EXPECT_EQ(message_of([&] { write_tile(store, matrix, 0, 1); }),
              (scratch / "F.h5.partial").string() + ": cannot be written: File too large");
  }
  EXPECT_EQ(store.done(), 0);
  fill(store, matrix);
  store.finish();
  expect_holds(scratch / "F.h5", matrix);
}

TEST(FactorStore, has_many_tiles_wherever_there_are_many_elements) {
  EXPECT_EQ(usual_tile(20'000), 512);
  EXPECT_EQ(usual_tile(4'656), 146);
  EXPECT_EQ(usual_tile(181), 16);
  EXPECT_EQ(usual_tile(0), 16);
  const test::TemporaryFolder scratch;
  FactorStoreWriter store(scratch / "F.h5", Matrix(181).elements, key);
  EXPECT_EQ(store.tiles_across(), 12);
}

TEST(FactorStore, what_cannot_be_a_tile_is_a_bug) {
  const test::TemporaryFolder scratch;
  const Matrix matrix(5);
  FactorStoreWriter store(scratch / "F.h5", matrix.elements, key, 2);
  const std::vector<double> four(4), bad{0, 0, 0, std::nan("")};
  EXPECT_THROW(store.write(1, 0, four, four), core::PreconditionError);
  EXPECT_THROW(store.write(0, 3, four, four), core::PreconditionError);
  EXPECT_THROW(store.write(0, 2, four, four), core::PreconditionError);
  EXPECT_THROW(store.write(0, 1, bad, four), core::PreconditionError);
  EXPECT_THROW(store.write(0, 1, four, bad), core::PreconditionError);
  EXPECT_THROW(FactorStoreWriter(scratch / "G.h5", matrix.elements, key, -1), core::PreconditionError);
}

TEST(GeometryDigest, tells_shapes_apart_and_nothing_else) {
  const auto digest = [](double height, const char* name, scene::Side side) {
    scene::SceneBuilder builder({"y"});
    scene::Material material;
    const auto id = builder.add_material(material);
    const geometry::Ring ring{{0, 0, height}, {1, 0, height}, {1, 1, height}};
    builder.add_polygon(name, {ring, {}}, id);
    const scene::Scene scene = builder.finish();
    const std::vector<scene::SurfacePatch> patches{scene::make_patch(scene::SurfaceId{0}, side, ring)};
    return geometry_digest(scene, patches);
  };
  using scene::Side;
  const std::string one = digest(0, "a", Side::front);
  EXPECT_EQ(one.size(), 32u);
  EXPECT_EQ(digest(-0.0, "b", Side::front), one);
  EXPECT_NE(digest(5e-324, "a", Side::front), one);
  EXPECT_NE(digest(0, "a", Side::back), one);
}

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

TEST(FactorStore, of_which_the_disk_has_no_room_is_not_begun) {
  const test::TemporaryFolder scratch;
  EXPECT_EQ(message_of([&] { require_disk_room(scratch.path(), 1); }), "");
  const std::string said = message_of([&] { require_disk_room(scratch.path(), 1e24); });
  EXPECT_TRUE(said.starts_with(scratch.path().string() + ": up to 1000000000000000.0 GB are needed, and its disk has "))
      << said;
  const double bytes = factor_store_bytes(20000, 0);
  EXPECT_GT(bytes, 6.0 * 20000 * 20000);
  EXPECT_LT(bytes, 6.6 * 20000 * 20000);
}
