#include "apps/view_of.h"

#include <algorithm>
#include <set>

#include "core/error.h"
#include "mesh/element_mesh.h"
#include "results/vtu.h"

#ifdef INTERFLECT_WITH_VTK
#include "apps/element_picture.h"
#endif

namespace interflect::apps {
namespace {

constexpr std::size_t most_names = 8;  ///< in a message

std::string listed(const std::vector<std::string>& names) {
  const std::set<std::string> all(names.begin(), names.end());
  if (all.size() > most_names) return std::to_string(all.size()) + " others";
  std::string text;
  for (const std::string& name : all) text += (text.empty() ? "" : ", ") + name;
  return text;
}

/// Per element.
struct Shares {
  std::vector<double> F, error;
};

/// By rows of the surface, which are the fewer: F_js = A_s F_sj / A_j.
Shares shares_of(const results::FactorStore& store, std::span<const Index> seen) {
  const auto n = static_cast<std::size_t>(store.size());
  const std::vector<double>& area = store.elements().area;
  Shares shares{std::vector<double>(n, 0), std::vector<double>(n, 0)};
  std::vector<double> F(n), error(n);
  const results::FactorRows row = store.rows();
  for (const Index s : seen) {
    row(s, F, error);
    for (std::size_t j = 0; j < n; ++j) {
      const double reciprocal = area[static_cast<std::size_t>(s)] / area[j];
      shares.F[j] += reciprocal * F[j];
      shares.error[j] += reciprocal * error[j];
    }
  }
  return shares;
}

std::filesystem::path beside(std::filesystem::path out, const char* extension) {
  return out.replace_extension(extension);
}

}  // namespace

ViewOf::ViewOf(const std::string& name, const FactorRequest& request) : name_(name), request_(request) {
  const std::vector<std::string> groups = groups_of(request, "group");
  for (Index i = 0; i < request.about.size(); ++i)
    if (request.about.name[static_cast<std::size_t>(i)] == name || groups[static_cast<std::size_t>(i)] == name)
      seen_.push_back(i);
  if (seen_.empty())
    throw core::InputError("--view-of " + name,
                           "no surface or group of that name; there are: " + listed(request.about.name));
}

void ViewOf::write(const std::filesystem::path& out, const results::FactorStore& store) const {
  const std::size_t open = request_.elements.open;  // what masks cover is not to be seen
  const auto of_open = [&](std::vector<double> values) {
    values.resize(open);
    return values;
  };
  const auto patches = request_.elements.seeing();
  const mesh::ElementMesh mesh({patches.begin(), patches.end()});
  const Shares shares = shares_of(store, seen_);
  std::vector<results::CellField> fields = results::id_fields(mesh);
  fields.push_back(results::scalar_field("view_factor", of_open(shares.F)));
  fields.push_back(results::scalar_field("view_factor_error", of_open(shares.error)));
  fields.push_back(results::scalar_field("row_sum", of_open(store.row_sum())));
  fields.push_back(results::scalar_field("row_error", of_open(store.row_error())));
  results::write_vtu(beside(out, ".view.vtu"), mesh, fields);
#ifdef INTERFLECT_WITH_VTK
  write_element_picture(beside(out, ".view.png"), request_.geometry.scene, mesh, of_open(shares.F),
                        {.title = "view factor to " + name_, .caption = {}});
#endif
}

}  // namespace interflect::apps
