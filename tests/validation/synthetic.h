#pragma once

#include <cmath>
#include <vector>

#include "core/random.h"
#include "validation/judged.h"
#include "validation/statistics.h"

/// Sets of measurements whose truth is known.
namespace synthetic {

using namespace interflect;

inline double normal(core::RandomNumbers& random) {
  return validation::normal_quantile(std::max(random.next(), 0x1p-60));
}

inline scene::Scene scene(std::vector<std::string> channels = {"grey"}) {
  scene::Scene scene;
  scene.channels = std::move(channels);
  for (int c = 0; c < scene.channel_count(); ++c) scene.weights[c] = 1.0 / scene.channel_count();
  return scene;
}

struct Plan {
  int count = 500;
  double noise = 0.01;          ///< standard error of the reference, relative to H
  double claimed_noise = 0.01;  ///< what it says it is
  double bias = 0;              ///< of FEM, relative to H, everywhere
  double spread = 0;            ///< of FEM's further errors, relative to H, normally distributed
  double fem_noise = 0;         ///< FEM's own standard error, relative to H: as it is and as it says
  double bound = 0;             ///< relative to H
  Claim claim = Claim::estimated;
  int channels = 1;           ///< of independent noise and spread; 1: all channels are the same
  bool knows_weighed = true;  ///< the reference tells the noise of the mean of the channels
};

/// H from 50 to 150, areas over a factor of 100, every tenth emitting, ten surfaces with equal shares of elements.
inline double truth(int j) { return 100 + 50 * std::sin(0.7 * j); }
inline double area(int j) { return 0.01 * std::pow(100.0, (j % 11) / 10.0); }

inline std::vector<validation::Judged> judged(const Plan& plan, std::uint64_t seed) {
  std::vector<validation::Judged> all;
  for (int j = 0; j < plan.count; ++j) {
    core::RandomNumbers random(seed, 7, static_cast<std::uint64_t>(j));
    const double H = truth(j);
    Spectrum fem, mc;
    for (int c = 0; c < plan.channels; ++c) {
      fem[c] = H * (1 + plan.bias + plan.spread * normal(random));
      mc[c] = H * (1 + plan.noise * normal(random));
      if (plan.fem_noise > 0) fem[c] += H * plan.fem_noise * normal(random);
    }
    if (plan.channels == 1) fem = Spectrum(fem[0]), mc = Spectrum(mc[0]);
    validation::Judged one;
    one.name = "element " + std::to_string(j);
    one.kind = validation::Judged::Kind::element;
    one.element = j;
    one.area = area(j);
    one.emitting = j % 10 == 0;
    one.fem = {fem, Spectrum(plan.fem_noise * H), Spectrum(plan.bound * H), plan.claim, 0};
    one.mc = unbiased_estimate(mc, Spectrum(plan.claimed_noise * H), 1000);
    if (plan.knows_weighed) one.mc.weighed_standard_error = plan.claimed_noise * H / std::sqrt(plan.channels);
    one.group = "surface " + std::to_string(j / (plan.count / 10));
    all.push_back(one);
  }
  return all;
}

inline const validation::Reading grey{"grey", [] {
                                        Spectrum s;
                                        s[0] = 1;
                                        return s;
                                      }()};

}  // namespace synthetic
