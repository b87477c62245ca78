#include "validation/certificate.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/format.h"
#include "validation/statistics.h"

namespace interflect::validation {

namespace {

using core::format;

/// "0.13 %", "1.3 %", "13 %".
std::string percent(double part) {
  const double p = 100 * part;
  if (p == 0 || !std::isfinite(p)) return format("%g %%", p);
  return format("%.*f %%", std::clamp(1 - static_cast<int>(std::floor(std::log10(std::abs(p)))), 0, 9), p);
}

/// "-0.12 % (-0.20 .. -0.04)".
std::string percent_interval(const Interval& i) {
  return format("%+.2f %% (%+.2f .. %+.2f)", 100 * i.value, 100 * i.low, 100 * i.high);
}

bool is(const Judged& j, Judged::Kind kind) { return j.kind == kind; }

Judgement judge(std::span<const Judged> judged, const Reading& reading, double z_max) {
  Judgement result{reading, compare(judged, reading, z_max), {}, {}, {}, {}};
  const auto norms = [&](Judged::Kind kind, bool dark) {
    return error_norms(judged, reading, [=](const Judged& j) { return is(j, kind) && !(dark && j.emitting); });
  };
  result.elements = norms(Judged::Kind::element, false);
  result.elements_dark = norms(Judged::Kind::element, true);
  result.surfaces = norms(Judged::Kind::surface, false);
  result.surfaces_dark = norms(Judged::Kind::surface, true);
  return result;
}

/// The surface with the largest |FEM - MC| in the weighted value.
void find_worst_surface(std::span<const Judged> judged, Certificate& certificate) {
  const std::vector<Difference>& differences = certificate.judgements.front().comparison.differences;
  double largest = -1;
  for (std::size_t i = 0; i < judged.size(); ++i) {
    const Difference& d = differences[i];
    if (!is(judged[i], Judged::Kind::surface) || !d.known) continue;
    const double relative = d.difference() == 0 ? 0 : d.difference() / d.mc;
    if (std::abs(relative) <= largest) continue;
    largest = std::abs(relative);
    certificate.worst_surface = judged[i].name;
    certificate.worst_surface_difference = relative;
  }
}

/// The worst measurement of those whose guaranteed bound is broken beyond chance.
std::optional<std::size_t> broken_guarantee(std::span<const Judged> judged, const Comparison& comparison) {
  for (std::size_t i : comparison.beyond_chance)  // the worst first
    if (judged[i].fem.claim == Claim::guaranteed) return i;
  return {};
}

void give_reasons(std::span<const Judged> judged, const Judgement& j, const Settings& settings,
                  std::vector<std::string>& out) {
  const Comparison& c = j.comparison;
  const char* name = j.reading.name.c_str();
  if (!c.unknown.empty())
    out.push_back(format("%s: %zu of %zu measurements lack a finite error bound or standard error (%s first)", name,
                         c.unknown.size(), judged.size(), judged[c.unknown.front()].name.c_str()));
  if (c.share < settings.share)
    out.push_back(format("%s: %zu of %zu measurements differ by more than error bound + 3 standard errors (%s most)",
                         name, c.disagreeing.size(), judged.size(), judged[c.disagreeing.front()].name.c_str()));
  if (c.drifts())
    out.push_back(format("%s: the mean of z is %+.3f, where error bounds and chance explain %.3f: FEM is %s everywhere",
                         name, c.mean_z, c.mean_z_limit, c.mean_z > 0 ? "too bright" : "too dark"));
  if (const auto broken = broken_guarantee(judged, c))
    out.push_back(format("%s: a guaranteed error bound is broken at %s", name, judged[*broken].name.c_str()));
}

void give_remarks(std::span<const Judged> judged, const Judgement& j, double alpha, std::vector<std::string>& out) {
  const Comparison& c = j.comparison;
  const char* name = j.reading.name.c_str();
  if (!c.beyond_chance.empty())
    out.push_back(format("%s: %zu difference%s beyond error bound and chance (|z| > %.2f), the largest at %s", name,
                         c.beyond_chance.size(), c.beyond_chance.size() == 1 ? " is" : "s are", c.z_max,
                         judged[c.beyond_chance.front()].name.c_str()));
  const double n = static_cast<double>(c.noisy);
  if (c.noisy >= 30 && c.mean_z_square < 1 - normal_upper_quantile(alpha) * std::sqrt(2 / n))
    out.push_back(format("%s: the mean of z^2 is %.2f: standard errors look overestimated", name, c.mean_z_square));
  if (j.norms().claimed_error > 0.1)
    out.push_back(format("%s: FEM's own error bounds reach %s of H (L2), which makes agreement easy", name,
                         percent(j.norms().claimed_error).c_str()));
}

/// One remark for all readings whose bias is beyond chance; the level is divided among the readings.
void remark_on_bias(Certificate& certificate) {
  const double z_max = sidak_z_max(certificate.settings.alpha, certificate.judgements.size());
  std::string significant;
  for (const Judgement& j : certificate.judgements) {
    const Interval& bias = j.bias();
    if (std::abs(bias.value) > z_max * (bias.high - bias.low) / (2 * normal_95))
      significant += (significant.empty() ? "" : ", ") + j.reading.name + " " + percent_interval(bias);
  }
  if (!significant.empty())
    certificate.remarks.push_back("FEM's mean is off beyond chance (95 % interval): " + significant);
}

void check_energy(const scene::Scene& scene, Certificate& certificate) {
  const Reading reading{"", scene.weights};
  const double emitted = reading.value(certificate.fem_energy.emitted);
  const double off = reading.value(certificate.fem_energy.absorbed) - reading.value(certificate.mc_energy.absorbed);
  const double se = std::hypot(reading.error(certificate.fem_energy.standard_error),
                               reading.error(certificate.mc_energy.standard_error));
  if (emitted > 0 && std::abs(off) > 0.01 * emitted + 3 * se)
    certificate.remarks.push_back(
        format("the absorbed flux differs by %s of the emitted flux", percent(off / emitted).c_str()));
}

std::size_t number_of(Judged::Kind kind, std::span<const Judged> judged) {
  return static_cast<std::size_t>(
      std::count_if(judged.begin(), judged.end(), [=](const Judged& j) { return is(j, kind); }));
}

/// Whether there is something to judge by the path tracer, and the path tracer good enough.
void check_reference(Certificate& certificate) {
  const Norms& norms = certificate.judgements.front().norms();
  const double limit = certificate.settings.reference_limit;
  if (norms.measurements == 0)
    certificate.reasons.insert(certificate.reasons.begin(), "no surface and no element was judged");
  else if (norms.mean_irradiance == 0 && norms.l2.value == 0)
    certificate.reasons.insert(certificate.reasons.begin(), "no light reaches what was judged, which tells nothing");
  if (norms.reference_error > limit)
    certificate.reasons.push_back(
        format("the reference is too noisy to judge by: its 95 %% error is %s, and %s was asked for",
               percent(norms.reference_error).c_str(), percent(limit).c_str()));
}

std::string reason_of(const ExpectedCheck& missed) {
  return format("sensor %s: %s is %.6g by FEM and %.6g by path tracing, %.6g +- %s expected", missed.sensor.c_str(),
                missed.statistic.c_str(), missed.fem, missed.mc, missed.expected, percent(missed.tolerance).c_str());
}

std::string verdict_of(const Certificate& certificate) {
  const Judgement& weighted = certificate.judgements.front();
  const Norms& norms = weighted.norms();
  const std::string measured =
      format("FEM within %s (L2 of H) of the path-traced reference, whose own 95 %% error is %s; bias %s",
             percent(norms.l2.high).c_str(), percent(norms.reference_error).c_str(),
             percent_interval(weighted.bias()).c_str());
  return certificate.passed ? "Validated: " + measured
                            : "Not validated: " + certificate.reasons.front() + "; " + measured;
}

}  // namespace

const Interval& Judgement::bias() const {
  if (surfaces.measurements == 0 || elements.measurements == 0) return norms().bias;
  const auto width = [](const Norms& n) { return n.bias.high - n.bias.low; };
  return (width(elements) < width(surfaces) ? elements : surfaces).bias;
}

EnergyBalance sampled_energy(const Spectrum& emitted, std::span<const double> areas,
                             std::span<const Spectrum> reflectances, std::span<const Estimate> irradiance) {
  if (areas.size() != irradiance.size() || reflectances.size() != irradiance.size())
    throw core::PreconditionError("sampled_energy: one area and reflectance per irradiance expected");
  EnergyBalance balance;
  balance.emitted = emitted;
  Spectrum variance;
  for (std::size_t i = 0; i < areas.size(); ++i) {
    const Spectrum absorbing = (Spectrum(1) - reflectances[i]) * areas[i];
    const Spectrum error = absorbing * irradiance[i].standard_error;
    balance.absorbed += absorbing * irradiance[i].value;
    variance += error * error;
  }
  balance.standard_error = variance.map([](double v) { return std::sqrt(v); });
  balance.lost = balance.emitted - balance.absorbed;
  return balance;
}

Certificate certify(const scene::Scene& scene, std::span<const Judged> judged, const EnergyBalance& fem,
                    const EnergyBalance& mc, const Settings& settings) {
  Certificate certificate;
  certificate.settings = settings;
  certificate.unit = scene.irradiance_unit();
  certificate.fem_energy = fem;
  certificate.mc_energy = mc;
  certificate.surfaces = number_of(Judged::Kind::surface, judged);
  certificate.elements = number_of(Judged::Kind::element, judged);
  certificate.sensors = number_of(Judged::Kind::sensor, judged);
  const std::vector<Reading> readings = readings_of(scene);
  certificate.comparisons = readings.size() * (judged.size() + 1);
  const double z_max = sidak_z_max(settings.alpha, certificate.comparisons);
  for (const Reading& reading : readings) {
    const Judgement& j = certificate.judgements.emplace_back(judge(judged, reading, z_max));
    give_reasons(judged, j, settings, certificate.reasons);
    give_remarks(judged, j, settings.alpha, certificate.remarks);
  }
  check_reference(certificate);
  remark_on_bias(certificate);
  find_worst_surface(judged, certificate);
  check_energy(scene, certificate);
  certificate.expected = check_expected(scene, judged);
  for (const ExpectedCheck& e : certificate.expected)
    if (!e.passed()) certificate.reasons.push_back(reason_of(e));
  certificate.passed = certificate.reasons.empty();
  certificate.verdict = verdict_of(certificate);
  return certificate;
}

void add_reason(const std::string& reason, Certificate& certificate) {
  certificate.reasons.push_back(reason);
  certificate.passed = false;
  certificate.verdict = verdict_of(certificate);
}

}  // namespace interflect::validation
