#include "results/factor_store.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "factor_matrix.h"
#include "factor_stores.h"
#include "full_disk.h"
#include "results/output_directory.h"
#include "tests/support/temporary_folder.h"

using namespace interflect;
using namespace interflect::results;
using test::expect_holds;
using test::fill;
using test::FullDisk;
using test::key;
using test::Matrix;
using test::message_of;
using test::write_store;
using test::write_tile;

// What a store cannot be, is not, or has no room to become: told in one line.

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
