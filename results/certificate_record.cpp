#include "results/certificate_record.h"

namespace interflect::results {

namespace {

using validation::Certificate;
using validation::Difference;
using validation::Judged;

Record interval(const validation::Interval& i) {
  return Record().add("value", i.value).add("low", i.low).add("high", i.high);
}

Record norms(const validation::Norms& n) {
  Record out;
  out.add("measurements", n.measurements).add("area", n.area).add("mean_irradiance", n.mean_irradiance);
  if (n.measurements > 0) {
    out.add("l1", interval(n.l1)).add("l2", interval(n.l2)).add("max", interval(n.max)).add("worst", n.worst);
    out.add("bias", interval(n.bias));
  }
  return out.add("reference_error", n.reference_error).add("claimed_error", n.claimed_error);
}

Record named(const Judged& judged, const Difference& d) {
  Record out;
  out.add("name", judged.name).add("fem", d.fem).add("path_traced", d.mc).add("standard_error", d.standard_error);
  return out.add("error_bound", d.bound).add("z", d.z).add("excess_z", d.excess_z);
}

Record::List listed(std::span<const Judged> judged, const std::vector<Difference>& differences,
                    const std::vector<std::size_t>& which) {
  Record::List list;
  for (std::size_t i : which) list.push_back(named(judged[i], differences[i]));
  return list;
}

Record judgement(const validation::Judgement& j, std::span<const Judged> judged) {
  const validation::Comparison& c = j.comparison;
  Record out;
  out.add("reading", j.reading.name).add("share_agreeing", c.share).add("not_judged", c.unknown.size());
  out.add("disagreeing", listed(judged, c.differences, c.disagreeing));
  out.add("z_max", c.z_max).add("beyond_chance", listed(judged, c.differences, c.beyond_chance));
  out.add("mean_z", c.mean_z).add("mean_z_limit", c.mean_z_limit).add("mean_z_square", c.mean_z_square);
  out.section("elements").add("all", norms(j.elements)).add("not_emitting", norms(j.elements_dark));
  out.section("surfaces").add("all", norms(j.surfaces)).add("not_emitting", norms(j.surfaces_dark));
  return out;
}

Record energy(const validation::EnergyBalance& e, int channels) {
  Record out;
  out.add("emitted", e.emitted, channels).add("absorbed", e.absorbed, channels).add("lost", e.lost, channels);
  if (e.on_backs) out.add("on_backs", *e.on_backs, channels);
  if (e.residual) out.add("residual", *e.residual, channels);
  return out.add("standard_error", e.standard_error, channels);
}

Record expected(const validation::ExpectedCheck& e) {
  Record out;
  out.add("sensor", e.sensor).add("statistic", e.statistic).add("expected", e.expected).add("tolerance", e.tolerance);
  out.add("fem", e.fem).add("path_traced", e.mc).add("standard_error", e.mc_standard_error);
  return out.add("passed", e.passed()).add("source", e.source);
}

Record estimate(const Estimate& e, int channels) {
  Record out;
  out.add("value", e.value, channels).add("standard_error", e.standard_error, channels);
  return out.add("error_bound", e.error_bound, channels).add("samples", e.samples);
}

Record measurement(const Judged& j, const Difference& d, int channels) {
  Record out;
  out.add("name", j.name).add("kind", describe(j.kind)).add("group", j.group);
  if (j.element >= 0) out.add("element", j.element);
  out.add("area", j.area).add("represented_area", j.represented_area()).add("emitting", j.emitting);
  out.add("fem", estimate(j.fem, channels)).add("path_traced", estimate(j.mc, channels));
  return out.add("agrees", d.agrees).add("z", d.z).add("excess_z", d.excess_z);
}

template <class T, class F>
Record::List list_of(const std::vector<T>& items, F record) {
  Record::List list;
  for (const T& item : items) list.push_back(record(item));
  return list;
}

}  // namespace

Record certificate_record(const Certificate& certificate, std::span<const Judged> judged,
                          const std::vector<std::string>& channels) {
  const int n = static_cast<int>(channels.size());
  Record out;
  out.add("format", "interflect/validation/1");
  out.add("verdict", certificate.verdict).add("passed", certificate.passed);
  out.add("reasons", certificate.reasons).add("remarks", certificate.remarks);
  out.add("unit", certificate.unit).add("channels", channels);
  out.section("settings")
      .add("share", certificate.settings.share)
      .add("alpha", certificate.settings.alpha)
      .add("comparisons", certificate.comparisons)
      .add("reference_limit", certificate.settings.reference_limit);
  out.section("judged")
      .add("surfaces", certificate.surfaces)
      .add("elements", certificate.elements)
      .add("sensors", certificate.sensors);
  out.section("worst_surface")
      .add("name", certificate.worst_surface)
      .add("relative_difference", certificate.worst_surface_difference);
  out.add("judgements", list_of(certificate.judgements, [&](const auto& j) { return judgement(j, judged); }));
  out.section("energy")
      .add("fem", energy(certificate.fem_energy, n))
      .add("path_traced", energy(certificate.mc_energy, n));
  out.add("expected", list_of(certificate.expected, expected));
  Record::List all;
  for (std::size_t i = 0; i < judged.size(); ++i)
    all.push_back(measurement(judged[i], certificate.judgements.front().comparison.differences[i], n));
  return out.add("measurements", all);
}

}  // namespace interflect::results
