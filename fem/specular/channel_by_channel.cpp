#include "fem/specular/channel_by_channel.h"

#include <algorithm>

#include "core/error.h"
#include "core/overloaded.h"
#include "measure/light_groups.h"

namespace interflect::fem {
namespace {

void keep(Spectrum& s, int channel) {
  const double kept = s[channel];
  s = Spectrum::zero();
  s[0] = kept;
}

void keep(scene::Finish& finish, int channel) {
  std::visit(core::Overloaded{[&](scene::Mirror& mirror) { keep(mirror.reflectance, channel); },
                              [&](scene::Pane& pane) { keep(pane.transmittance, channel); },
                              [&](scene::Metal& metal) {
                                if (auto* index = std::get_if<scene::Metal::Index>(&metal.reflects))
                                  keep(index->eta, channel), keep(index->k, channel);
                                else
                                  keep(std::get<Spectrum>(metal.reflects), channel);
                              },
                              [](auto&) {}},
             finish);
}

using OfElements = std::vector<Spectrum> RadiositySolution::*;
constexpr OfElements of_elements[] = {&RadiositySolution::exitance,         &RadiositySolution::reflectance,
                                      &RadiositySolution::radiosity,        &RadiositySolution::irradiance,
                                      &RadiositySolution::irradiance_error, &RadiositySolution::irradiance_noise,
                                      &RadiositySolution::field_error,      &RadiositySolution::coarse_radiosity};

using OfEnergy = Spectrum EnergyBalance::*;
constexpr OfEnergy of_energy[] = {
    &EnergyBalance::emitted,  &EnergyBalance::absorbed,          &EnergyBalance::escaped,
    &EnergyBalance::on_backs, &EnergyBalance::split_error,       &EnergyBalance::on_backs_error,
    &EnergyBalance::residual, &EnergyBalance::form_factor_error, &EnergyBalance::in_mirrors};

/// Channel 0 of `one` becomes a channel of `all`.
void set_channel(RadiositySolution& all, const RadiositySolution& one, int channel) {
  if (one.mesh.size() != all.mesh.size()) throw core::PreconditionError("channels have elements of their own");
  for (const OfElements field : of_elements)
    for (std::size_t i = 0; i < (all.*field).size(); ++i) (all.*field)[i][channel] = (one.*field)[i][0];
  for (const OfEnergy part : of_energy) (all.energy.*part)[channel] = (one.energy.*part)[0];
  all.shared_noise[channel] = one.shared_noise[0];
}

/// A solution without light, in no channel.
RadiositySolution dark(RadiositySolution solution) {
  for (const OfElements field : of_elements)
    for (Spectrum& value : solution.*field) value = Spectrum::zero();
  solution.shared_noise = Spectrum::zero();
  solution.energy = {};
  solution.of_groups.clear();
  return solution;
}

/// Groups that do not shine in a channel have no solution of it, and nothing in it here.
void set_groups(std::vector<RadiositySolution>& all, const std::vector<std::string>& names,
                const RadiositySolution& one, const std::vector<std::string>& names_of_one, int channel) {
  for (std::size_t g = 0; g < one.of_groups.size(); ++g) {
    const auto at = std::find(names.begin(), names.end(), names_of_one[g]) - names.begin();
    set_channel(all[static_cast<std::size_t>(at)], one.of_groups[g], channel);
  }
}

/// What is told of all channels together: costs are added up, shortfalls those of the worst.
void add_report(RadiositySolution& all, const RadiositySolution& one) {
  for (const StageCost& stage : one.stages) {
    const auto same = std::find_if(all.stages.begin(), all.stages.end(),
                                   [&](const StageCost& of_all) { return of_all.stage == stage.stage; });
    if (same == all.stages.end())
      all.stages.push_back(stage);
    else
      same->seconds += stage.seconds, same->peak_bytes = std::max(same->peak_bytes, stage.peak_bytes);
  }
  all.pairs += one.pairs;
  all.bytes = std::max(all.bytes, one.bytes);
  all.closed = all.closed && one.closed;
  if (all.solver.converged() && !one.solver.converged()) all.solver = one.solver;
  all.tolerance_met = all.tolerance_met && one.tolerance_met;
  all.largest_row_error = std::max(all.largest_row_error, one.largest_row_error);
  all.largest_dropped = std::max(all.largest_dropped, one.largest_dropped);
}

int most_weighty_channel(const scene::Scene& scene) {
  int most = 0;
  for (int c = 1; c < scene.channel_count(); ++c)
    if (scene.weights[c] > scene.weights[most]) most = c;
  return most;
}

}  // namespace

scene::Scene in_one_channel(const scene::Scene& scene, int channel) {
  scene::Scene one = scene;
  one.channels = {scene.channels[static_cast<std::size_t>(channel)]};
  one.weights = Spectrum::zero();
  one.weights[0] = 1;
  for (scene::Material& material : one.materials) {
    keep(material.reflectance, channel);
    keep(material.exitance, channel);
    keep(material.finish, channel);
  }
  return one;
}

RadiositySolution channel_by_channel(const scene::Scene& scene, bool light_groups,
                                     const std::function<RadiositySolution(const scene::Scene&)>& solve) {
  const int first = most_weighty_channel(scene);
  const std::vector<std::string> groups = light_groups ? measure::light_groups(scene) : std::vector<std::string>();
  const RadiositySolution of_first = solve(in_one_channel(scene, first));
  RadiositySolution all = of_first;
  all.stages.clear();
  all.pairs = {};
  all.of_groups.assign(groups.size(), dark(of_first));
  for (int c = 0; c < scene.channel_count(); ++c) {
    const scene::Scene in_channel = in_one_channel(scene, c);
    const RadiositySolution one = c == first ? of_first : solve(in_channel);
    set_channel(all, one, c);
    set_groups(all.of_groups, groups, one, measure::light_groups(in_channel), c);
    add_report(all, one);
  }
  for (RadiositySolution& group : all.of_groups) group.reflectance = all.reflectance;
  return all;
}

}  // namespace interflect::fem
