#include "results/factor_store.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <thread>

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
using test::write_store;
using test::write_tile;

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

TEST(FactorStore, has_many_tiles_wherever_there_are_many_elements) {
  EXPECT_EQ(usual_tile(20'000), 512);
  EXPECT_EQ(usual_tile(4'656), 146);
  EXPECT_EQ(usual_tile(181), 16);
  EXPECT_EQ(usual_tile(0), 16);
  const test::TemporaryFolder scratch;
  FactorStoreWriter store(scratch / "F.h5", Matrix(181).elements, key);
  EXPECT_EQ(store.tiles_across(), 12);
}
