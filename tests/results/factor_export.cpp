#include "results/factor_export.h"

#include <gtest/gtest.h>

#include <cstring>
#include <sstream>

#include "factor_matrix.h"
#include "full_disk.h"
#include "results/npz_file.h"
#include "tests/support/temporary_folder.h"

using namespace interflect;
using namespace interflect::results;
using test::FullDisk;
using test::Matrix;
using test::message_of;

namespace {

std::uint64_t number_at(const std::string& bytes, std::size_t at, int size) {
  std::uint64_t value = 0;
  for (int k = size; k-- > 0;)
    value = value << 8 | static_cast<unsigned char>(bytes.at(at + static_cast<std::size_t>(k)));
  return value;
}

/// CRC-32 as the standard defines it, bit by bit.
std::uint32_t crc_of(const std::string& bytes) {
  std::uint32_t crc = ~0u;
  for (const char c : bytes) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) crc = crc & 1 ? crc >> 1 ^ 0xEDB88320u : crc >> 1;
  }
  return ~crc;
}

/// An array of an .npz file, found through the zip file's directory, as other programs find it.
struct Array {
  std::string header, data;
};

std::vector<std::pair<std::string, Array>> arrays_of(const std::string& zip) {
  std::vector<std::pair<std::string, Array>> out;
  const std::size_t end = zip.size() - 22;
  EXPECT_EQ(zip.substr(end, 4), "PK\5\6");
  std::uint64_t at = number_at(zip, end + 16, 4);
  if (at == 0xFFFFFFFFu) {
    EXPECT_EQ(zip.substr(end - 20, 4), "PK\6\7");
    const std::uint64_t record = number_at(zip, end - 20 + 8, 8);
    EXPECT_EQ(zip.substr(record, 4), "PK\6\6");
    at = number_at(zip, record + 48, 8);
  }
  for (std::uint64_t k = 0; k < number_at(zip, end + 10, 2); ++k) {
    EXPECT_EQ(zip.substr(at, 4), "PK\1\2");
    std::uint64_t size = number_at(zip, at + 24, 4), position = number_at(zip, at + 42, 4);
    const std::uint64_t name_length = number_at(zip, at + 28, 2), extra_length = number_at(zip, at + 30, 2);
    const std::string name = zip.substr(at + 46, name_length);
    std::size_t extra = at + 46 + name_length + 4;
    if (size == 0xFFFFFFFFu) size = number_at(zip, extra, 8), extra += 16;
    if (position == 0xFFFFFFFFu) position = number_at(zip, extra, 8);
    EXPECT_EQ(zip.substr(position, 4), "PK\3\4");
    EXPECT_EQ(number_at(zip, position + 14, 4), number_at(zip, at + 16, 4)) << "the same checksum in both places";
    const std::uint64_t start = position + 30 + number_at(zip, position + 26, 2) + number_at(zip, position + 28, 2);
    const std::string npy = zip.substr(start, size);
    EXPECT_EQ(crc_of(npy), number_at(zip, at + 16, 4)) << name;
    EXPECT_EQ(npy.substr(0, 8), std::string("\x93NUMPY\1\0", 8));
    const std::size_t header = number_at(npy, 8, 2);
    EXPECT_EQ((header + 10) % 64, 0u);
    out.push_back({name, {npy.substr(10, header), npy.substr(10 + header)}});
    at += 46 + name_length + extra_length;
  }
  return out;
}

std::vector<double> doubles(const std::string& data) {
  std::vector<double> out(data.size() / sizeof(double));
  if (!out.empty()) std::memcpy(out.data(), data.data(), data.size());
  return out;
}

std::vector<double> over_area(const Matrix& matrix, const std::vector<double>& values) {
  std::vector<double> out;
  for (std::size_t k = 0; k < values.size(); ++k) out.push_back(values[k] / matrix.elements.area[k / matrix.size]);
  return out;
}

}  // namespace

TEST(FactorExport, npz_holds_every_array_to_the_last_bit) {
  const test::TemporaryFolder scratch;
  for (const std::size_t n : {0, 1, 5}) {
    const Matrix matrix(n);
    write_factors_npz(scratch / "F.npz", matrix.elements, matrix.rows());
    const auto arrays = arrays_of(test::read_file(scratch / "F.npz"));
    ASSERT_EQ(arrays.size(), 8u);
    const std::vector<std::string> names{"F", "error", "area", "normal", "centroid", "row_sum", "row_error", "name"};
    for (std::size_t k = 0; k < names.size(); ++k) EXPECT_EQ(arrays[k].first, names[k] + ".npy");
    const std::string size = std::to_string(n);
    EXPECT_TRUE(arrays[0].second.header.starts_with("{'descr': '<f8', 'fortran_order': False, 'shape': (" + size +
                                                    ", " + size + "), }"))
        << arrays[0].second.header;
    EXPECT_TRUE(
        arrays[2].second.header.starts_with("{'descr': '<f8', 'fortran_order': False, 'shape': (" + size + ",), }"));
    EXPECT_EQ(doubles(arrays[0].second.data), over_area(matrix, matrix.K));
    EXPECT_EQ(doubles(arrays[1].second.data), over_area(matrix, matrix.error));
    EXPECT_EQ(doubles(arrays[2].second.data), matrix.elements.area);
    for (std::size_t i = 0; i < n; ++i)
      EXPECT_EQ(doubles(arrays[4].second.data)[3 * i + 2], matrix.elements.centroid[i].z());
    if (n == 5) {
      EXPECT_TRUE(arrays[7].second.header.starts_with("{'descr': '<U12'")) << arrays[7].second.header;
      EXPECT_EQ(number_at(arrays[7].second.data, 4 * (2 * 12 + 1), 4), 0xF6u) << "the o with dots in the third name";
    }
  }
  EXPECT_EQ(scratch.files(), 1u);
}

TEST(FactorExport, npz_of_more_than_4_gib_would_use_zip64) {
  const test::TemporaryFolder scratch;
  const std::vector<double> numbers{1, 2, 3};
  for (const std::uint64_t from : {0, 1, 150, 300}) {
    NpzFile npz(scratch / "F.npz", from);
    npz.add("a", numbers, {3});
    npz.add("b", numbers, {1, 3});
    npz.keep();
    const auto arrays = arrays_of(test::read_file(scratch / "F.npz"));
    ASSERT_EQ(arrays.size(), 2u);
    EXPECT_EQ(doubles(arrays[0].second.data), numbers);
    EXPECT_EQ(doubles(arrays[1].second.data), numbers);
  }
}

TEST(FactorExport, npz_arrays_that_are_not_filled_are_a_bug) {
  const test::TemporaryFolder scratch;
  NpzFile npz(scratch / "F.npz");
  npz.begin("a", "<f8", 8, {2});
  EXPECT_THROW(npz.end(), core::PreconditionError);
  EXPECT_THROW(npz.put(std::string(17, 'x')), core::PreconditionError);
  EXPECT_THROW(npz.keep(), core::PreconditionError);
}

TEST(FactorExport, matrix_market_counts_from_one_and_names_every_double) {
  const test::TemporaryFolder scratch;
  for (const std::size_t n : {0, 1, 5}) {
    const Matrix matrix(n);
    write_factors_mtx(scratch / "F.mtx", matrix.elements, matrix.rows());
    std::istringstream text(test::read_file(scratch / "F.mtx"));
    std::string line;
    std::getline(text, line);
    EXPECT_EQ(line, "%%MatrixMarket matrix coordinate real general");
    std::getline(text, line);
    EXPECT_EQ(line[0], '%');
    std::size_t rows = 0, columns = 0, entries = 0, i = 0, j = 0;
    text >> rows >> columns >> entries;
    EXPECT_EQ(rows, n);
    EXPECT_EQ(columns, n);
    std::vector<double> F(n * n);
    for (std::size_t k = 0; k < entries; ++k) {
      std::string value;
      text >> i >> j >> value;
      F.at((i - 1) * n + j - 1) = std::stod(value);
    }
    EXPECT_EQ(F, over_area(matrix, matrix.K));
    EXPECT_FALSE(text >> line) << "no more than was promised";
  }
}

TEST(FactorExport, csv_names_every_double_and_leaves_out_what_is_zero) {
  const test::TemporaryFolder scratch;
  const Matrix matrix(5);
  write_factors_csv(scratch / "F.csv", matrix.elements, matrix.rows());
  std::istringstream text(test::read_file(scratch / "F.csv"));
  std::string line;
  std::getline(text, line);
  EXPECT_EQ(line, "i,j,F,error");
  std::vector<double> F(25), error(25);
  std::size_t lines = 0;
  for (; std::getline(text, line); ++lines) {
    std::size_t i = 0, j = 0;
    double value = 0, bound = 0;
    ASSERT_EQ(std::sscanf(line.c_str(), "%zu,%zu,%lf,%lf", &i, &j, &value, &bound), 4);
    F.at(5 * i + j) = value, error.at(5 * i + j) = bound;
  }
  EXPECT_EQ(lines, 20u) << "five pairs see nothing of each other";
  EXPECT_EQ(F, over_area(matrix, matrix.K));
  EXPECT_EQ(error, over_area(matrix, matrix.error));
}

// What is asked of the disk beforehand: enough, but for a heading, and not twice what is needed where every pair sees
// each other.
TEST(FactorExport, sizes_are_known_beforehand) {
  const test::TemporaryFolder scratch;
  const Matrix matrix(300);
  write_factors_csv(scratch / "F.csv", matrix.elements, matrix.rows());
  write_factors_mtx(scratch / "F.mtx", matrix.elements, matrix.rows());
  write_factors_npz(scratch / "F.npz", matrix.elements, matrix.rows());
  for (const char* name : {"F.csv", "F.mtx", "F.npz"}) {
    const auto bytes = static_cast<double>(std::filesystem::file_size(scratch / name)),
               most = most_export_bytes(scratch / name, 300, 0);
    EXPECT_LE(bytes, most + 50e3) << name;
    EXPECT_GT(bytes, 0.5 * most) << name;
  }
  EXPECT_EQ(most_export_bytes("F.h5", 300, 7), 0);
}

TEST(FactorExport, groups_are_sums_weighted_by_area_with_quoted_names) {
  const test::TemporaryFolder scratch;
  FactorElements elements;
  elements.area = {1, 3, 2};
  elements.normal = elements.centroid = {Vec3::UnitX(), Vec3::UnitX(), Vec3::UnitX()};
  elements.name = {"a, \"b\"", "c", "a, \"b\""};
  const FactorRows rows = [](Index i, std::span<double> F, std::span<double> error) {
    constexpr double K[3][3] = {{0, 0.375, 0.25}, {0.375, 0, 0}, {0.25, 0, 0}};
    constexpr double A[3] = {1, 3, 2};
    for (std::size_t j = 0; j < 3; ++j) F[j] = K[i][j] / A[i], error[j] = 0.5 * F[j];
  };
  write_grouped_factors_csv(scratch / "G.csv", elements, rows, elements.name);
  // K_ab,ab = 2 * 0.25, K_ab,c = 0.375; areas 3 and 3.
  EXPECT_EQ(test::read_file(scratch / "G.csv"),
            "from,to,F,error\n"
            "\"a, \"\"b\"\"\",\"a, \"\"b\"\"\",0.16666666666666666,0.083333333333333329\n"
            "\"a, \"\"b\"\"\",c,0.125,0.0625\n"
            "c,\"a, \"\"b\"\"\",0.125,0.0625\n");
  EXPECT_THROW(write_grouped_factors_csv(scratch / "G.csv", elements, rows, {}), core::PreconditionError);
}

// One more column: 0.6 and 0.2 of what each element sends.
TEST(FactorExport, an_environment_is_a_column_of_its_own) {
  const test::TemporaryFolder scratch;
  FactorElements elements;
  elements.area = {1, 2};
  elements.normal = elements.centroid = {Vec3::UnitX(), Vec3::UnitX()};
  elements.name = {"a", "a"};
  elements.environment = {0.5, 0.75};
  elements.environment_error = {0.25, 0.125};
  const FactorRows rows = [](Index i, std::span<double> F, std::span<double> error) {
    for (std::size_t j = 0; j < 2; ++j) F[j] = Index(j) == i ? 0 : 0.5 / double(i + 1), error[j] = 0;
  };
  write_factors_csv(scratch / "F.csv", elements, rows);
  EXPECT_EQ(test::read_file(scratch / "F.csv"),
            "i,j,F,error\n0,1,0.5,0\n0,environment,0.5,0.25\n1,0,0.25,0\n1,environment,0.75,0.125\n");
  write_grouped_factors_csv(scratch / "G.csv", elements, rows, elements.name);
  EXPECT_EQ(test::read_file(scratch / "G.csv"),
            "from,to,F,error\na,a,0.33333333333333331,0\na,environment,0.66666666666666663,0.16666666666666666\n");
  write_factors_npz(scratch / "F.npz", elements, rows);
  const auto arrays = arrays_of(test::read_file(scratch / "F.npz"));
  ASSERT_EQ(arrays.size(), 10u);
  EXPECT_EQ(arrays[8].first, "environment.npy");
  EXPECT_EQ(doubles(arrays[8].second.data), elements.environment);
  EXPECT_EQ(doubles(arrays[9].second.data), elements.environment_error);
}

TEST(FactorExport, points_are_rows_of_their_own_in_every_format) {
  const test::TemporaryFolder scratch;
  const Matrix matrix(3);
  const PointFactors points{{{"desk, left", 0, {Vec3(1, 2, 3), Vec3::UnitZ(), std::nullopt}},
                             {"wall", 7, {Vec3(0, 0, 1), Vec3::UnitX(), std::nullopt}}},
                            [](Index s, std::span<double> F, std::span<double> error) {
                              for (std::size_t j = 0; j < F.size(); ++j) {
                                F[j] = s == 0 ? 0 : 0.25 * static_cast<double>(j);
                                error[j] = s == 0 && j < 2 ? 0 : 0.5;
                              }
                            }};
  write_factors_npz(scratch / "F.npz", matrix.elements, matrix.rows(), points);
  const auto arrays = arrays_of(test::read_file(scratch / "F.npz"));
  std::vector<std::string> names;
  for (const auto& [name, array] : arrays) names.push_back(name);
  EXPECT_EQ(
      (std::vector<std::string>{names.begin() + 8, names.end()}),
      (std::vector<std::string>{"sensor_F.npy", "sensor_error.npy", "sensor_position.npy", "sensor_normal.npy",
                                "sensor_row_sum.npy", "sensor_row_error.npy", "sensor_index.npy", "sensor_name.npy"}));
  EXPECT_TRUE(arrays[8].second.header.starts_with("{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), }"));
  EXPECT_EQ(doubles(arrays[8].second.data), (std::vector<double>{0, 0, 0, 0, 0.25, 0.5}));
  EXPECT_EQ(doubles(arrays[12].second.data), (std::vector<double>{0, 0.75}));
  write_point_factors_mtx(scratch / "F.mtx", points, 3);
  const std::string mtx = test::read_file(scratch / "F.mtx");
  EXPECT_EQ(mtx.substr(mtx.find("\n2 3 ") + 1), "2 3                    2\n2 2 0.25\n2 3 0.5\n");
  write_point_factors_csv(scratch / "F.csv", points, 3);
  EXPECT_EQ(test::read_file(scratch / "F.csv"),
            "sensor,index,j,F,error\n\"desk, left\",0,2,0,0.5\nwall,7,0,0,0.5\nwall,7,1,0.25,0.5\nwall,7,2,0.5,0.5\n");
  const std::vector<std::string> group{"b", "a", "b"};
  write_grouped_point_factors_csv(scratch / "G.csv", points, group);
  EXPECT_EQ(test::read_file(scratch / "G.csv"),
            "sensor,index,to,F,error\n\"desk, left\",0,b,0,0.5\nwall,7,b,0.5,1\nwall,7,a,0.25,0.5\n");
}

TEST(FactorExport, a_full_disk_leaves_the_old_file_and_nothing_else) {
  const test::TemporaryFolder scratch;
  const Matrix matrix(40);
  const auto npz = [](const std::filesystem::path& file, const FactorElements& elements, const FactorRows& rows) {
    write_factors_npz(file, elements, rows);
  };
  using Write = std::function<void(const std::filesystem::path&, const FactorElements&, const FactorRows&)>;
  for (const Write& write : {Write(npz), Write(write_factors_mtx), Write(write_factors_csv)}) {
    scratch.write("F", "old");
    std::string message;
    {
      const FullDisk full(1000);
      message = message_of([&] { write(scratch / "F", matrix.elements, matrix.rows()); });
    }
    EXPECT_EQ(message, (scratch / "F").string() + ": cannot be written: File too large");
    EXPECT_EQ(test::read_file(scratch / "F"), "old");
    EXPECT_EQ(scratch.files(), 1u);
  }
}
