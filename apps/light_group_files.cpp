#include "apps/light_group_files.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/error.h"
#include "core/format.h"
#include "measure/light_groups.h"
#include "results/factors.h"

namespace interflect::apps {
namespace {

void add(std::vector<Spectrum>& sum, double factor, std::span<const Spectrum> values) {
  sum.resize(values.size());
  if (factor == 0) return;
  for (std::size_t i = 0; i < values.size(); ++i) sum[i] += factor * values[i];
}

}  // namespace

std::filesystem::path light_group_file(const std::filesystem::path& folder) { return folder / "light_groups.h5"; }

void write_light_groups(const SolvedScene& solved, const std::filesystem::path& folder, Run& run) {
  const fem::RadiositySolution& s = solved.solution;
  const auto patches = s.mesh.patches();
  results::LightGroups all{std::filesystem::absolute(solved.scene.file).string(),
                           results::geometry_digest(solved.scene, patches),
                           {patches.begin(), patches.end()},
                           s.reflectance,
                           {}};
  const std::vector<std::string> names = measure::light_groups(solved.scene);
  for (std::size_t g = 0; g < names.size(); ++g) {
    const fem::RadiositySolution& alone = s.of_groups[g];
    all.groups.push_back({names[g], alone.exitance, alone.radiosity, alone.irradiance, alone.irradiance_error,
                          alone.irradiance_noise, alone.field_error, alone.shared_noise,
                          answers_at(solved.points, {alone, *solved.rays}, solved.scene, run)});
  }
  results::write_light_groups(light_group_file(folder), all, solved.scene.channel_count());
}

std::vector<double> dimming_of(const std::vector<std::string>& texts, const results::LightGroups& all) {
  std::vector<double> factors(all.groups.size(), 1.0);
  std::vector<bool> said(all.groups.size(), false);
  std::string known;
  for (const results::GroupLight& group : all.groups) known += (known.empty() ? "" : ", ") + group.name;
  for (const std::string& text : texts) {
    const auto fail = [&](const std::string& why) { throw core::InputError("--group " + text, why); };
    const std::size_t at = text.rfind('=');
    if (at == std::string::npos) fail("NAME=PART expected, such as ceiling=0.4");
    const std::string name = text.substr(0, at), number = text.substr(at + 1);
    const auto group =
        std::find_if(all.groups.begin(), all.groups.end(), [&](const auto& g) { return g.name == name; });
    if (group == all.groups.end()) fail("there is no such light group, only " + known);
    double factor = 0;
    const bool percent = !number.empty() && number.back() == '%';
    const char *begin = number.data(), *end = begin + number.size() - (percent ? 1 : 0);
    const auto [rest, error] = std::from_chars(begin, end, factor);
    if (error != std::errc() || rest != end || !(factor >= 0) || !std::isfinite(factor))
      fail("a part of its full output, 0 or more, expected, such as 0.4 or 40%");
    const auto k = static_cast<std::size_t>(group - all.groups.begin());
    if (said[k]) fail("'" + name + "' is dimmed twice");
    said[k] = true;
    factors[k] = percent ? factor / 100 : factor;
  }
  return factors;
}

std::string dimming_text(const results::LightGroups& all, const std::vector<double>& factors) {
  constexpr std::size_t by_name = 3;
  std::string text;
  std::size_t dimmed = 0;
  for (std::size_t g = 0; g < factors.size(); ++g)
    if (factors[g] != 1 && ++dimmed <= by_name)
      text += core::format("%s%s %.4g %%", text.empty() ? "" : ", ", all.groups[g].name.c_str(), 100 * factors[g]);
  if (dimmed > by_name) text += core::format(", and %zu more", dimmed - by_name);
  return text.empty() ? "all lights at full output" : text + "; same scale as at full output";
}

fem::RadiositySolution dimmed(const results::LightGroups& all, const std::vector<double>& factors) {
  mesh::ElementMesh mesh(all.patches);
  const double longest = mesh.longest_edge();
  fem::RadiositySolution s(std::move(mesh), longest);
  s.reflectance = all.reflectance;
  for (std::size_t g = 0; g < all.groups.size(); ++g) {
    const results::GroupLight& group = all.groups[g];
    add(s.exitance, factors[g], group.exitance);
    add(s.radiosity, factors[g], group.radiosity);
    add(s.irradiance, factors[g], group.irradiance);
    add(s.irradiance_error, factors[g], group.irradiance_error);
    add(s.irradiance_noise, factors[g], group.irradiance_noise);
    add(s.field_error, factors[g], group.field_error);
    s.shared_noise += factors[g] * group.shared_noise;
  }
  s.coarse_radiosity = s.radiosity;
  return s;
}

std::vector<Estimate> dimmed_points(const results::LightGroups& all, const std::vector<double>& factors) {
  const std::size_t points = all.groups.empty() ? 0 : all.groups.front().at_points.size();
  std::vector<Estimate> sum(points, Estimate{Spectrum(), Spectrum(), Spectrum(), Claim::estimated, 0});
  for (std::size_t g = 0; g < all.groups.size(); ++g) {
    if (factors[g] == 0) continue;
    for (std::size_t k = 0; k < points; ++k) {
      const Estimate& e = all.groups[g].at_points[k];
      sum[k].value += factors[g] * e.value;
      sum[k].standard_error += factors[g] * e.standard_error;
      sum[k].error_bound += factors[g] * e.error_bound;
    }
  }
  return sum;
}

}  // namespace interflect::apps
