#include "results/factor_export.h"

#include <charconv>
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
  explicit Row(const FactorElements& elements) : F(elements.area.size()), error(elements.area.size()) {}
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

}  // namespace

void write_factors_npz(const std::filesystem::path& file, const FactorElements& elements, const FactorRows& rows) {
  const std::uint64_t n = elements.area.size();
  Row row(elements);
  std::vector<double> sum(n), bound(n);
  NpzFile npz(file);
  npz.begin("F", "<f8", sizeof(double), {n, n});
  for (std::size_t i = 0; i < n; ++i) {
    rows(static_cast<Index>(i), row.F, row.error);
    npz.put(row.F);
    sum[i] = std::accumulate(row.F.begin(), row.F.end(), 0.0);
    bound[i] = std::accumulate(row.error.begin(), row.error.end(), 0.0);
  }
  npz.end();
  npz.begin("error", "<f8", sizeof(double), {n, n});
  for (std::size_t i = 0; i < n; ++i) {
    rows(static_cast<Index>(i), row.F, row.error);
    npz.put(row.error);
  }
  npz.end();
  npz.add("area", elements.area, {n});
  npz.add("normal", flat(elements.normal), {n, 3});
  npz.add("centroid", flat(elements.centroid), {n, 3});
  npz.add("row_sum", sum, {n});
  npz.add("row_error", bound, {n});
  npz.add("name", elements.name);
  npz.keep();
}

void write_factors_mtx(const std::filesystem::path& file, const FactorElements& elements, const FactorRows& rows) {
  const std::size_t n = elements.area.size();
  AtomicFile out(file);
  std::string text =
      "%%MatrixMarket matrix coordinate real general\n"
      "% view factors: entry i j is the fraction of the flux leaving i that reaches j\n";
  const std::size_t sizes_at = text.size();
  constexpr int width = 20;  // of the number of entries, which is known at the end
  text += core::format("%zu %zu %*d\n", n, n, width, 0);
  std::size_t entries = 0;
  Row row(elements);
  for (std::size_t i = 0; i < n; ++i) {
    rows(static_cast<Index>(i), row.F, row.error);
    for (std::size_t j = 0; j < n; ++j) {
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
  out.write_over(sizes_at, core::format("%zu %zu %*zu\n", n, n, width, entries));
  out.keep();
}

void write_factors_csv(const std::filesystem::path& file, const FactorElements& elements, const FactorRows& rows) {
  const std::size_t n = elements.area.size();
  AtomicFile out(file);
  std::string text = "i,j,F,error\n";
  Row row(elements);
  for (std::size_t i = 0; i < n; ++i) {
    rows(static_cast<Index>(i), row.F, row.error);
    for (std::size_t j = 0; j < n; ++j) {
      if (row.F[j] == 0 && row.error[j] == 0) continue;
      append(text, i);
      append(text += ',', j);
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

void write_grouped_factors_csv(const std::filesystem::path& file, const FactorElements& elements,
                               const FactorRows& rows, std::span<const std::string> group) {
  if (group.size() != elements.area.size()) throw core::PreconditionError("a group per element expected");
  const Groups groups(group);
  std::vector<std::string> quoted;
  for (const std::string& name : groups.names) quoted.push_back(Csv().text(name).str());
  AtomicFile out(file);
  std::string text = "from,to,F,error\n";
  Row row(elements);
  for (std::size_t g = 0; g < groups.names.size(); ++g) {
    std::vector<double> K(groups.names.size()), bound(K.size());
    double area = 0;
    for (const std::size_t i : groups.members[g]) {
      rows(static_cast<Index>(i), row.F, row.error);
      area += elements.area[i];
      for (std::size_t j = 0; j < row.F.size(); ++j) {
        K[groups.of[j]] += elements.area[i] * row.F[j];
        bound[groups.of[j]] += elements.area[i] * row.error[j];
      }
    }
    for (std::size_t h = 0; h < K.size(); ++h) {
      if (K[h] == 0 && bound[h] == 0) continue;
      text += quoted[g] + ',' + quoted[h];
      append(text += ',', K[h] / area);
      append(text += ',', bound[h] / area);
      text += '\n';
    }
    out.write(text);
    text.clear();
  }
  out.write(text);
  out.keep();
}

}  // namespace interflect::results
