#include "results/factor_export.h"

#include <algorithm>
#include <charconv>
#include <memory>
#include <numeric>
#include <unordered_map>

#include "core/error.h"
#include "core/format.h"
#include "results/atomic_file.h"
#include "results/csv.h"
#include "results/npz_file.h"

namespace interflect::results {

namespace {

/// 17 significant digits, which name a double.
void append(std::string& out, double value) {
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, value, std::chars_format::general, 17).ptr;
  out.append(digits, end);
}

void append(std::string& out, std::size_t value) {
  char digits[24];
  out.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

/// A row of the matrix, and space for the next.
struct Row {
  explicit Row(std::size_t elements) : F(elements), error(elements) {}
  explicit Row(const FactorElements& elements) : Row(elements.area.size()) {}
  std::vector<double> F, error;
};

std::vector<double> flat(const std::vector<Vec3>& points) {
  std::vector<double> out;
  for (const Vec3& x : points) out.insert(out.end(), {x.x(), x.y(), x.z()});
  return out;
}

/// Elements by group, groups in the order of their first elements.
struct Groups {
  explicit Groups(std::span<const std::string> group) {
    std::unordered_map<std::string_view, std::size_t> at;
    for (std::size_t i = 0; i < group.size(); ++i) {
      const auto [place, is_new] = at.try_emplace(group[i], names.size());
      if (is_new) names.push_back(group[i]), members.emplace_back();
      members[place->second].push_back(i);
      of.push_back(place->second);
    }
  }
  std::vector<std::string> names;
  std::vector<std::vector<std::size_t>> members;
  std::vector<std::size_t> of;  ///< an element's
};

/// Arrays PREFIX_F and PREFIX_error, and the sums of their rows.
struct RowSums {
  std::vector<double> F, error;
};
RowSums add_matrix(NpzFile& npz, const std::string& prefix, std::size_t height, std::size_t width,
                   const FactorRows& rows) {
  Row row(width);
  RowSums sums;
  npz.begin(prefix + "F", "<f8", sizeof(double), {height, width});
  for (std::size_t i = 0; i < height; ++i) {
    rows(static_cast<Index>(i), row.F, row.error);
    npz.put(row.F);
    sums.F.push_back(std::accumulate(row.F.begin(), row.F.end(), 0.0));
    sums.error.push_back(std::accumulate(row.error.begin(), row.error.end(), 0.0));
  }
  npz.end();
  npz.begin(prefix + "error", "<f8", sizeof(double), {height, width});
  for (std::size_t i = 0; i < height; ++i) {
    rows(static_cast<Index>(i), row.F, row.error);
    npz.put(row.error);
  }
  npz.end();
  return sums;
}

void add_points(NpzFile& npz, const PointFactors& of, std::size_t elements) {
  const std::uint64_t count = of.points.size();
  if (count == 0) return;
  std::vector<Vec3> position, normal;
  std::vector<std::string> name;
  std::vector<double> index;
  for (const measure::SensorPoint& point : of.points) {
    position.push_back(point.at.position);
    normal.push_back(point.at.normal);
    name.push_back(point.sensor);
    index.push_back(point.index);
  }
  const RowSums sums = add_matrix(npz, "sensor_", count, elements, of.rows);
  npz.add("sensor_position", flat(position), {count, 3});
  npz.add("sensor_normal", flat(normal), {count, 3});
  npz.add("sensor_row_sum", sums.F, {count});
  npz.add("sensor_row_error", sums.error, {count});
  npz.add("sensor_index", index, {count});
  npz.add("sensor_name", name);
}

/// A matrix in Matrix Market's coordinates.
void write_mtx(const std::filesystem::path& file, const char* meaning, std::size_t height, std::size_t width,
               const FactorRows& rows) {
  AtomicFile out(file);
  std::string text = std::string("%%MatrixMarket matrix coordinate real general\n% ") + meaning + "\n";
  const std::size_t sizes_at = text.size();
  constexpr int digits = 20;  // of the number of entries, which is known at the end
  text += core::format("%zu %zu %*d\n", height, width, digits, 0);
  std::size_t entries = 0;
  Row row(width);
  for (std::size_t i = 0; i < height; ++i) {
    rows(static_cast<Index>(i), row.F, row.error);
    for (std::size_t j = 0; j < width; ++j) {
      if (row.F[j] == 0) continue;
      append(text, i + 1);
      append(text += ' ', j + 1);
      append(text += ' ', row.F[j]);
      text += '\n';
      ++entries;
    }
    out.write(text);
    text.clear();
  }
  out.write(text);
  out.write_over(sizes_at, core::format("%zu %zu %*zu\n", height, width, digits, entries));
  out.keep();
}

/// A table of what is not 0: what a line says of its row, then of its column, then both numbers.
void write_table(const std::filesystem::path& file, const std::string& heading, std::size_t height, std::size_t width,
                 const std::function<std::string(std::size_t)>& row_name,
                 const std::function<std::string(std::size_t)>& column_name, const FactorRows& rows) {
  AtomicFile out(file);
  std::string text = heading + "\n";
  Row row(width);
  for (std::size_t i = 0; i < height; ++i) {
    rows(static_cast<Index>(i), row.F, row.error);
    const std::string name = row_name(i) + ',';
    for (std::size_t j = 0; j < width; ++j) {
      if (row.F[j] == 0 && row.error[j] == 0) continue;
      text += name;
      text += column_name(j);
      append(text += ',', row.F[j]);
      append(text += ',', row.error[j]);
      text += '\n';
    }
    out.write(text);
    text.clear();
  }
  out.write(text);
  out.keep();
}

std::string number(std::size_t i) { return std::to_string(i); }

constexpr const char* environment_name = "environment";
bool has_environment(const FactorElements& elements) { return !elements.environment.empty(); }

/// Rows with the environment as one more column, where it is known.
FactorRows with_environment(const FactorElements& elements, const FactorRows& rows) {
  if (!has_environment(elements)) return rows;
  return [&](Index i, std::span<double> F, std::span<double> error) {
    rows(i, F.first(F.size() - 1), error.first(error.size() - 1));
    F.back() = elements.environment[static_cast<std::size_t>(i)];
    error.back() = elements.environment_error[static_cast<std::size_t>(i)];
  };
}

std::vector<std::string> quoted(std::span<const std::string> names) {
  std::vector<std::string> out;
  for (const std::string& name : names) out.push_back(Csv().text(name).str());
  return out;
}

/// "sensor,index" of each point.
std::vector<std::string> point_names(std::span<const measure::SensorPoint> points) {
  std::vector<std::string> out;
  for (const measure::SensorPoint& point : points) out.push_back(Csv().text(point.sensor).integer(point.index).str());
  return out;
}

}  // namespace

void write_factors_npz(const std::filesystem::path& file, const FactorElements& elements, const FactorRows& rows,
                       const PointFactors& points) {
  const std::uint64_t n = elements.area.size();
  NpzFile npz(file);
  const RowSums sums = add_matrix(npz, "", n, n, rows);
  npz.add("area", elements.area, {n});
  npz.add("normal", flat(elements.normal), {n, 3});
  npz.add("centroid", flat(elements.centroid), {n, 3});
  npz.add("row_sum", sums.F, {n});
  npz.add("row_error", sums.error, {n});
  npz.add("name", elements.name);
  if (!elements.environment.empty()) {
    npz.add("environment", elements.environment, {n});
    npz.add("environment_error", elements.environment_error, {n});
  }
  if (!elements.closure_change.empty()) npz.add("closure_change", elements.closure_change, {n});
  add_points(npz, points, n);
  npz.keep();
}

void write_factors_mtx(const std::filesystem::path& file, const FactorElements& elements, const FactorRows& rows) {
  const std::size_t n = elements.area.size();
  write_mtx(file, "view factors: entry i j is the fraction of the flux leaving i that reaches j", n, n, rows);
}

void write_point_factors_mtx(const std::filesystem::path& file, const PointFactors& points, Index elements) {
  write_mtx(file, "point view factors: entry s j times the radiosity of j is what j sends to sensor point s",
            points.points.size(), static_cast<std::size_t>(elements), points.rows);
}

void write_factors_csv(const std::filesystem::path& file, const FactorElements& elements, const FactorRows& rows) {
  const std::size_t n = elements.area.size();
  write_table(
      file, "i,j,F,error", n, n + has_environment(elements), number,
      [&](std::size_t j) { return j < n ? number(j) : environment_name; }, with_environment(elements, rows));
}

void write_point_factors_csv(const std::filesystem::path& file, const PointFactors& points, Index elements) {
  const std::vector<std::string> names = point_names(points.points);
  write_table(
      file, "sensor,index,j,F,error", names.size(), static_cast<std::size_t>(elements),
      [&](std::size_t s) { return names[s]; }, number, points.rows);
}

void write_grouped_point_factors_csv(const std::filesystem::path& file, const PointFactors& points,
                                     std::span<const std::string> group) {
  const Groups groups(group);
  const std::vector<std::string> names = point_names(points.points), to = quoted(groups.names);
  const auto summed = [&, row = std::make_shared<Row>(group.size())](Index s, std::span<double> F,
                                                                     std::span<double> error) {
    points.rows(s, row->F, row->error);
    std::fill(F.begin(), F.end(), 0.0);
    std::fill(error.begin(), error.end(), 0.0);
    for (std::size_t j = 0; j < group.size(); ++j) {
      F[groups.of[j]] += row->F[j];
      error[groups.of[j]] += row->error[j];
    }
  };
  write_table(
      file, "sensor,index,to,F,error", names.size(), to.size(), [&](std::size_t s) { return names[s]; },
      [&](std::size_t g) { return to[g]; }, summed);
}

void write_grouped_factors_csv(const std::filesystem::path& file, const FactorElements& elements,
                               const FactorRows& rows, std::span<const std::string> group) {
  if (group.size() != elements.area.size()) throw core::PreconditionError("a group per element expected");
  const Groups groups(group);
  std::vector<std::string> names = quoted(groups.names);
  if (has_environment(elements)) names.emplace_back(environment_name);  // the last column
  const auto summed = [&, row = std::make_shared<Row>(elements)](Index g, std::span<double> F,
                                                                 std::span<double> error) {
    std::fill(F.begin(), F.end(), 0.0);
    std::fill(error.begin(), error.end(), 0.0);
    double area = 0;
    for (const std::size_t i : groups.members[static_cast<std::size_t>(g)]) {
      rows(static_cast<Index>(i), row->F, row->error);
      area += elements.area[i];
      for (std::size_t j = 0; j < row->F.size(); ++j) {
        F[groups.of[j]] += elements.area[i] * row->F[j];
        error[groups.of[j]] += elements.area[i] * row->error[j];
      }
      if (!has_environment(elements)) continue;
      F.back() += elements.area[i] * elements.environment[i];
      error.back() += elements.area[i] * elements.environment_error[i];
    }
    for (std::size_t h = 0; h < F.size(); ++h) F[h] /= area, error[h] /= area;
  };
  const auto name = [&](std::size_t g) { return names[g]; };
  write_table(file, "from,to,F,error", groups.names.size(), names.size(), name, name, summed);
}

double most_export_bytes(const std::filesystem::path& file, std::uint64_t elements, std::uint64_t points) {
  const auto n = static_cast<double>(elements), entries = n * (n + static_cast<double>(points));
  const auto digits = static_cast<double>(std::to_string(std::max(elements, points)).size());
  constexpr double number = 23;  // 1.2345678901234567e-308
  const std::string extension = file.extension().string();
  if (extension == ".npz") return 2 * sizeof(double) * entries;
  if (extension == ".mtx") return (2 * (digits + 1) + number + 1) * entries;
  return extension == ".csv" ? (2 * (digits + 1) + 2 * (number + 1)) * entries : 0;
}

}  // namespace interflect::results
