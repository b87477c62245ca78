#include "apps/view_of.h"

#include <optional>
#include <set>

#include "core/error.h"
#include "mesh/element_mesh.h"
#include "results/vtu.h"

#ifdef INTERFLECT_WITH_VTK
#include "apps/camera_pictures.h"
#include "apps/display_or_warning.h"
#include "apps/element_picture.h"
#include "apps/in_view.h"
#endif

namespace interflect::apps {
namespace {

constexpr std::size_t most_names = 8;  ///< in a message

std::string listed(const std::vector<std::string>& names) {
  const std::set<std::string> all(names.begin(), names.end());
  if (all.size() > most_names) return std::to_string(all.size());
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

ViewedSurface viewed_surface(const std::string& name, const FactorRequest& request) {
  const std::vector<std::string> groups = groups_of(request, "group");
  ViewedSurface surface{name, {}};
  for (Index i = 0; i < request.about.size(); ++i)
    if (request.about.name[static_cast<std::size_t>(i)] == name || groups[static_cast<std::size_t>(i)] == name)
      surface.elements.push_back(i);
  if (surface.elements.empty())
    throw core::InputError("--view-of " + name, "no surface or group of that name has view factors; groups: " +
                                                    listed(groups) + "; surfaces: " + listed(request.about.name));
  return surface;
}

void write_view_of(const ViewedSurface& surface, const FactorRequest& request, const results::FactorStore& store,
                   [[maybe_unused]] const raycast::RayCaster& rays, const std::filesystem::path& out) {
  const auto patches = request.elements.seeing();  // what masks cover is not to be seen
  const auto of_seeing = [&](std::vector<double> values) {
    values.resize(patches.size());
    return values;
  };
  const mesh::ElementMesh mesh({patches.begin(), patches.end()});
  const Shares shares = shares_of(store, surface.elements);
  std::vector<results::CellField> fields = results::id_fields(mesh);
  fields.push_back(results::scalar_field("view_factor", of_seeing(shares.F)));
  fields.push_back(results::scalar_field("view_factor_error", of_seeing(shares.error)));
  fields.push_back(results::scalar_field("row_sum", of_seeing(store.row_sum())));
  fields.push_back(results::scalar_field("row_error", of_seeing(store.row_error())));
  results::write_vtu(beside(out, ".view.vtu"), mesh, fields);
#ifdef INTERFLECT_WITH_VTK
  const auto display = display_or_warning();
  if (!display) return;
  const scene::Scene& scene = request.geometry.scene;
  const auto camera = drawable_camera(scene);
  const std::vector<double> F = of_seeing(shares.F);
  write_element_picture(*display, beside(out, ".view.png"), scene, mesh, F,
                        {.title = "view factor to " + surface.name,
                         .caption = {},
                         .range = range_in_view(F, shares_in_view(rays, mesh, camera))});
#endif
}

}  // namespace interflect::apps
